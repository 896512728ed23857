// Tissue over a narrow bone gives way beside it.
#include "palpate/tissue/narrow_bone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <span>

#include "palpate/tissue/layered_library.h"

namespace palpate::tissue {
namespace {

TEST(NarrowBone, ShareIsTheSolvedOneAndOneOverAPlane) {
  EXPECT_DOUBLE_EQ(shareOverNarrowBone(9.0, 3.0), 0.615);
  EXPECT_DOUBLE_EQ(shareOverNarrowBone(13.0, 8.0), 0.823);
  EXPECT_DOUBLE_EQ(shareOverNarrowBone(20.0, 40.0), 0.952);
  for (const double thickness : {3.0, 9.0, 15.0, 40.0}) {
    EXPECT_EQ(shareOverNarrowBone(thickness, kFlatBoneMm), 1.0) << thickness;
  }
  EXPECT_EQ(shareOverNarrowBone(kDeepBoneMm, 3.0), 1.0);
  EXPECT_LT(shareOverNarrowBone(25.0, 3.0), 1.0);
}

TEST(NarrowBone, ShareRisesWithThicknessAndRadiusWithoutSteps) {
  for (double thickness = 5.0; thickness < 60.0; thickness += 0.5) {
    for (double radius = 2.0; radius < 100.0; radius *= 1.02) {
      const double share = shareOverNarrowBone(thickness, radius);
      ASSERT_GE(share, 0.615);
      ASSERT_LE(share, 1.0);
      ASSERT_GE(shareOverNarrowBone(thickness + 0.1, radius), share) << thickness << " " << radius;
      ASSERT_GE(shareOverNarrowBone(thickness, 1.02 * radius), share) << thickness << " " << radius;
      ASSERT_LE(shareOverNarrowBone(thickness + 0.1, radius), share + 0.01) << thickness << " " << radius;
      ASSERT_LE(shareOverNarrowBone(thickness, 1.02 * radius), share + 0.01) << thickness << " " << radius;
    }
  }
}

double feltThickness(const LayeredTissue& tissue, double thickness_mm, float bone_radius_mm) {
  return feltThicknesses(tissue, std::span(&thickness_mm, 1), std::span(&bone_radius_mm, 1)).front();
}

TEST(NarrowBone, TheFeltThicknessPushesBackByTheShareAtBothDepthsTogether) {
  const LayeredTissue tissue(libraryNodes(8.0));
  for (const double thickness : {9.0, 12.0, 18.0}) {
    for (const float radius : {3.0f, 6.0f, 15.0f}) {
      const double felt = feltThickness(tissue, thickness, radius);
      EXPECT_GT(felt, thickness);
      const auto share_at = [&](double depth_mm) {
        return tissue.secantAt(felt, depth_mm) / tissue.secantAt(thickness, depth_mm);
      };
      const double squared_share = share_at(kLightDepthMm) * share_at(kFirmDepthMm);
      EXPECT_NEAR(std::sqrt(squared_share), shareOverNarrowBone(thickness, static_cast<double>(radius)), 1e-6)
          << thickness << " " << radius;
    }
    EXPECT_EQ(feltThickness(tissue, thickness, static_cast<float>(kFlatBoneMm)), thickness);
  }
}

}  // namespace
}  // namespace palpate::tissue
