// The list of the 74 bones (drawn_bones.h): those of the back, from the same shapes, and those around them.
#include "palpate/body/skeleton/skeleton.h"

#include "palpate/body/drawn_bones.h"
#include "palpate/body/skeleton/skeleton_shapes.h"

namespace palpate::body {
namespace {

BonePlan cervicalPlan(const VertebraRow& row) {
  BonePlan plan = vertebraPlan(row);
  plan.shape = [&row](double cell) { return makeCervicalHalf(row, 0.9 * cell); };
  return plan;
}

BonePlan cartilagePlan(int number) {
  return {"cartilage_" + std::to_string(number), BoneKind::cartilage, number >= 5 && number <= 7 ? 0.3 : 0.18, false,
          [number](double) { return makeRightCartilage(number, kSweptEdgeMm); }};
}

// In the order of the bones, a pair being named once.
DrawnBones bonesOfTrunk() {
  DrawnBones bones{{}, "the skeleton needs", kFewestSkeletonTriangles, 60000};
  std::vector<BonePlan>& list = bones.plans;
  for (const VertebraRow& row : cervicalRows()) list.push_back(cervicalPlan(row));
  for (const VertebraRow& row : trunkSpineRows()) list.push_back(vertebraPlan(row));
  list.push_back({"sacrum", BoneKind::sacrum, 2.4, true, [](double cell) { return makeSacrumHalf(1.35 * cell); }});
  list.push_back({"hip", BoneKind::hip, 2.8, false, [](double cell) { return makeRightHip(1.65 * cell); }});
  for (int number = 1; number <= kRibCount; ++number) {
    const SweptEnd end = number <= kCartilageCount ? kCostochondralEnd : SweptEnd{};
    list.push_back(ribPlan(number, trunkRibRows()[number - 1], end));
  }
  for (int number = 1; number <= kCartilageCount; ++number) list.push_back(cartilagePlan(number));
  list.push_back({"sternum", BoneKind::sternum, 0.9, true, [](double cell) { return makeSternumHalf(1.25 * cell); }});
  list.push_back({"clavicle", BoneKind::clavicle, 0.5, false, [](double) { return makeRightClavicle(kSweptEdgeMm); }});
  list.push_back(scapulaPlan(trunkScapulaPlace()));
  list.push_back({"humerus", BoneKind::humerus, 0.7, false, [](double cell) { return makeRightHumerus(2.0 * cell); }});
  return bones;
}

}  // namespace

std::vector<std::size_t> shareSkeletonTriangles(std::size_t total) { return bonesOfTrunk().share(total); }

std::vector<Bone> makeSkeleton(const SkeletonSettings& settings) {
  return bonesOfTrunk().draw(settings.triangles, settings.cell_mm);
}

}  // namespace palpate::body
