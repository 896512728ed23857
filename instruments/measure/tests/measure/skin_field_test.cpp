// The formula of dragged skin at places where its value is known by hand.
#include "palpate/measure/field/skin_field.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpate::measure {
namespace {

/// Round, ln W = ln(1 / w^2).
SkinField roundField(double width_mm) {
  const double log_weight = -2.0 * std::log(width_mm);
  return {.log_shape = {log_weight, 0.0, log_weight}, .peak_mm = {0.0, 20.0}};
}

TEST(SkinField, IsTheWholePeakAtTheContact) {
  EXPECT_NEAR((displacementAt(roundField(50.0), {0.0, 0.0}) - Vec2(0.0, 20.0)).norm(), 0.0, 1e-12);
}

TEST(SkinField, WithoutATailIsTheHalfGaussian) {
  EXPECT_NEAR(displacementAt(roundField(50.0), {50.0, 0.0}).y(), 20.0 * std::exp(-1.0), 1e-12);
}

TEST(SkinField, WithATailFallsByItsPower) {
  SkinField field = roundField(50.0);
  field.inverse_tail = 1.0 / 0.8;
  EXPECT_NEAR(displacementAt(field, {0.0, 100.0}).y(), 20.0 * std::pow(1.0 + 4.0 / 0.8, -0.8), 1e-12);
}

TEST(SkinField, WithKappaMovesAlongTheLineFromTheContactToo) {
  SkinField field = roundField(50.0);
  field.sideways = 0.5;
  // At 45 degrees a peak upwards is half along the line from the contact; rho is 1.
  const Vec2 place = Vec2(1.0, 1.0).normalized() * 50.0;
  const Vec2 moved = displacementAt(field, place);
  const Vec2 expected = (Vec2(0.0, 20.0) + 0.5 * 0.5 * Vec2(10.0, 10.0)) * std::exp(-1.0);
  EXPECT_NEAR((moved - expected).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace palpate::measure
