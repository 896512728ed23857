// The points of the skeleton that an examiner finds by touch, from the places that each shape names.
#include "palpate/body/skeleton/skeleton.h"
#include "palpate/body/skeleton/skeleton_shapes.h"
#include "palpate/body/tetrahedra_mesher.h"

namespace palpate::body {
namespace {

// Adds a point of a right bone and its mirror image. `%` in the names is the side.
class Pairs {
 public:
  explicit Pairs(std::vector<Landmark>& landmarks) : landmarks_(landmarks) {}
  void add(const std::string& name, const std::string& bone, const Vec3& right) {
    landmarks_.push_back({sided(name, "right"), sided(bone, "right"), right});
    landmarks_.push_back({sided(name, "left"), sided(bone, "left"), mirrored(right)});
  }

 private:
  static std::string sided(std::string text, const char* side) { return text.replace(text.find('%'), 1, side); }
  std::vector<Landmark>& landmarks_;
};

void addSpine(std::vector<Landmark>& landmarks) {
  for (const VertebraRow& row : cervicalRows()) {
    landmarks.push_back({std::string("spinous_") + row.name, row.name, vertebraFrame(row) * cervicalSpinousTip(row)});
  }
  for (const VertebraRow& row : trunkSpineRows()) {
    landmarks.push_back({std::string("spinous_") + row.name, row.name, vertebraFrame(row) * spinousTip(row)});
  }
  const SacrumPoints sacrum = sacrumPoints();
  for (std::size_t i = 0; i < sacrum.median_crest.size(); ++i) {
    landmarks.push_back({"sacrum_S" + std::to_string(i + 1), "sacrum", sacrum.median_crest[i]});
  }
  landmarks.push_back({"coccyx_tip", "sacrum", sacrum.coccyx_tip});
}

void addRibs(Pairs& pairs) {
  for (int rib = 1; rib <= kRibCount; ++rib) {
    const std::string name = "rib_" + std::to_string(rib) + "_%";
    pairs.add(name + "_angle", name, rightRibAngle(rib, trunkRibRows()[rib - 1]));
  }
  for (int rib = 1; rib <= kCartilageCount; ++rib) {
    const std::string number = std::to_string(rib);
    pairs.add("costochondral_" + number + "_%", "rib_" + number + "_%", rightCostochondralPoint(rib));
  }
}

void addPelvis(Pairs& pairs) {
  const HipPoints hip = rightHipPoints();
  pairs.add("psis_%", "hip_%", hip.posterior_superior_spine);
  pairs.add("asis_%", "hip_%", hip.anterior_superior_spine);
  pairs.add("iliac_crest_top_%", "hip_%", hip.crest_top);
  pairs.add("ischial_tuberosity_%", "hip_%", hip.ischial_tuberosity);
  pairs.add("pubic_tubercle_%", "hip_%", hip.pubic_tubercle);
}

void addShoulder(Pairs& pairs) {
  const ScapulaPoints scapula = rightScapulaPoints(trunkScapulaPlace());
  pairs.add("scapula_%_superior_angle", "scapula_%", scapula.superior_angle);
  pairs.add("scapula_%_spine_root", "scapula_%", scapula.spine_root);
  pairs.add("scapula_%_inferior_angle", "scapula_%", scapula.inferior_angle);
  pairs.add("scapula_%_acromial_angle", "scapula_%", scapula.acromial_angle);
  pairs.add("acromion_%", "scapula_%", rightAcromionTip());
  const ClaviclePoints clavicle = rightClaviclePoints();
  pairs.add("clavicle_%_sternal_end", "clavicle_%", clavicle.sternal_end);
  pairs.add("clavicle_%_acromial_end", "clavicle_%", clavicle.acromial_end);
  pairs.add("greater_tubercle_%", "humerus_%", rightGreaterTubercle());
}

}  // namespace

std::vector<Landmark> skeletonLandmarks() {
  std::vector<Landmark> landmarks;
  addSpine(landmarks);
  Pairs pairs(landmarks);
  addRibs(pairs);
  addPelvis(pairs);
  addShoulder(pairs);
  const SternumPoints sternum = sternumPoints();
  landmarks.push_back({"jugular_notch", "sternum", sternum.jugular_notch});
  landmarks.push_back({"sternal_angle", "sternum", sternum.sternal_angle});
  landmarks.push_back({"xiphoid_tip", "sternum", sternum.xiphoid_tip});
  return landmarks;
}

}  // namespace palpate::body
