// Runs each search at the same places of the same models, and compares the results.
#include "dissertation/search/search_measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lab/measured/model_meshes.h"
#include "lab/measured/stopwatch.h"
#include "palpate/deform/region_by_rings.h"
#include "palpate/hdb/haptic_box.h"
#include "palpate/hdb/vertex_search.h"
#include "palpate/maps/ellipse.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::study {

namespace {

constexpr double kTipDepthMm = 5.0;
// The tip's nearest point is at most this far: the least radius of a sphere of 3.4.1.
constexpr double kReachMm = 10.0;
constexpr maps::Ellipse kRegion{60.0, 0.75, 1.5707963267948966};

struct Model {
  std::string name;
  mesh::TriangleMesh mesh;
};

/// The searched structures, built once a model and threshold.
struct Searched {
  const mesh::TriangleMesh& mesh;
  const tree::TriangleTree& tree;
  const deform::Skin& skin;
  hdb::VertexSearch& octree;
  hdb::LeafHits leaves{};
  std::vector<Index> found{};
};

std::array<Vec3, 3> cornersOfTriangle(const mesh::TriangleMesh& mesh, Index t) {
  const Triangle& corners = mesh.triangles[t];
  return {mesh.positions[corners[0]], mesh.positions[corners[1]], mesh.positions[corners[2]]};
}

double nearest2(const Searched& on, const Vec3& tip, std::span<const Index> triangles, double so_far) {
  for (const Index t : triangles) {
    so_far = std::min(so_far, tree::closestOnTriangle(cornersOfTriangle(on.mesh, t), tip).squared_distance);
  }
  return so_far;
}

double nearest2OfAll(const Searched& on, const Vec3& tip) {
  double nearest = kReachMm * kReachMm;
  for (Index t = 0; t < on.mesh.triangles.size(); ++t) {
    nearest = std::min(nearest, tree::closestOnTriangle(cornersOfTriangle(on.mesh, t), tip).squared_distance);
  }
  return nearest;
}

double nearest2InOctree(Searched& on, const Vec3& tip) {
  hdb::findLeavesInSphere(on.octree.octree(), tip, kReachMm, on.leaves);
  double nearest = kReachMm * kReachMm;
  for (const Index leaf : on.leaves.leaves) {
    nearest = nearest2(on, tip, hdb::trianglesOf(on.octree.octree(), on.octree.octree().nodes[leaf]), nearest);
  }
  return nearest;
}

/// The ellipse at a place, in its tangent plane.
struct RegionAt {
  SkinPlace place;
  maps::SurfaceEllipse ellipse;
  double far_mm = 0.0;

  bool holds(const Vec3& position) const {
    const Vec3 offset = maps::projectedOnPlane(position, place.point, place.normal) - place.point;
    return (position - place.point).squaredNorm() <= far_mm * far_mm && maps::locationRatio(ellipse, offset) < 1.0;
  }
};

// Reaches as far along the normal as along the skin: neither search may take the other side of a thick body.
RegionAt regionAt(const SkinPlace& place) {
  return {place, maps::liftedOntoSurface(kRegion, place.normal), kRegion.half_major_mm};
}

std::size_t regionOfAll(Searched& on, const RegionAt& region) {
  on.found.clear();
  for (Index v = 0; v < on.mesh.positions.size(); ++v) {
    if (region.holds(on.mesh.positions[v])) on.found.push_back(v);
  }
  return on.found.size();
}

std::size_t regionInOctree(Searched& on, const RegionAt& region) {
  on.found.clear();
  for (const Index v : on.octree.find(hdb::hapticBox(region.place.point, 2.0 * region.far_mm))) {
    if (region.holds(on.mesh.positions[v])) on.found.push_back(v);
  }
  return on.found.size();
}

void searchRegion(deform::RegionByRings& rings, const Searched& on, const RegionAt& region) {
  const Vec3f normal = region.place.normal.cast<float>();
  rings.find(on.skin, on.mesh.triangles[region.place.triangle], deform::RingRule::connected, [&](Index v) {
    if (!region.holds(on.mesh.positions[v])) return deform::Place::outside;
    return on.skin.restNormal(v).dot(normal) > 0.0f ? deform::Place::inside : deform::Place::staying;
  });
}

void compareRegions(SearchRow& row, Searched& on, const deform::RegionByRings& rings, const RegionAt& region,
                    double share) {
  regionInOctree(on, region);
  std::vector<bool> in_octree(on.mesh.positions.size(), false);
  for (const Index v : on.found) in_octree[v] = true;
  for (Index v = 0; v < on.mesh.positions.size(); ++v) {
    if (rings.reached(v)) row.region_vertices += share;
    if (in_octree[v] && !rings.reached(v)) row.region_stray += share;
    if (!in_octree[v] && rings.reached(v)) ++row.region_missed;
  }
}

// Barycentric places of instruments/study/lab/measured have no triangle: the nearest one is used.
std::vector<SkinPlace> placesWithTriangles(const Model& model, const tree::TriangleTree& tree, int count) {
  std::vector<SkinPlace> places = skinPlaces(model.mesh, count);
  for (SkinPlace& place : places) {
    place.triangle = tree.source_triangle[tree::nearestPoint(tree, place.point, kReachMm).triangle];
  }
  return places;
}

SearchRow measured(const Model& model, Index threshold, const SearchPlan& plan) {
  const tree::TriangleTree tree = tree::buildTriangleTree(model.mesh);
  const deform::Skin skin = deform::buildSkin(model.mesh);
  hdb::VertexSearch octree(model.mesh, threshold);
  Searched on{model.mesh, tree, skin, octree};
  on.leaves.prepareFor(octree.octree());
  deform::RegionByRings rings(skin);
  SearchRow row{.model = model.name,
                .vertices = model.mesh.positions.size(),
                .triangles = model.mesh.triangles.size(),
                .threshold = threshold};
  const double share = 1.0 / plan.places;
  volatile double kept = 0.0;  // so that no search is optimised away
  for (const SkinPlace& place : placesWithTriangles(model, tree, plan.places)) {
    const Vec3 tip = place.point - kTipDepthMm * place.normal;
    const auto touch = [&](const auto& search) {
      return share * shortestMicroseconds(plan.runs, [&] { kept = search(); });
    };
    row.touch_all_us += share * shortestMicroseconds(2, [&] { kept = nearest2OfAll(on, tip); });
    row.touch_octree_us += touch([&] { return nearest2InOctree(on, tip); });
    row.touch_ours_us += touch([&] { return tree::nearestPoint(tree, tip, kReachMm).closest.squared_distance; });
    row.touch_tested += share * static_cast<double>(hdb::entriesIn(octree.octree(), on.leaves.leaves));
    if (nearest2InOctree(on, tip) != nearest2OfAll(on, tip)) ++row.touch_wrong;
    const RegionAt region = regionAt(place);
    row.region_all_us += touch([&] { return static_cast<double>(regionOfAll(on, region)); });
    row.region_octree_us += touch([&] { return static_cast<double>(regionInOctree(on, region)); });
    row.region_rings_us += share * shortestMicroseconds(plan.runs, [&] { searchRegion(rings, on, region); });
    compareRegions(row, on, rings, region, share);
  }
  return row;
}

}  // namespace

SearchPlan searchPlan(bool quick) {
  if (quick) return {.backs = {kBackTriangles}, .thresholds = {1024, 16}, .places = 6, .runs = 2};
  return {.backs = {kBackTriangles, 20389, 41582}, .thresholds = {1024, 16}, .places = 60, .runs = 20};
}

SearchMeasurement measureSearches(const SearchPlan& plan, const Progress& progress) {
  std::vector<Model> models;
  for (const std::size_t triangles : plan.backs) models.push_back({"back", backModel(triangles)});
  models.push_back({"hand", openHandModel(kHandTriangles)});
  models.push_back({"hand", openHandModel(kNamelessTriangles)});
  SearchMeasurement found{.plan = plan, .rows = {}};
  for (std::size_t i = 0; i < models.size(); ++i) {
    report(progress, fmt::format("{} of {} triangles", models[i].name, models[i].mesh.triangles.size()),
           static_cast<double>(i) / static_cast<double>(models.size()));
    for (const Index threshold : plan.thresholds) found.rows.push_back(measured(models[i], threshold, plan));
  }
  return found;
}

}  // namespace palpate::study
