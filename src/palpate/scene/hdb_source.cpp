#include "palpate/scene/hdb_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/partition/literal_octree.h"
#include "palpate/partition/traversal_words.h"

namespace palpate::scene {

namespace {

partition::BuildSettings buildSettings(const Scene& scene) {
  partition::BuildSettings settings;
  settings.tree = scene.partition.tree;
  settings.assignment = scene.partition.assign;
  settings.threshold = static_cast<Index>(scene.partition.threshold);
  settings.leaf_below_threshold = scene.fidelity.literal(7);  // E7
  return settings;
}

partition::Partition makePartition(const Scene& scene, const mesh::TriangleMesh& skin, const Progress& progress) {
  const partition::BuildSettings settings = buildSettings(scene);
  const bool octree_by_majority =
      settings.tree == partition::TreeKind::Octree && settings.assignment == partition::Assignment::Majority;
  if (octree_by_majority && scene.fidelity.literal(6)) {  // E6
    return partition::buildLiteralOctree(skin, settings, progress).partition;
  }
  return partition::buildPartition(skin, settings, progress);
}

constexpr std::optional<partition::LiteralTraversal> named(Traversal traversal) {
  return partition::kTraversalWords[static_cast<std::size_t>(traversal)].literal;
}
static_assert(!named(Traversal::corrected) && named(Traversal::else_if) == partition::LiteralTraversal::ElseIf &&
              named(Traversal::half_space) == partition::LiteralTraversal::HalfSpace &&
              named(Traversal::cell_box) == partition::LiteralTraversal::CellBox &&
              named(Traversal::sphere_corners) == partition::LiteralTraversal::SphereCorners);

/// What the scene names; where it names none, what its errata ask for.
std::optional<partition::LiteralTraversal> literalTraversal(const Scene& scene) {
  if (const auto traversal = named(scene.partition.traversal)) return traversal;
  if (scene.partition.query != contact::HdbQuery::leaves) return std::nullopt;  // the text knows leaves only
  return partition::literalTraversal(scene.fidelity, scene.partition.tree);
}

Vec3 boxEdges(const Scene& scene, const partition::Box3& model) {
  if (scene.partition.hdb_edge_mm > 0.0) return Vec3::Constant(scene.partition.hdb_edge_mm);
  using partition::HdbSize;
  const bool as_the_box = scene.fidelity.literal(12);  // E12
  const Vec3 quarter = hdbEdges(model, as_the_box ? HdbSize::QuarterOfBox : HdbSize::QuarterOfLongestEdge);
  return 4.0 * scene.partition.hdb_fraction * quarter;
}

}  // namespace

void checkContactSource(const Scene& scene) {
  if (scene.contact.source != ContactSource::hdb) return;
  for (const Finger& finger : scene.fingers) {
    if (finger.radius_mm == 0.0) continue;
    throw Error(fmt::format("contact source \"hdb\" touches with a point: finger '{}' must have radius_mm = 0, not {}",
                            finger.name, finger.radius_mm));
  }
  if (scene.contact.force_shading) throw Error("contact source \"hdb\" has no force_shading");
}

std::shared_ptr<const contact::HdbSurface> buildHdbSource(const Scene& scene, const mesh::TriangleMesh& skin,
                                                          const contact::Surface& surface, const Progress& progress) {
  checkContactSource(scene);
  report(progress, "partitioning the skin", 0.0);
  auto partition = std::make_shared<const partition::Partition>(makePartition(scene, skin, progress));
  contact::HdbSettings settings;
  settings.edges_mm = boxEdges(scene, partition->bounds);
  settings.query = scene.partition.query;
  settings.literal = literalTraversal(scene);
  const double ticks = std::round(scene.partition.refresh_s * scene.ticks_per_s);
  settings.ticks_per_refresh = static_cast<std::uint32_t>(std::max(1.0, ticks));
  return contact::makeHdbSurface(surface, std::move(partition), settings);
}

std::string describe(const contact::HdbSurface& source) {
  const partition::Partition& partition = *source.partition;
  return fmt::format("touched through a detecting box of {:.0f} mm: {} of {} leaves", source.settings.edges_mm.x(),
                     partition.tree == partition::TreeKind::Bsp ? "BSP tree" : "octree", partition.leaves.size());
}

}  // namespace palpate::scene
