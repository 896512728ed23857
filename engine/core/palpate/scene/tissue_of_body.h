// Layered tissue laid over the bones of a body: how thick it is at each vertex, which stack that is, how stiff, and
// what it makes of a contact.
//
//   skin-to-bone depth, fat ─ placedTissue, at load ─► World::layered, Surface::tissue_mm ─ layeredContact, 60 Hz ─►
//   deform
#pragma once

#include <memory>
#include <vector>

#include "palpate/deform/contact.h"
#include "palpate/scene/world.h"

namespace palpate::scene {

struct PlacedTissue {
  std::shared_ptr<const tissue::LayeredTissue> layered;  ///< null: the body is not layered
  std::vector<double> thickness_mm;                      ///< over the bone, a skin vertex each; empty likewise
  std::vector<double> felt_mm;  ///< likewise, as it is felt: over narrow bone as if there were more (narrow_bone.h)
};

/// Places the layers over the bones by their depths, a skin vertex each. `given`: in place of the library's and the
/// scene's table, or null. Throws Error for a table that cannot be read.
PlacedTissue placedTissue(const Scene& scene, const std::vector<double>& bone_depth_mm,
                          std::shared_ptr<const tissue::LayeredTissue> given);

/// mm of fat that the scene means: its own number, or by the mass index of the body. // tissue-data: 2 to 25 mm
double fatOf(const Scene& scene);

/// Returns the stiffness of the map per vertex: the secant at the reference depth, as it is felt.
std::vector<double> secantStiffness(const PlacedTissue& tissue);

/// The contact, which has the map's ellipse for its drag, with curves and regions of the tissue at its anchor. The
/// world must be layered. No allocation; any thread.
deform::Contact layeredContact(const World& world, deform::Contact contact) noexcept;

/// How regions follow the anatomy of a body, where the scene's deformation asks for it: layered tissue, or the shape
/// "contour" without a table of its own. Null otherwise. `layered`: the body's, or null.
std::shared_ptr<const AnatomicalReach> reachOf(const Scene& scene, const mesh::TriangleMesh& skin,
                                               const Anatomy& anatomy, const tree::TriangleTree& tree,
                                               const tissue::LayeredTissue* layered);

/// The boundary of the contact's drag: the map's ellipse, shorter towards bones and folds. The world must have a reach.
maps::SurfaceContour anatomicalContour(const World& world, const deform::Contact& contact) noexcept;

}  // namespace palpate::scene
