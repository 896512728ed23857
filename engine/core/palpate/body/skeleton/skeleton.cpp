// Puts the 74 bones together: shape (skeleton_shapes.h, bone_shapes.h), reduce (mesh/decimate.h), mirror. A list has
// each bone's maker and share of the triangles; two threads work it off.
#include "palpate/body/skeleton/skeleton.h"

#include <functional>
#include <numeric>
#include <utility>

#include "palpate/base/background.h"
#include "palpate/base/error.h"
#include "palpate/body/skeleton/skeleton_shapes.h"
#include "palpate/body/tetrahedra_mesher.h"
#include "palpate/mesh/decimate.h"

namespace palpate::body {
namespace {

// The default grid, as in bones.cpp.
constexpr double kFineSkeletonCellMm = 1.5;
constexpr double kCoarseSkeletonCellMm = 2.0;
constexpr std::size_t kFineSkeletonFrom = 60000;  // triangles
constexpr double kMinSkeletonCellMm = 0.5;
constexpr double kLargestSkeletonCellMm = 3.0;
constexpr double kSweptEdgeMm = 2.2;  // for ribs, cartilages and clavicles

// A bone that is drawn: a half of the midline, joined with its mirror image, or a right one, mirrored for the left.
struct Plan {
  std::string name;  // without its side
  BoneKind kind;
  double weight;  // share in the triangles, relative: the visible error after reduction is alike
  bool midline;
  std::function<mesh::TriangleMesh(double cell_mm)> shape;  // cell of a vertebra
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
};

Plan vertebraPlan(const VertebraRow& row) {
  return {row.name,          BoneKind::vertebra, 1.0, true, [&row](double cell) { return makeVertebraHalf(row, cell); },
          vertebraFrame(row)};
}

Plan cervicalPlan(const VertebraRow& row) {
  return {row.name,
          BoneKind::vertebra,
          1.0,
          true,
          [&row](double cell) { return makeCervicalHalf(row, 0.9 * cell); },
          vertebraFrame(row)};
}

Plan ribPlan(int number) {
  const double weight = number <= 2 || number >= 11 ? 0.45 : 0.7;
  const SweptEnd end = number <= kCartilageCount ? kCostochondralEnd : SweptEnd{};
  return {"rib_" + std::to_string(number), BoneKind::rib, weight, false,
          [number, end](double) { return makeRightRib(number, trunkRibRows()[number - 1], kSweptEdgeMm, end); }};
}

Plan cartilagePlan(int number) {
  return {"cartilage_" + std::to_string(number), BoneKind::cartilage, number >= 5 && number <= 7 ? 0.3 : 0.18, false,
          [number](double) { return makeRightCartilage(number, kSweptEdgeMm); }};
}

// In the order of the bones, a pair being named once.
std::vector<Plan> plans() {
  std::vector<Plan> list;
  for (const VertebraRow& row : cervicalRows()) list.push_back(cervicalPlan(row));
  for (const VertebraRow& row : trunkSpineRows()) list.push_back(vertebraPlan(row));
  list.push_back({"sacrum", BoneKind::sacrum, 2.4, true, [](double cell) { return makeSacrumHalf(1.35 * cell); }});
  list.push_back({"hip", BoneKind::hip, 2.8, false, [](double cell) { return makeRightHip(1.65 * cell); }});
  for (int number = 1; number <= kRibCount; ++number) list.push_back(ribPlan(number));
  for (int number = 1; number <= kCartilageCount; ++number) list.push_back(cartilagePlan(number));
  list.push_back({"sternum", BoneKind::sternum, 0.9, true, [](double cell) { return makeSternumHalf(1.25 * cell); }});
  list.push_back({"clavicle", BoneKind::clavicle, 0.5, false, [](double) { return makeRightClavicle(kSweptEdgeMm); }});
  list.push_back({"scapula", BoneKind::scapula, 2.2, false,
                  [](double cell) { return makeRightScapula(1.25 * cell, trunkScapulaPlace()); }});
  list.push_back({"humerus", BoneKind::humerus, 0.7, false, [](double cell) { return makeRightHumerus(2.0 * cell); }});
  return list;
}

// Ribs and cartilages come in two rows, first all right ones and then all left ones; other pairs side by side.
bool inRows(const Plan& plan) { return plan.kind == BoneKind::rib || plan.kind == BoneKind::cartilage; }

// The plan of a bone, and its side.
struct Place {
  std::size_t plan;
  enum class Side { midline, right, left } side;
};

std::vector<Place> order(const std::vector<Plan>& list) {
  std::vector<Place> places;
  for (std::size_t i = 0; i < list.size();) {
    std::size_t end = i + 1;
    while (inRows(list[i]) && end < list.size() && list[end].kind == list[i].kind) ++end;
    if (list[i].midline) {
      places.push_back({i, Place::Side::midline});
    } else {
      for (const auto side : {Place::Side::right, Place::Side::left}) {
        for (std::size_t k = i; k < end; ++k) places.push_back({k, side});
      }
    }
    i = end;
  }
  return places;
}

std::vector<std::size_t> shares(const std::vector<Plan>& list, std::size_t total) {
  double weights = 0.0;
  for (const Plan& plan : list) weights += plan.weight * (plan.midline ? 1.0 : 2.0);
  std::vector<std::size_t> counts;
  std::size_t given = 0;
  for (const Plan& plan : list) {
    counts.push_back(2 * static_cast<std::size_t>(0.5 * static_cast<double>(total) * plan.weight / weights));
    given += counts.back() * (plan.midline ? 1 : 2);
  }
  // The remainder of rounding down, two triangles per vertebra, again from C5 on.
  constexpr std::size_t kVertebrae = kCervicalCount + kVertebraCount;
  for (std::size_t i = 0; given + 1 < total; i = (i + 1) % kVertebrae, given += 2) counts[i] += 2;
  return counts;
}

void check(const SkeletonSettings& settings) {
  if (settings.triangles % 2 != 0) throw Error("bones: the number of triangles must be even (closed surfaces)");
  if (settings.triangles < kFewestSkeletonTriangles) {
    throw Error("the skeleton needs at least " + std::to_string(kFewestSkeletonTriangles) + " triangles");
  }
  if (settings.cell_mm != 0.0 &&
      !(settings.cell_mm >= kMinSkeletonCellMm && settings.cell_mm <= kLargestSkeletonCellMm)) {
    throw Error("bones: the grid cell must be 0.5 to 3 mm");
  }
}

mesh::TriangleMesh drawn(const Plan& plan, std::size_t triangles, double cell_mm) {
  mesh::TriangleMesh shape = plan.shape(cell_mm);
  mesh::DecimateOptions options;
  options.mirrored_at_x0 = plan.midline;
  const std::size_t wanted = plan.midline ? triangles / 2 : triangles;
  if (shape.triangles.size() < wanted)
    throw Error("bones: too many triangles for this grid cell; use fewer, or a smaller cell");
  shape = mesh::decimate(std::move(shape), wanted, options);
  if (plan.midline) shape = withMirrorImage(std::move(shape));
  for (Vec3& p : shape.positions) p = plan.frame * p;
  return shape;
}

// Every second plan by another thread: neighbours in the list cost about the same.
std::vector<mesh::TriangleMesh> drawAll(const std::vector<Plan>& list, const std::vector<std::size_t>& counts,
                                        double cell_mm) {
  std::vector<mesh::TriangleMesh> meshes(list.size());
  const auto work = [&](std::size_t first) {
    for (std::size_t i = first; i < list.size(); i += 2) meshes[i] = drawn(list[i], counts[i], cell_mm);
  };
  Background other([&] { work(1); });
  work(0);
  other.join();
  return meshes;
}

}  // namespace

std::vector<std::size_t> shareSkeletonTriangles(std::size_t total) {
  const std::vector<Plan> list = plans();
  const std::vector<std::size_t> counts = shares(list, total);
  std::vector<std::size_t> all;
  for (const Place& place : order(list)) all.push_back(counts[place.plan]);
  return all;
}

std::vector<Bone> makeSkeleton(const SkeletonSettings& settings) {
  check(settings);
  const std::vector<Plan> list = plans();
  const double fitting = settings.triangles < kFineSkeletonFrom ? kCoarseSkeletonCellMm : kFineSkeletonCellMm;
  const std::vector<mesh::TriangleMesh> meshes =
      drawAll(list, shares(list, settings.triangles), settings.cell_mm > 0.0 ? settings.cell_mm : fitting);
  std::vector<Bone> bones;
  for (const Place& place : order(list)) {
    const Plan& plan = list[place.plan];
    const mesh::TriangleMesh& mesh = meshes[place.plan];
    switch (place.side) {
      case Place::Side::midline:
        bones.push_back({plan.name, plan.kind, mesh});
        break;
      case Place::Side::right:
        bones.push_back({plan.name + "_right", plan.kind, mesh});
        break;
      case Place::Side::left:
        bones.push_back({plan.name + "_left", plan.kind, mirrored(mesh)});
        break;
    }
  }
  return bones;
}

}  // namespace palpate::body
