// All overlays of a picture as lines and patches; only the wireframe is drawn from the skin's own buffers.
//
//   Look, DrawnSkin, fingers ─► Overlays ─ ellipses, partition, marks.h ─► OverlayShapes ─► LineLayer
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "palpate/contact/finger_state.h"
#include "palpate/contact/surface.h"
#include "palpate/hdb/haptic_box.h"
#include "palpate/hdb/partition.h"
#include "palpate/scene/world.h"
#include "palpate/view/drawn_skin.h"
#include "palpate/view/finger_pose.h"
#include "palpate/view/lines.h"
#include "palpate/view/look.h"
#include "palpate/view/overlays/pressure_pad.h"

namespace palpate::view {

/// The dissertation's partition, drawn: leaves, splitting planes, and the cells in the detecting box of a finger (Fig
/// 3.6).
/// A partition of the world's skin, and the edges of the detecting box.
struct ShownPartition {
  std::shared_ptr<const hdb::Partition> partition;
  Vec3 box_edges_mm = Vec3::Zero();
};

/// The one that this world's fingers use; built from the scene's settings when they use none.
ShownPartition makeShownPartition(const scene::World& world);

/// The cells of the leaves, blue.
void addLeafBoxes(const hdb::Partition& partition, Lines& lines);

/// Every splitting plane within its cell: square to x green, to y red, to z yellow; fainter level by level.
void addPlanes(const hdb::Partition& partition, Lines& lines, Patches& patches);

/// The box round the finger's proxy.
void addDetectingBox(const ShownPartition& shown, const contact::FingerOutput& contact, Lines& lines);

/// The triangles of all leaves that the box meets, green: the haptic process's input.
void addHapticTriangles(const ShownPartition& shown, const scene::World& world, const DrawnSkin& skin,
                        const contact::FingerOutput& contact, Patches& patches);

// Deformation ellipses as outlines on the skin that move with it.

/// A place of the skin that moves with it: a triangle and the weights of its corners.
struct SkinSpot {
  Triangle vertices{};
  Vec3f weights = Vec3f::Zero();
};

/// The point where a segment first enters the skin at rest.
std::optional<SkinSpot> spotBetween(const contact::Surface& surface, const Vec3& from, const Vec3& to);

inline Vec3 placeOf(const SkinSpot& spot, const DrawnSkin& skin) {
  Vec3 place = Vec3::Zero();
  for (int i = 0; i < 3; ++i) place += static_cast<double>(spot.weights[i]) * skin.at(spot.vertices[i]);
  return place;
}

/// The parts of outlines over the skin: pieces of a closed curve.
using Outline = std::vector<std::vector<SkinSpot>>;

/// The ellipse round `centre` in the plane square to `normal` (unit), seen along it onto the skin.
Outline outlineOf(const scene::World& world, const maps::SurfaceEllipse& ellipse, const Vec3& centre,
                  const Vec3& normal);

/// Outlines of the map's key points, seen along z as the map is. Costs some 0.1 ms an ellipse: keep them.
std::vector<Outline> keyOutlines(const scene::World& world);

void addOutline(const Outline& outline, const DrawnSkin& skin, Paint paint, Lines& lines);

/// A muscle as a drawing: its fibres next to each other, from origin to insertion, with the same number of spots in
/// each.
struct MuscleSheet {
  Paint paint;
  std::vector<std::vector<SkinSpot>> fibres;
};

/// The regions that a finger's normal and tangential part move.
void addContactEllipses(const scene::World& world, const contact::FingerOutput& contact, const DrawnSkin& skin,
                        Lines& lines);

struct OverlayShapes {
  Patches patches;
  Lines thin{1.3, {}};
  Lines bold{2.6, {}};
  Patches seen_through;  ///< drawn over everything
  Patches solid;         ///< bodies under the skin
};

/// Keeps shapes that stay the same from picture to picture. The world must outlive it.
class Overlays {
 public:
  explicit Overlays(const scene::World& world) : world_(world) {}

  void setPartition(ShownPartition shown) {
    partition_ = shown.partition ? std::optional(std::move(shown)) : std::nullopt;
  }

  /// The shapes of the look. Valid until the next call.
  const OverlayShapes& shapes(const Look& look, const DrawnSkin& skin, std::span<const FingerMark> fingers);

 private:
  void addBody(const Look& look, const DrawnSkin& skin);
  void addPartition(const Look& look);
  void addFinger(const Look& look, const DrawnSkin& skin, const contact::FingerOutput& contact);
  void addBeneath(const Look& look, const DrawnSkin& skin, std::span<const FingerMark> fingers);
  void addTouch(const Look& look, const DrawnSkin& skin, const contact::FingerOutput& contact);
  const ShownPartition& partition();
  const std::vector<Outline>& keyEllipses();

  const scene::World& world_;
  std::optional<ShownPartition> partition_;           // made when first shown
  std::optional<std::vector<Outline>> key_ellipses_;  // made when first shown
  std::optional<PadReader> pads_;                     // made when first shown
  std::optional<std::vector<MuscleSheet>> muscles_;   // made when first shown
  OverlayShapes shapes_;
};

}  // namespace palpate::view
