#include "palpate/body/skin_surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "palpate/base/csv.h"
#include "palpate/base/text.h"
#include "palpate/body/back.h"
#include "palpate/body/bicubic_spline.h"
#include "palpate/body/skin_table.h"
#include "support/places.h"

namespace palpate::body {
namespace {

std::vector<Vec3> scanSample() {
  const std::string file = (support::testData() / "body/back_scan_sample.csv").string();
  std::vector<Vec3> points;
  forEachCsvRow(readFile(file, 1 << 20), file, [&](const CsvRow& row) {
    if (looksLikeCsvHeader(row)) return;
    points.emplace_back(csvNumber(row, 0, "x_mm"), csvNumber(row, 1, "y_mm"), csvNumber(row, 2, "z_mm"));
  });
  return points;
}

/// Distance along the normal, to first order: the skin is taken as flat between the point and the ray through it.
double distanceToSkin(const SkinSurface& skin, const Vec3& point) {
  const SkinPoint foot = skin.at({std::atan2(point.x(), point.z() - kSkinAxisZ), point.y()});
  return (point - foot.position).dot(foot.normal);
}

/// RMS and largest distance of the sample from the skin, mm.
struct Misfit {
  double rms = 0;
  double largest = 0;
};

Misfit misfit(const SkinSurface& skin) {
  double sum = 0;
  double largest = 0;
  const std::vector<Vec3> sample = scanSample();
  for (const Vec3& point : sample) {
    const double distance = distanceToSkin(skin, point);
    sum += distance * distance;
    largest = std::max(largest, std::abs(distance));
  }
  EXPECT_EQ(sample.size(), 800u);
  return {std::sqrt(sum / static_cast<double>(sample.size())), largest};
}

TEST(SkinSurface, LiesOnTheScan) {
  const Misfit bare = misfit(SkinSurface());
  EXPECT_LE(bare.rms, 0.25);
  EXPECT_LE(bare.largest, 3.0);
}

TEST(SkinSurface, DefaultReliefStaysOnTheScan) { EXPECT_LE(misfit(makeSkinSurface(SkinSettings{})).rms, 0.5); }

TEST(SkinSurface, IsItsOwnMirrorImage) {
  const SkinSurface skin;
  for (double y = -290; y <= 200; y += 17) {
    for (double angle = 0.03; angle < 1.2; angle += 0.11) {
      const SkinPoint right = skin.at({angle, y});
      const SkinPoint left = skin.at({-angle, y});
      EXPECT_NEAR((right.position - Vec3(-left.position.x(), left.position.y(), left.position.z())).norm(), 0, 1e-9);
      EXPECT_NEAR((right.normal - Vec3(-left.normal.x(), left.normal.y(), left.normal.z())).norm(), 0, 1e-9);
    }
  }
}

TEST(SkinSurface, NormalIsPerpendicularToTheSurfaceAlsoWhenItIsBent) {
  const SkinSurface skin(1750, {}, {.amount = 1});
  const double step = 1e-5;
  for (double y = -280; y <= 190; y += 13) {
    for (double angle = -0.75; angle < 0.75; angle += 0.1) {
      const SkinPoint here = skin.at({angle, y});
      const Vec3 around = skin.at({angle + step, y}).position - skin.at({angle - step, y}).position;
      const Vec3 upward = skin.at({angle, y + 100 * step}).position - skin.at({angle, y - 100 * step}).position;
      EXPECT_NEAR(here.normal.norm(), 1, 1e-12);
      EXPECT_NEAR(here.normal.dot(around.normalized()), 0, 1e-6);
      EXPECT_NEAR(here.normal.dot(upward.normalized()), 0, 1e-6);
      EXPECT_GT(here.normal.dot(Vec3(std::sin(angle), 0, std::cos(angle))), 0) << "points into the body";
    }
  }
}

TEST(SkinSurface, GrowsWithStature) {
  const SkinSurface man;
  const SkinSurface child(1400);
  const SkinAngle place{0.4, -50};
  EXPECT_NEAR((child.at(place).position - 0.8 * man.at(place).position).norm(), 0, 1e-9);
}

TEST(SkinSurface, HeightOverFindsTheSkinAboveAPoint) {
  const SkinSurface skin;
  for (double angle = -0.6; angle < 0.65; angle += 0.1) {
    const Vec3 point = skin.at({angle, -120}).position;
    EXPECT_NEAR(skin.heightOver(point.x(), point.y()), point.z(), 1e-6);
  }
}

TEST(BicubicSpline, ReproducesALineFromSamplesAtItsSites) {
  std::vector<double> samples;
  for (int i = 0; i < 7; ++i) {
    for (int j = 0; j < 9; ++j) samples.push_back(3 + 2 * splineSite(7, i) - 5 * splineSite(9, j));
  }
  const BicubicSpline spline(7, 9, samples);
  for (double u = 0; u <= 1; u += 0.07) {
    const SplineValue here = spline.at(u, 1 - u);
    EXPECT_NEAR(here.value, 3 + 2 * u - 5 * (1 - u), 1e-12);
    EXPECT_NEAR(here.du, 2, 1e-11);
    EXPECT_NEAR(here.dv, -5, 1e-11);
  }
}

TEST(Asymmetry, JacobianIsTheDerivativeOfTheWarp) {
  const Asymmetry asymmetry{.amount = 1.5};
  const double step = 1e-5;
  for (const Vec3& point : {Vec3(0, 0, 50), Vec3(95, 100, 40), Vec3(-60, -150, 80), Vec3(170, 140, 10)}) {
    const Mat3 jacobian = warp(asymmetry, point).jacobian;
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 offset = step * Vec3::Unit(axis);
      const Vec3 slope =
          (warp(asymmetry, point + offset).position - warp(asymmetry, point - offset).position) / (2 * step);
      EXPECT_NEAR((jacobian.col(axis) - slope).norm(), 0, 1e-8);
    }
  }
}

}  // namespace
}  // namespace palpate::body
