// How thick and how stiff a body is before anything is wrong with it, and the map with what is wrong.
//
//   anatomy, settings ─ healthyTissue ─► HealthyTissue ─ diseasedStiffness, dysfunctions ─► Surface::stiffness_n_per_mm
//
// Worlds of one body share what is healthy as long as its settings are the same, and the map itself where nothing is
// wrong; a dysfunction costs a copy of the map and the blocks that it reaches.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "palpate/maps/key_points.h"
#include "palpate/scene/body.h"
#include "palpate/scene/scene.h"
#include "palpate/scene/tissue_of_body.h"

namespace palpate::scene {

/// Where the stiffness changes most within a millimetre.
struct SteepPlace {
  double n_per_mm_in_a_mm = 0.0;
  std::size_t triangle = 0;
};

/// All settings that decide it; files besides.
struct HealthySettings {
  bool layered = false;
  double fat_mm = 0.0;
  bool by_finger_radius = true;
  bool narrow_bone = true;
  StiffnessSource source = StiffnessSource::automatic;
  double constant_n_per_mm = 0.0;
  maps::DepthLaw depth;
  maps::NaturalVariation variation;
  friend bool operator==(const HealthySettings&, const HealthySettings&) = default;
};

struct HealthyTissue {
  HealthySettings settings;
  bool lasts = true;    ///< false: a file or key points decide it too, and it is made again
  PlacedTissue tissue;  ///< layers and their thickness; empty where there are none
  std::shared_ptr<const std::vector<double>> stiffness_n_per_mm;  ///< a skin vertex each; never null
  std::vector<SteepPlace> steepest;                               ///< of each of Body::triangle_blocks
  std::vector<std::string> notes;
};

/// `before`: of the same body, to be taken over where nothing has changed; or null. Throws Error as scene::build does.
std::shared_ptr<const HealthyTissue> healthyTissue(const Scene& scene, const Body& body, TissueModel model,
                                                   const std::vector<maps::KeyPoint>& keys,
                                                   std::shared_ptr<const HealthyTissue> before);

/// At a place of the skin in this triangle, mm, however narrow the bone is; 0 where there are no layers.
double thicknessOverBone(const HealthyTissue& healthy, const tree::TriangleRecord& under, const Vec3& place) noexcept;

struct DiseasedStiffness {
  std::shared_ptr<const std::vector<double>> n_per_mm;  ///< a skin vertex each; the healthy one where nothing differs
  SteepPlace steepest;
};

/// With the scene's dysfunctions; `notes` gets those that change nothing.
DiseasedStiffness diseasedStiffness(const Scene& scene, const Body& body, const HealthyTissue& healthy,
                                    std::vector<std::string>& notes);

}  // namespace palpate::scene
