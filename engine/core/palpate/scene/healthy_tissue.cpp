// Stiffness by its source (depth of the bone, key points or a constant), its variation, then dysfunctions over it,
// block by block: skin is in blocks with boxes in the map plane, and only blocks that a dysfunction reaches are
// computed again. Each block keeps its steepest place: a world notes where its map is too steep for one tick
// (world.cpp).
#include "palpate/scene/healthy_tissue.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "palpate/base/error.h"
#include "palpate/tissue/narrow_bone.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::scene {

namespace {

using KeyPoints = std::vector<maps::KeyPoint>;

StiffnessSource resolvedSource(const Scene& scene, const Body& body) {
  if (scene.stiffness.source != StiffnessSource::automatic) return scene.stiffness.source;
  const bool boneless = scene.body.kind == BodyKind::mesh && body.anatomy.depth_mm.empty();
  return boneless ? StiffnessSource::constant : StiffnessSource::depth;
}

std::vector<double> stiffnessFromPoints(const Scene& scene, const std::vector<Vec3>& positions, const KeyPoints& keys,
                                        std::vector<std::string>& notes) {
  const bool any = std::any_of(keys.begin(), keys.end(), [](const auto& key) { return key.stiffness_n_per_mm; });
  if (!any)
    throw Error("stiffness source \"points\" requires key points with a stiffness column ([ellipses] key_points)");
  maps::StiffnessOfPositions stiffness = maps::measuredStiffness(positions, keys, scene.stiffness.points);
  if (stiffness.limited > 0) {
    notes.push_back(
        fmt::format("stiffness: the fit left the range of the key points at {} of {} vertices and was clamped there",
                    stiffness.limited, positions.size()));
  }
  return std::move(stiffness.n_per_mm);
}

std::vector<double> healthyStiffness(const Scene& scene, const Body& body, const KeyPoints& keys,
                                     const PlacedTissue& tissue, std::vector<std::string>& notes) {
  if (!body.given_stiffness_n_per_mm.empty()) return body.given_stiffness_n_per_mm;
  switch (resolvedSource(scene, body)) {
    case StiffnessSource::depth:
      if (body.anatomy.depth_mm.empty())
        throw Error("stiffness source \"depth\" requires bones; use a built-in body or a fitted mesh");
      if (tissue.layered) return secantStiffness(tissue);
      return maps::stiffnessFromDepth(body.anatomy.depth_mm, scene.stiffness.depth);
    case StiffnessSource::points:
      return stiffnessFromPoints(scene, body.skin.positions, keys, notes);
    default:
      return std::vector<double>(body.skin.positions.size(), scene.stiffness.constant_n_per_mm);
  }
}

/// N/mm a mm along the skin; 0 for a triangle without area.
double stiffnessGradient(const mesh::TriangleMesh& skin, const std::array<Index, 3>& t,
                         const std::vector<double>& stiffness) {
  const Vec3 a = skin.positions[t[1]] - skin.positions[t[0]];
  const Vec3 b = skin.positions[t[2]] - skin.positions[t[0]];
  const double area = a.cross(b).norm();
  const double along_a = stiffness[t[1]] - stiffness[t[0]];
  const double along_b = stiffness[t[2]] - stiffness[t[0]];
  return area > 0.0 ? (along_a * b - along_b * a).norm() / area : 0.0;
}

/// The first of the steepest among these triangles; of none: flat.
SteepPlace findSteepest(const mesh::TriangleMesh& skin, std::size_t block, const std::vector<double>& stiffness) {
  SteepPlace steepest;
  const std::size_t end = std::min((block + 1) * PlaneBlocks::kSize, skin.triangles.size());
  for (std::size_t t = block * PlaneBlocks::kSize; t < end; ++t) {
    const double steepness = stiffnessGradient(skin, skin.triangles[t], stiffness);
    if (steepness > steepest.n_per_mm_in_a_mm) steepest = {steepness, t};
  }
  return steepest;
}

HealthySettings settingsOf(const Scene& scene, const Body& body, TissueModel model) {
  return {.layered = model == TissueModel::layered,
          .fat_mm = fatOf(scene),
          .by_finger_radius = scene.tissue.by_finger_radius,
          .narrow_bone = scene.tissue.narrow_bone,
          .source = resolvedSource(scene, body),
          .constant_n_per_mm = scene.stiffness.constant_n_per_mm,
          .depth = scene.stiffness.depth,
          .variation = scene.stiffness.variation};
}

// ---- what is wrong

bool reaches(const maps::Dysfunction& d, const Eigen::AlignedBox2d& box) {
  return box.squaredExteriorDistance(Vec2(d.x_mm, d.y_mm)) < d.radius_mm * d.radius_mm;
}

bool anyReaches(const std::vector<maps::Dysfunction>& dysfunctions, const Eigen::AlignedBox2d& box) {
  return std::ranges::any_of(dysfunctions, [&](const maps::Dysfunction& d) { return reaches(d, box); });
}

double nearestVertexMm(const std::vector<Vec3>& positions, const Vec2& centre) {
  double nearest_mm2 = std::numeric_limits<double>::infinity();
  for (const Vec3& p : positions) nearest_mm2 = std::min(nearest_mm2, (p.head<2>() - centre).squaredNorm());
  return std::sqrt(nearest_mm2);
}

/// Vertices `from` to `to` of a block.
struct VertexRange {
  std::size_t from, to;
};
VertexRange vertexRange(const Body& body, std::size_t block) {
  const std::size_t from = block * PlaneBlocks::kSize;
  return {from, std::min(from + PlaneBlocks::kSize, body.skin.positions.size())};
}

bool isFelt(const Body& body, const maps::Dysfunction& d) {
  const Vec2 centre(d.x_mm, d.y_mm);
  for (std::size_t block = 0; block < body.vertex_blocks.boxes.size(); ++block) {
    if (!reaches(d, body.vertex_blocks.boxes[block])) continue;
    const auto [from, to] = vertexRange(body, block);
    for (std::size_t v = from; v < to; ++v) {
      if (std::sqrt((body.skin.positions[v].head<2>() - centre).squaredNorm()) < d.radius_mm) return true;
    }
  }
  return false;
}

/// Notes dysfunctions off the body or between its vertices: they change nothing, and are most likely a typing error.
void noteUnfelt(const std::vector<maps::Dysfunction>& dysfunctions, const Body& body, std::vector<std::string>& notes) {
  for (std::size_t i = 0; i < dysfunctions.size(); ++i) {
    const maps::Dysfunction& d = dysfunctions[i];
    if (isFelt(body, d)) continue;
    notes.push_back(
        fmt::format("dysfunction {} at ({}, {}) mm has no effect: its radius is {} mm, but the nearest skin vertex is "
                    "{:.3g} mm away",
                    i + 1, d.x_mm, d.y_mm, d.radius_mm, nearestVertexMm(body.skin.positions, Vec2(d.x_mm, d.y_mm))));
  }
}

/// The map plane is seen from behind: what is wrong with the back of the trunk leaves its front as it is.
void applyInBlock(const Scene& scene, const Body& body, const std::vector<double>& healthy, std::size_t block,
                  std::vector<double>& stiffness) {
  const auto [from, to] = vertexRange(body, block);
  maps::applyDysfunctions(std::span(body.skin.positions).subspan(from, to - from), scene.dysfunctions,
                          std::span(stiffness).subspan(from, to - from));
  if (body.front.empty()) return;
  for (std::size_t v = from; v < to; ++v) {
    if (body.front[v] != 0) stiffness[v] = healthy[v];
  }
}

}  // namespace

std::shared_ptr<const HealthyTissue> healthyTissue(const Scene& scene, const Body& body, TissueModel model,
                                                   const KeyPoints& keys, std::shared_ptr<const HealthyTissue> before) {
  const HealthySettings settings = settingsOf(scene, body, model);
  const bool lasts = scene.tissue.layer_table.empty() && settings.source != StiffnessSource::points;
  if (before && before->lasts && lasts && before->settings == settings) return before;
  HealthyTissue healthy{
      .settings = settings, .lasts = lasts, .tissue = {}, .stiffness_n_per_mm = {}, .steepest = {}, .notes = {}};
  if (settings.layered) {
    healthy.tissue = placedTissue(scene, body.anatomy.depth_mm, body.given_layers);
    PlacedTissue& tissue = healthy.tissue;
    const std::vector<float>& bone_radius_mm = body.anatomy.bone_radius_mm;
    if (settings.narrow_bone && !bone_radius_mm.empty())
      tissue.felt_mm = tissue::feltThicknesses(*tissue.layered, tissue.thickness_mm, bone_radius_mm);
  }
  std::vector<double> stiffness = healthyStiffness(scene, body, keys, healthy.tissue, healthy.notes);
  maps::applyVariation(body.skin.positions, settings.variation, stiffness);
  healthy.steepest.resize(body.triangle_blocks.boxes.size());
  for (std::size_t block = 0; block < healthy.steepest.size(); ++block) {
    healthy.steepest[block] = findSteepest(body.skin, block, stiffness);
  }
  healthy.stiffness_n_per_mm = std::make_shared<const std::vector<double>>(std::move(stiffness));
  return std::make_shared<const HealthyTissue>(std::move(healthy));
}

double thicknessOverBone(const HealthyTissue& healthy, const tree::TriangleRecord& under, const Vec3& place) noexcept {
  const std::vector<double>& thickness_mm = healthy.tissue.thickness_mm;
  if (thickness_mm.empty()) return 0.0;
  const Vec3 weights = tree::barycentricWeights(under.corners, place);
  double mm = 0.0;
  for (int i = 0; i < 3; ++i) mm += weights[i] * thickness_mm[under.vertices[static_cast<std::size_t>(i)]];
  return mm;
}

DiseasedStiffness diseasedStiffness(const Scene& scene, const Body& body, const HealthyTissue& healthy,
                                    std::vector<std::string>& notes) {
  DiseasedStiffness diseased{.n_per_mm = healthy.stiffness_n_per_mm, .steepest = {}};
  const auto& vertex_boxes = body.vertex_blocks.boxes;
  std::shared_ptr<std::vector<double>> own;
  for (std::size_t block = 0; block < vertex_boxes.size(); ++block) {
    if (!anyReaches(scene.dysfunctions, vertex_boxes[block])) continue;
    if (!own) own = std::make_shared<std::vector<double>>(*healthy.stiffness_n_per_mm);
    applyInBlock(scene, body, *healthy.stiffness_n_per_mm, block, *own);
  }
  if (own) diseased.n_per_mm = std::move(own);
  for (std::size_t block = 0; block < healthy.steepest.size(); ++block) {
    const bool changed = anyReaches(scene.dysfunctions, body.triangle_blocks.boxes[block]);
    const SteepPlace steepest = changed ? findSteepest(body.skin, block, *diseased.n_per_mm) : healthy.steepest[block];
    if (steepest.n_per_mm_in_a_mm > diseased.steepest.n_per_mm_in_a_mm) diseased.steepest = steepest;
  }
  noteUnfelt(scene.dysfunctions, body, notes);
  return diseased;
}

}  // namespace palpate::scene
