// From the scene's [partition] and its errata to the museum's surface: which partition, which box, which traversal.
//
// Based on: Ji, dissertation 2008, chapter 3, with E4 to E7 and E10 to E12.
#include "palpate/scene/hdb_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/hdb/literal_octree.h"
#include "palpate/hdb/literal_traversal.h"

namespace palpate::scene {

namespace {

hdb::BuildSettings buildSettings(const Scene& scene) {
  hdb::BuildSettings settings = scene.partition.build;
  settings.leaf_below_threshold = scene.fidelity.literal(Erratum::E7_leaf_threshold);
  return settings;
}

hdb::Partition makePartition(const Scene& scene, const mesh::TriangleMesh& skin, const Progress& progress) {
  const hdb::BuildSettings settings = buildSettings(scene);
  const bool octree_by_majority =
      settings.tree == hdb::TreeKind::Octree && settings.assignment == hdb::Assignment::Majority;
  if (octree_by_majority && scene.fidelity.literal(Erratum::E6_three_octants)) {
    return hdb::buildLiteralOctree(skin, settings, progress).partition;
  }
  return hdb::buildPartition(skin, settings, progress);
}

/// The traversal that the scene names, or else the one that its errata ask for.
std::optional<hdb::LiteralTraversal> literalTraversal(const Scene& scene) {
  if (scene.partition.traversal) return scene.partition.traversal;
  if (scene.partition.query != hdb::HdbQuery::leaves) return std::nullopt;  // the text knows leaves only
  return hdb::literalTraversal(scene.fidelity, scene.partition.build.tree);
}

Vec3 boxEdges(const Scene& scene, const Box3& model) {
  if (scene.partition.hdb_edge_mm > 0.0) return Vec3::Constant(scene.partition.hdb_edge_mm);
  using hdb::HdbSize;
  const bool as_the_box = scene.fidelity.literal(Erratum::E12_box_edges);
  const Vec3 quarter = hdbEdges(model, as_the_box ? HdbSize::QuarterOfBox : HdbSize::QuarterOfLongestEdge);
  return 4.0 * scene.partition.hdb_fraction * quarter;
}

}  // namespace

void checkContactSource(const Scene& scene) {
  if (scene.contact.source != ContactSource::hdb) return;
  for (const Finger& finger : scene.fingers) {
    if (finger.radius_mm == 0.0) continue;
    throw Error(
        fmt::format("contact source \"hdb\" supports point fingers only: finger '{}' must have radius_mm = 0, not {}",
                    finger.name, finger.radius_mm));
  }
  if (scene.contact.finger.force_shading)
    throw Error("contact source \"hdb\" does not support force_shading; set it to false");
}

std::shared_ptr<const hdb::HdbSurface> buildHdbSource(const Scene& scene, const mesh::TriangleMesh& skin,
                                                      const contact::Surface& surface, const Progress& progress) {
  checkContactSource(scene);
  report(progress, "partitioning the skin", 0.0);
  auto partition = std::make_shared<const hdb::Partition>(makePartition(scene, skin, progress));
  hdb::HdbSettings settings;
  settings.edges_mm = boxEdges(scene, partition->bounds);
  settings.query = scene.partition.query;
  settings.literal = literalTraversal(scene);
  const double ticks = std::round(scene.partition.refresh_s * scene.ticks_per_s);
  settings.ticks_per_refresh = static_cast<std::uint32_t>(std::max(1.0, ticks));
  return hdb::makeHdbSurface(surface, std::move(partition), settings);
}

std::string describe(const hdb::HdbSurface& source) {
  const hdb::Partition& partition = *source.partition;
  return fmt::format("touched through a detecting box of {:.0f} mm: {} of {} leaves", source.settings.edges_mm.x(),
                     titleOf(partition.tree), partition.leaves.size());
}

}  // namespace palpate::scene
