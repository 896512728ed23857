// Only halves of the midline and right bones are ever built and reduced; the rest are mirror images.
#include "palpate/body/drawn_bones.h"

#include <utility>

#include "palpate/base/background.h"
#include "palpate/base/error.h"
#include "palpate/body/tetrahedra_mesher.h"
#include "palpate/mesh/decimate.h"

namespace palpate::body {
namespace {

// The default grid: a coarse result never shows a fine grid's detail, and the time goes with its square.
constexpr double kFineCellMm = 1.5;
constexpr double kCoarseCellMm = 2.0;
constexpr double kMinCellMm = 0.5;
constexpr double kLargestCellMm = 3.0;  // beyond it the mesher loses the thin parts

bool inRows(const BonePlan& plan) { return plan.kind == BoneKind::rib || plan.kind == BoneKind::cartilage; }

// The plan of a bone, and its side.
struct Place {
  std::size_t plan;
  enum class Side { midline, right, left } side;
};

std::vector<Place> order(const std::vector<BonePlan>& plans) {
  std::vector<Place> places;
  for (std::size_t i = 0; i < plans.size();) {
    std::size_t end = i + 1;
    while (inRows(plans[i]) && end < plans.size() && plans[end].kind == plans[i].kind) ++end;
    if (plans[i].midline) {
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

std::vector<std::size_t> shareOfPlans(const std::vector<BonePlan>& plans, std::size_t total) {
  double weights = 0.0;
  for (const BonePlan& plan : plans) weights += plan.weight * (plan.midline ? 1.0 : 2.0);
  std::vector<std::size_t> counts;
  std::size_t given = 0;
  std::size_t vertebrae = 0;  // which come first
  for (const BonePlan& plan : plans) {
    counts.push_back(2 * static_cast<std::size_t>(0.5 * static_cast<double>(total) * plan.weight / weights));
    given += counts.back() * (plan.midline ? 1 : 2);
    vertebrae += plan.kind == BoneKind::vertebra ? 1 : 0;
  }
  // The remainder of rounding down, two triangles per vertebra, again from the first on.
  for (std::size_t i = 0; given + 1 < total; i = (i + 1) % vertebrae, given += 2) counts[i] += 2;
  return counts;
}

mesh::TriangleMesh drawn(const BonePlan& plan, std::size_t triangles, double cell_mm) {
  mesh::TriangleMesh shape = plan.shape(cell_mm);
  mesh::DecimateOptions options;
  options.mirrored_at_x0 = plan.midline;
  const std::size_t wanted = plan.midline ? triangles / 2 : triangles;
  if (shape.triangles.size() < wanted)
    throw Error("bones: too many triangles for this grid cell; use fewer, or a smaller cell");
  shape = mesh::decimate(std::move(shape), wanted, options);
  if (plan.midline) shape = withMirrorImage(std::move(shape));
  return inFrame(plan.frame, std::move(shape));
}

// Every second plan by another thread: neighbours in the list cost about the same.
std::vector<mesh::TriangleMesh> drawAll(const std::vector<BonePlan>& plans, const std::vector<std::size_t>& counts,
                                        double cell_mm) {
  std::vector<mesh::TriangleMesh> meshes(plans.size());
  const auto work = [&](std::size_t first) {
    for (std::size_t i = first; i < plans.size(); i += 2) meshes[i] = drawn(plans[i], counts[i], cell_mm);
  };
  Background other([&] { work(1); });
  work(0);
  other.join();
  return meshes;
}

}  // namespace

BonePlan vertebraPlan(const VertebraRow& row) {
  return {row.name,          BoneKind::vertebra, 1.0, true, [&row](double cell) { return makeVertebraHalf(row, cell); },
          vertebraFrame(row)};
}

BonePlan ribPlan(int number, const RibRow& row, SweptEnd anterior) {
  const double weight = number <= 2 || number >= 11 ? 0.45 : 0.7;
  return {"rib_" + std::to_string(number), BoneKind::rib, weight, false,
          [number, &row, anterior](double) { return makeRightRib(number, row, kSweptEdgeMm, anterior); }};
}

BonePlan scapulaPlan(const ScapulaPlace& place) {
  constexpr double kCell = 1.25;  // relative to the vertebrae: it is larger and smoother
  return {"scapula", BoneKind::scapula, 2.2, false,
          [place](double cell) { return makeRightScapula(kCell * cell, place); }};
}

std::vector<std::size_t> DrawnBones::share(std::size_t total) const {
  const std::vector<std::size_t> counts = shareOfPlans(plans, total);
  std::vector<std::size_t> all;
  for (const Place& place : order(plans)) all.push_back(counts[place.plan]);
  return all;
}

std::vector<Bone> DrawnBones::draw(std::size_t triangles, double cell_mm) const {
  if (triangles % 2 != 0) throw Error("bones: the number of triangles must be even (closed surfaces)");
  if (triangles < fewest) throw Error(std::string(need) + " at least " + std::to_string(fewest) + " triangles");
  if (cell_mm != 0.0 && !(cell_mm >= kMinCellMm && cell_mm <= kLargestCellMm)) {
    throw Error("bones: the grid cell must be 0.5 to 3 mm");
  }
  const double fitting = triangles < fine_from ? kCoarseCellMm : kFineCellMm;
  const std::vector<mesh::TriangleMesh> meshes =
      drawAll(plans, shareOfPlans(plans, triangles), cell_mm > 0.0 ? cell_mm : fitting);
  std::vector<Bone> bones;
  for (const auto& [i, side] : order(plans)) {
    const BonePlan& plan = plans[i];
    const bool left = side == Place::Side::left;
    const char* suffix = left ? "_left" : side == Place::Side::right ? "_right" : "";
    bones.push_back({plan.name + suffix, plan.kind, left ? mirrored(meshes[i]) : meshes[i]});
  }
  return bones;
}

}  // namespace palpate::body
