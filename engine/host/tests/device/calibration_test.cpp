// Three places that were touched: the transformation comes back exactly, places that do not tell it are refused in
// words, and what does not fit is said.
#include "palpate/device/calibration.h"
#include "palpate/device/device_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "palpate/base/random.h"
#include "palpate/device/workspace.h"
#include "support/error_message.h"

namespace palpate::device {
namespace {

using Places = std::vector<Vec3>;

DeviceFrame someFrame() { return {.axes = rotationOf({30, -50, 110}), .mm = 1.7, .origin_mm = Vec3(40, -120, 200)}; }

Places touched(const DeviceFrame& frame, const Places& device) {
  Places body;
  for (const Vec3& place : device) body.push_back(frame.placeInBody(place));
  return body;
}

const Places kCorners = {Vec3(0, 0, 0), Vec3(60, 5, 0), Vec3(20, 50, 10)};

TEST(Calibration, OfThreeExactPlacesIsExact) {
  const Calibration found = calibrationOf(kCorners, touched(someFrame(), kCorners));
  EXPECT_LT((found.frame.axes - someFrame().axes).norm(), 1e-12);
  EXPECT_NEAR(found.frame.mm, 1.7, 1e-12);
  EXPECT_LT((found.frame.origin_mm - someFrame().origin_mm).norm(), 1e-10);
  EXPECT_LT(found.residual_mm, 1e-10);
}

TEST(Calibration, NeverMirrorsTheHand) {
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    DeviceFrame frame = someFrame();
    frame.axes = rotationOf({random.uniform(-180, 180), random.uniform(-90, 90), random.uniform(-180, 180)});
    Places body = touched(frame, kCorners);
    for (Vec3& place : body) place += random.uniform3(-2, 2);
    const Calibration found = calibrationOf(kCorners, body);
    EXPECT_NEAR(found.frame.axes.determinant(), 1.0, 1e-9);
    EXPECT_LT((found.frame.axes * found.frame.axes.transpose() - Mat3::Identity()).norm(), 1e-9);
  }
}

TEST(Calibration, SaysHowBadlyThePlacesGoTogether) {
  Places body = touched({}, kCorners);
  body[2] += Vec3(0, 9, 0);
  const Calibration found = calibrationOf(kCorners, body);
  EXPECT_GT(found.residual_mm, 1.0);
  EXPECT_LT(found.residual_mm, 9.0);
  // The best of all: a bit of turn, scale or shift more is worse.
  const auto residual = [&](const DeviceFrame& frame) {
    double square = 0.0;
    for (std::size_t i = 0; i < 3; ++i) square += (frame.placeInBody(kCorners[i]) - body[i]).squaredNorm();
    return std::sqrt(square / 3.0);
  };
  EXPECT_NEAR(residual(found.frame), found.residual_mm, 1e-12);
  for (const double step : {-1e-3, 1e-3}) {
    DeviceFrame scaled = found.frame;
    scaled.mm *= 1.0 + step;
    EXPECT_GT(residual(scaled), found.residual_mm);
    for (int axis = 0; axis < 3; ++axis) {
      DeviceFrame turned = found.frame;
      Vec3 turn = Vec3::Zero();
      turn[axis] = 57.3 * step;
      turned.axes = rotationOf(turn) * turned.axes;
      EXPECT_GT(residual(turned), found.residual_mm) << axis;
      DeviceFrame moved = found.frame;
      moved.origin_mm[axis] += step;
      EXPECT_GT(residual(moved), found.residual_mm) << axis;
    }
  }
}

std::string refusal(const Places& device, const Places& body) {
  return support::thrownMessage([&] { calibrationOf(device, body); });
}

TEST(Calibration, RefusesWhatDoesNotTellAPlace) {
  const Places line = {Vec3(0, 0, 0), Vec3(30, 0, 0), Vec3(60, 2, 0)};
  EXPECT_NE(refusal(line, kCorners).find("points of the device are nearly on a line"), std::string::npos);
  EXPECT_NE(refusal(kCorners, line).find("points of the body are nearly on a line"), std::string::npos);
  const Places straight = {Vec3(0, 0, 0), Vec3(30, 0, 0), Vec3(60, 0, 0)};
  EXPECT_NE(refusal(straight, kCorners).find("0.0 mm wide"), std::string::npos) << refusal(straight, kCorners);
  const Places near = {Vec3(0, 0, 0), Vec3(5, 0, 0), Vec3(0, 5, 0)};
  EXPECT_NE(refusal(near, kCorners).find("are within 7.1 mm"), std::string::npos) << refusal(near, kCorners);
  EXPECT_NE(refusal(Places(3, Vec3(1, 1, 1)), kCorners).find("are within 0.0 mm"), std::string::npos);
  Places none = kCorners;
  none[1].y() = std::nan("");
  EXPECT_NE(refusal(none, kCorners).find("must be finite"), std::string::npos);
  EXPECT_NE(refusal({kCorners[0], kCorners[1]}, kCorners).find("2 device points"), std::string::npos);
  EXPECT_NE(refusal(kCorners, touched({.axes = Mat3::Identity(), .mm = 25.0}, kCorners)).find("0.05 to 20"),
            std::string::npos);
}

TEST(Calibration, OfMorePlacesTakesThemAll) {
  Random random(5);
  Places device;
  for (int i = 0; i < 12; ++i) device.emplace_back(random.uniform(-60, 60), random.uniform(-60, 60), 0.0);
  const Calibration found = calibrationOf(device, touched(someFrame(), device));
  EXPECT_LT((found.frame.axes - someFrame().axes).norm(), 1e-9);
  EXPECT_LT(found.residual_mm, 1e-9);
}

}  // namespace
}  // namespace palpate::device
