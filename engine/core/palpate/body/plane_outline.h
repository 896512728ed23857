// Signed distance in a plane to a closed curve through a few points, tabulated: bones that are bent plates (scapula,
// hip bone, sternum) ask for it millions of times.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "palpate/body/cubic_spline.h"
#include "palpate/body/signed_distance.h"

namespace palpate::body {

class PlaneOutline {
 public:
  /// The grid of the table; it should leave the outline's box a margin wider than any blend.
  struct Table {
    Vec2 low;
    int columns, rows;
    double step_mm = 1.0;
  };

  /// The periodic spline through `points` (z is ignored) as a polygon of `corners` even sides.
  PlaneOutline(std::span<const Vec3> points, std::size_t corners, const Table& table) : table_(table) {
    for (const Vec3& p : CubicSpline(points, CubicSpline::Ends::closed).evenly(corners)) {
      polygon_.emplace_back(p.x(), p.y());
    }
    for (int j = 0; j < table.rows; ++j) {
      for (int i = 0; i < table.columns; ++i) values_.push_back(exact(table.low + table.step_mm * Vec2(i, j)));
    }
  }

  /// Bilinear in the table; outside it the value at its rim, which is far from the bone.
  double distance(const Vec2& p) const {
    const Vec2 q =
        ((p - table_.low) / table_.step_mm).cwiseMax(0.0).cwiseMin(Vec2(table_.columns - 1.001, table_.rows - 1.001));
    const auto i = static_cast<std::size_t>(q.x());
    const auto j = static_cast<std::size_t>(q.y());
    const auto columns = static_cast<std::size_t>(table_.columns);
    const double* cell = &values_[j * columns + i];
    const double s = q.x() - static_cast<double>(i);
    return mix(mix(cell[0], cell[1], s), mix(cell[columns], cell[columns + 1], s), q.y() - static_cast<double>(j));
  }

 private:
  double exact(const Vec2& p) const {
    double nearest2 = (p - polygon_[0]).squaredNorm();
    bool inside = false;
    for (std::size_t i = 0, j = polygon_.size() - 1; i < polygon_.size(); j = i++) {
      const Vec2 edge = polygon_[j] - polygon_[i];
      const Vec2 w = p - polygon_[i];
      const double t = std::clamp(w.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
      nearest2 = std::min(nearest2, (w - t * edge).squaredNorm());
      const bool crosses = (polygon_[i].y() > p.y()) != (polygon_[j].y() > p.y());
      if (crosses && w.x() < edge.x() * w.y() / edge.y()) inside = !inside;
    }
    return (inside ? -1.0 : 1.0) * std::sqrt(nearest2);
  }

  Table table_;
  std::vector<Vec2> polygon_;
  std::vector<double> values_;
};

}  // namespace palpate::body
