// The scene's lumps in the layers of a body: where each lies, of how many kPa it is there, and the energy that it adds
// to a press.
//
//   LumpSettings, skin, stack of the place ─ placedLumps, at load ─► World::lumps, Surface::lumps ─► contact
//   BodyParts, raise_mm ─ raiseSkin ─► Body, before all of this
//   fields of the stacks ─ pressureGround ─► World::pressure ─► contact/pressure_field.h
//
// A lump needs layered tissue whose field is known: the library's stacks, or a layer_table that was solved with one.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/contact/lump_force.h"
#include "palpate/contact/pressure_field.h"
#include "palpate/scene/healthy_tissue.h"
#include "palpate/scene/world.h"
#include "palpate/tissue/lump_energy.h"

namespace palpate::scene {

/// Where a lump's share of the force is told, mm of depth.
inline constexpr std::array<double, 3> kToldDepthsMm = {3.0, 5.0, 8.0};

struct PlacedLump {
  std::string name;
  LumpSettings settings;          ///< with its place in numbers
  contact::Lump lump;             ///< as Surface::lumps has it
  double thickness_mm = 0.0;      ///< of the layers at its place
  double young_kpa = 0.0;         ///< in its middle
  double layer_kpa = 0.0;         ///< of the layer at its centre
  std::array<double, 3> share{};  ///< of the force of a fingertip without it, right over it, at kToldDepthsMm
  std::string note;               ///< all of this in a line
  // Inputs of its table, so that it is built only once.
  tissue::LumpEnergy unscaled;
  std::vector<double> made_of;
};

/// The layers of a body, and what was solved of them.
class LumpGround {
 public:
  /// Throws Error where the scene's tissue has no field, or no layers, which `who` ("lumps") need.
  LumpGround(const Scene& scene, const HealthyTissue& healthy, bool layered, std::string_view who);
  ~LumpGround();

  tissue::LayerStack stackAt(double thickness_mm) const;
  std::vector<tissue::WeightedField> fieldsAt(double thickness_mm) const;
  /// Secant of the stack at the depth that a stiffness map means, N/mm.
  double secantAt(double thickness_mm) const;
  double thickest() const;
  std::vector<double> thicknesses() const;  ///< that were solved
  /// Two with the same numbers have the same fields.
  std::vector<double> numbers() const;

 private:
  struct Solved;
  std::unique_ptr<const Solved> solved_;
};

/// The surroundings that lumps are placed in.
struct LumpBed {
  const Scene& scene;
  const Body& body;
  const HealthyTissue& healthy;
  const contact::Surface& surface;  ///< stiffness, thickness and law, before lumps
  bool layered = true;              ///< the tissue that acts
  const World* before = nullptr;    ///< of the same body, or null: its tables are taken over where nothing changed
};

/// The scene's lumps in order; none for a scene without any. `notes` gets what the user should know: a bound of
/// stability that made them softer, neighbours whose forces do not simply add, a lump that slips away. Throws Error
/// with file and line for a lump that cannot be there.
std::vector<std::shared_ptr<const PlacedLump>> placedLumps(const LumpBed& bed, std::vector<std::string>& notes);

/// As a finger feels them; null for none.
std::shared_ptr<const contact::Lumps> feltLumps(const std::vector<std::shared_ptr<const PlacedLump>>& placed);

/// Patterns of pressure on this ground. Throws Error where it has none.
std::shared_ptr<const contact::PressureGround> pressureGround(const LumpGround& ground);
/// In this world, its own where it has them. Throws Error where its tissue has no field.
std::shared_ptr<const contact::PressureGround> pressureGround(const World& world);

// A swelling that is seen and felt at rest: the skin over a lump, raised before anything is built on it.

/// Raises the skin of a body by the scene's lumps; nothing for a scene without swellings. Throws Error, with file and
/// line, for a lump that has no skin over it.
void raiseSkin(const Scene& scene, BodyParts& body);
/// Whether two scenes raise the skin of one body alike.
bool haveEqualSwellings(const Scene& one, const Scene& other);

}  // namespace palpate::scene
