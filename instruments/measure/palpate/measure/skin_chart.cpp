// A thin plate spline from the picture to columns and rows of the stencil. It need not meet the dots exactly: marks
// made by hand are off by some tenths of a millimetre, and the smoothing halves what that does to displacements at a
// steep tilt.
#include "palpate/measure/skin_chart.h"

#include <Eigen/LU>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/measure/thin_plate.h"

namespace palpate::measure {

namespace {

/// On the spline's diagonal, with places counted in spacings: 0 meets every dot.
constexpr double kSmoothing = 0.3;
constexpr std::size_t kMinDots = 6;
constexpr int kInverseSteps = 20;

}  // namespace

Vec2 headUp(const Vec2& in_picture, HeadTowards head) {
  Vec2 headwards = Vec2::UnitY();
  if (head == HeadTowards::left) headwards = -Vec2::UnitX();
  if (head == HeadTowards::bottom) headwards = -Vec2::UnitY();
  if (head == HeadTowards::right) headwards = Vec2::UnitX();
  return {in_picture.dot(Vec2(headwards.y(), -headwards.x())), in_picture.dot(headwards)};
}

struct SkinChart::Impl {
  ThinPlate plate;
  double spacing_px;
  double spacing_mm;
  std::set<std::pair<int, int>> cells = {};  // meshes by their lower left site
};

SkinChart::SkinChart(const DotGrid& grid, double spacing_mm, HeadTowards head) {
  if (grid.dots.size() < kMinDots) throw Error("a chart of the skin needs at least 6 dots in the grid");
  std::vector<Vec2> knots;
  std::vector<Vec2> values;
  std::set<std::pair<int, int>> sites;
  for (const GridDot& dot : grid.dots) {
    const Vec2 site = headUp(Vec2(dot.site.column, dot.site.row), head);
    sites.emplace(static_cast<int>(site.x()), static_cast<int>(site.y()));
    knots.push_back(dot.dot.place_px);
    values.emplace_back(spacing_mm * site);
  }
  impl_ =
      std::make_unique<Impl>(Impl{ThinPlate(knots, values, grid.spacing_px, kSmoothing), grid.spacing_px, spacing_mm});
  for (const auto& [x, y] : sites) {
    for (const auto& [cx, cy] : {std::pair(x, y), std::pair(x - 1, y), std::pair(x, y - 1), std::pair(x - 1, y - 1)}) {
      int corners = 0;
      for (const auto& corner :
           {std::pair(cx, cy), std::pair(cx + 1, cy), std::pair(cx, cy + 1), std::pair(cx + 1, cy + 1)})
        corners += static_cast<int>(sites.contains(corner));
      if (corners >= 3) impl_->cells.emplace(cx, cy);
    }
  }
}

SkinChart::~SkinChart() = default;
SkinChart::SkinChart(SkinChart&&) noexcept = default;

Vec2 SkinChart::skinAt(const Vec2& picture_px) const { return impl_->plate.at(picture_px); }

Mat2 SkinChart::jacobianAt(const Vec2& picture_px) const { return impl_->plate.slopeAt(picture_px); }

Vec2 SkinChart::pictureAt(const Vec2& skin_mm) const {
  const Impl& p = *impl_;
  Vec2 place = p.plate.centre();
  double misfit = (skinAt(place) - skin_mm).norm();
  for (int i = 0; i < kInverseSteps && misfit > 1e-6; ++i) {
    const Mat2 slope = jacobianAt(place);
    if (std::abs(slope.determinant()) < 1e-12 / (p.spacing_px * p.spacing_px)) break;
    Vec2 step = slope.inverse() * (skin_mm - skinAt(place));
    double tried = misfit;
    for (int half = 0; half < 5; ++half, step *= 0.5) {
      tried = (skinAt(place + step) - skin_mm).norm();
      if (tried < misfit) break;
    }
    if (!(tried < misfit)) break;
    place += step;
    misfit = tried;
  }
  return place;
}

bool SkinChart::covers(const Vec2& skin_mm) const {
  const Impl& p = *impl_;
  const Vec2 site = skin_mm / p.spacing_mm;
  if (!(site.cwiseAbs().maxCoeff() < 1e6)) return false;
  return p.cells.contains({static_cast<int>(std::floor(site.x())), static_cast<int>(std::floor(site.y()))});
}

}  // namespace palpate::measure
