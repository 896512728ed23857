// Distance to bone (bones.h) on a grid of 150 x 167 sites over the bare skin -> a bump per group of bones -> two blurs
// along the arc length, the wider subtracted -> coefficients of a spline on the radius.
//
// The bump less its wider blur is a difference of Gaussians (Marr and Hildreth, "Theory of edge detection", 1980),
// and all sizes are our choice.
#include "palpate/body/skin_relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "palpate/base/elementary.h"
#include "palpate/body/bones.h"
#include "palpate/body/skin_outline.h"
#include "palpate/body/skin_table.h"

namespace palpate::body {

namespace {

// Sites of the grid: 3 mm apart, half the finest blur, so that the spline loses nothing of the blur's result.
constexpr int kAcross = 150;
constexpr int kAlong = 167;

/// A bump a exp(-d / L) of the distance d from skin to bone, its blur and the wider blur that is subtracted. Lengths in
/// mm; values chosen by looking at pictures, no source gives them.
struct Group {
  BoneKind kind;
  double height, decay;
  double blur_across, blur_along;
  double wide_across, wide_along;
  double kept;  ///< share of the mean that stays
};
constexpr Group kSpine{BoneKind::vertebra, 8, 6, 5, 4, 9, 22, 0.30};
constexpr Group kRibs{BoneKind::rib, 16, 8, 5, 5, 14, 14, 0.15};
constexpr Group kScapulae{BoneKind::scapula, 6.5, 9, 7, 7, 28, 28, 0.40};

/// A scalar on the grid, row by row across (constant y).
using Layer = std::vector<double>;

std::size_t site(int across, int along) { return static_cast<std::size_t>(along) * kAcross + across; }

/// The grid on the bare skin.
struct Grid {
  std::vector<Vec3> position;
  std::vector<double> radial;  ///< component of the normal along the radius
  Layer inside;                ///< 0 at the side border and beyond, 1 well inside: no relief changes the outline
  Layer along_row;             ///< arc length from the left end of the row, mm
  Layer along_column;          ///< arc length from the lower end of the column, mm
};

/// Outside the outline the fitted surface is extrapolation: those sites repeat the place at the border.
SkinAngle placeOfSite(int across, int along) {
  SkinAngle place = placeOfUnit(splineSite(kAcross, across), splineSite(kAlong, along));
  const double limit = borderAngle(place.y);
  place.angle = std::clamp(place.angle, -limit, limit);
  return place;
}

/// Grows smoothly from the side border inwards.
double insideBorder(const SkinAngle& place) {
  constexpr double kMargin = 4;  // mm, so that the spline's own smoothing does not reach the border
  constexpr double kFade = 45;   // mm; shorter, and the tip of the shoulder shows a dent
  const double distance = kFlatRadius * (borderAngle(place.y) - std::abs(place.angle));
  const double t = std::clamp((distance - kMargin) / kFade, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

Grid makeGrid() {
  const SkinSurface bare;
  Grid grid;
  for (int j = 0; j < kAlong; ++j) {
    for (int i = 0; i < kAcross; ++i) {
      const SkinAngle place = placeOfSite(i, j);
      const SkinPoint point = bare.at(place);
      grid.position.push_back(point.position);
      grid.inside.push_back(insideBorder(place));
      grid.radial.push_back(point.normal.dot(Vec3(elementary::sin(place.angle), 0, elementary::cos(place.angle))));
    }
  }
  // Repeated sites have no distance of their own; the step of the parameter keeps the arc length growing.
  const double least_step = 1.0;  // mm
  grid.along_row.assign(grid.position.size(), 0);
  grid.along_column.assign(grid.position.size(), 0);
  const auto step = [&](std::size_t from, std::size_t to) {
    return std::max(least_step, (grid.position[to] - grid.position[from]).norm());
  };
  for (int j = 0; j < kAlong; ++j) {
    for (int i = 0; i < kAcross; ++i) {
      const std::size_t here = site(i, j);
      if (i > 0) grid.along_row[here] = grid.along_row[here - 1] + step(here - 1, here);
      if (j > 0) grid.along_column[here] = grid.along_column[here - kAcross] + step(here - kAcross, here);
    }
  }
  return grid;
}

/// Gaussian blur of the `count` values at `first`, `first + stride`, ..., lying at the places `at`.
void blurLine(const Layer& at, std::size_t first, std::size_t stride, int count, double sigma, const Layer& from,
              Layer& to) {
  const double reach = 2.7 * sigma;  // beyond it the weight is below 3 %
  int low = 0;
  for (int i = 0; i < count; ++i) {
    const std::size_t here = first + i * stride;
    while (at[first + low * stride] < at[here] - reach) ++low;
    double sum = 0;
    double weights = 0;
    for (int k = low; k < count; ++k) {
      const std::size_t there = first + k * stride;
      const double offset = at[there] - at[here];
      if (offset > reach) break;
      const double weight = elementary::exp(-0.5 * offset * offset / (sigma * sigma));
      sum += weight * from[there];
      weights += weight;
    }
    to[here] = sum / weights;
  }
}

/// The rest of a blur when the spline, whose coefficients are the samples, does its part.
double beforeSpline(double sigma) {
  constexpr double kStep = 3.0;                          // mm between sites
  constexpr double kSplineVariance = kStep * kStep / 3;  // cubic B-spline
  return std::sqrt(sigma * sigma - kSplineVariance);
}

Layer blurred(const Grid& grid, const Layer& layer, double across, double along) {
  across = beforeSpline(across);
  along = beforeSpline(along);
  Layer rows(layer.size());
  Layer both(layer.size());
  for (int j = 0; j < kAlong; ++j) blurLine(grid.along_row, site(0, j), 1, kAcross, across, layer, rows);
  for (int i = 0; i < kAcross; ++i) blurLine(grid.along_column, site(i, 0), kAcross, kAlong, along, rows, both);
  return both;
}

/// The weight of a height: constant within each part of the back, linear between the parts.
double levelWeight(const LevelWeights& weights, double y) {
  // Heights of the spinous tips at the ends of the parts: T2, T3, T9, T10, L2, L3.
  constexpr std::array<double, 6> kEnds = {152, 129, -34, -62, -173, -201};
  for (std::size_t part = 0; part < 3; ++part) {
    const double high = kEnds[2 * part];
    const double low = kEnds[2 * part + 1];
    if (y >= high) return weights[part];
    if (y > low) return weights[part] + (high - y) / (high - low) * (weights[part + 1] - weights[part]);
  }
  return weights[3];
}

void addGroup(const Grid& grid, std::span<const Bone> bones, const Group& group, double factor,
              const LevelWeights& weights, Layer& sum) {
  if (factor == 0) return;
  std::vector<Bone> of_kind;
  std::copy_if(bones.begin(), bones.end(), std::back_inserter(of_kind),
               [&](const Bone& bone) { return bone.kind == group.kind; });
  const BoneDepth depth = depthToBones(grid.position, of_kind);
  Layer bump(grid.position.size());
  for (std::size_t i = 0; i < bump.size(); ++i) {
    bump[i] = factor * group.height * levelWeight(weights, grid.position[i].y()) *
              elementary::exp(-depth.depth_mm[i] / group.decay);
  }
  const Layer narrow = blurred(grid, bump, group.blur_across, group.blur_along);
  const Layer wide = blurred(grid, bump, group.wide_across, group.wide_along);
  for (std::size_t i = 0; i < bump.size(); ++i) sum[i] += narrow[i] - (1 - group.kept) * wide[i];
}

/// The long muscles along the spine are seldom equally strong: fuller on the right at the loin, flatter on the left at
/// the chest.
void addMuscles(const Grid& grid, double amount, Layer& sum) {
  struct Bulge {
    double x, y, height;
  };
  constexpr Bulge kBulges[] = {{38, -110, 1.6}, {-38, 40, -1.0}};
  constexpr double kWidth = 24;   // mm, where the bulge has fallen to 1/e
  constexpr double kLength = 90;  // mm
  for (std::size_t i = 0; i < sum.size(); ++i) {
    for (const Bulge& bulge : kBulges) {
      const double dx = (grid.position[i].x() - bulge.x) / kWidth;
      const double dy = (grid.position[i].y() - bulge.y) / kLength;
      sum[i] += amount * bulge.height * elementary::exp(-dx * dx - dy * dy);
    }
  }
}

}  // namespace

ReliefSettings noRelief() {
  ReliefSettings none;
  none.spine = none.ribs = none.scapulae = 0;
  return none;
}

BicubicSpline skinDetail(std::span<const Bone> bones, const ReliefSettings& settings, double muscle_asymmetry) {
  const Grid grid = makeGrid();
  Layer sum(grid.position.size(), 0);
  addGroup(grid, bones, kSpine, settings.spine, settings.spine_level, sum);
  addGroup(grid, bones, kRibs, settings.ribs, settings.rib_level, sum);
  addGroup(grid, bones, kScapulae, settings.scapulae, settings.scapula_level, sum);
  if (muscle_asymmetry != 0) addMuscles(grid, muscle_asymmetry, sum);
  std::vector<double> coefficients(sum.size());
  for (int i = 0; i < kAcross; ++i) {
    for (int j = 0; j < kAlong; ++j) {
      // A displacement along the normal as a change of the radius; on the crest of the shoulder, where the radius runs
      // along the skin, it is bounded.
      const double radial = std::max(0.45, grid.radial[site(i, j)]);
      coefficients[static_cast<std::size_t>(i) * kAlong + j] = sum[site(i, j)] * grid.inside[site(i, j)] / radial;
    }
  }
  return {kAcross, kAlong, std::move(coefficients)};
}

}  // namespace palpate::body
