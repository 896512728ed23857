// A few rounds: what a place misses its bone by, seen from behind, moves it on the fitted skin.
#include "palpate/body/trunk/above_bones.h"

#include <cmath>
#include <utility>

namespace palpate::body {

void setAboveBones(const TrunkField& field, std::vector<SkinPoint> places, std::vector<SkinLandmark>& landmarks,
                   const ShapeOfSkin& shaped) {
  constexpr int kRounds = 5;
  constexpr double kFacing = 0.5;  // cosine to the z axis from which "straight above" is meant
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<Vec3> skin = shaped(places);
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (std::abs(places[i].normal.z()) <= kFacing) continue;
      const Vec3 off = landmarks[i].bone_position - skin[i];
      places[i] = field.project(places[i].position + Vec3(off.x(), off.y(), 0));
    }
  }
  const std::vector<Vec3> skin = shaped(places);
  for (std::size_t i = 0; i < places.size(); ++i) {
    landmarks[i].position = skin[i];
    landmarks[i].normal = places[i].normal;
  }
}

}  // namespace palpate::body
