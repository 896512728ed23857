#include "palpate/body/outline_lattice.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpate::body {

namespace {

/// Distance of the lattice from the outline in cells: the gap to be filled by the band is then 0.55 to 1.4 cells wide,
/// which a single strip of triangles fills without slivers.
constexpr double kMargin = 0.55;

/// The largest p in row q that keeps `margin` from one segment of the right border, or infinity if it is far away.
double reachBesideSegment(const Vec2& low, const Vec2& high, double q, double margin) {
  double reach = std::numeric_limits<double>::infinity();
  for (const Vec2& end : {low, high}) {
    const double dq = q - end.y();
    if (std::abs(dq) < margin) reach = std::min(reach, end.x() - std::sqrt(margin * margin - dq * dq));
  }
  const Vec2 along = (high - low).normalized();
  const Vec2 shift = margin * Vec2(-along.y(), along.x());  // q increases along the border, so this points inside
  const Vec2 a = low + shift;
  const double t = (q - a.y()) / (high.y() - low.y());
  if (t >= 0 && t <= 1) reach = std::min(reach, a.x() + t * (high.x() - low.x()));
  return reach;
}

double reachInRow(const FlatOutline& outline, double q, double margin) {
  const auto& right = outline.right;
  const auto below = [](const Vec2& point, double value) { return point.y() < value; };
  auto from = std::lower_bound(right.begin(), right.end(), q - margin, below);
  if (from != right.begin()) --from;
  double reach = std::numeric_limits<double>::infinity();
  for (auto to = from + 1; to != right.end(); from = to++) {
    reach = std::min(reach, reachBesideSegment(*from, *to, q, margin));
    if (to->y() > q + margin) break;
  }
  return reach;
}

/// The largest half-step of the row's parity within `reach`; negative if there is none.
int halfStepsWithin(double reach, double cell, int row) {
  const int k = static_cast<int>(std::floor(2 * reach / cell));
  return k - ((k ^ row) & 1);
}

/// A row that sticks out by more than half a cell over both neighbours has points without a triangle: shorten it.
void removeSpurs(std::vector<int>& reach) {
  const int rows = static_cast<int>(reach.size());
  for (bool changed = true; changed;) {
    changed = false;
    for (int row = 0; row < rows; ++row) {
      const int below = row > 0 ? reach[row - 1] : -1;
      const int above = row + 1 < rows ? reach[row + 1] : -1;
      const int most = std::max(below, above) + 1;
      if (reach[row] > most) reach[row] = most, changed = true;
    }
  }
}

/// From the right end of a row up to the right end of the next; the start is left out.
template <class Visit>
void walkRightEnd(const Lattice& lattice, int row, Visit visit) {
  const int here = lattice.reach[row];
  const int above = lattice.reach[row + 1];
  for (int k = here - 2; k > above; k -= 2) visit(LatticePoint{row, k});
  for (int k = here + 1; k < above; k += 2) visit(LatticePoint{row + 1, k});
  visit(LatticePoint{row + 1, above});
}

}  // namespace

double Lattice::rowHeight() const { return cell * std::sqrt(3.0) / 2; }

Lattice fitLattice(const FlatOutline& outline, double cell) {
  Lattice lattice;
  lattice.cell = cell;
  const double margin = kMargin * cell;
  const double low = outline.right.front().y();
  const double height = outline.right.back().y() - low;
  const int rows = std::max(1, 1 + static_cast<int>((height - 2 * margin) / lattice.rowHeight()));
  lattice.first_row = low + (height - (rows - 1) * lattice.rowHeight()) / 2;
  lattice.reach.resize(rows);
  for (int row = 0; row < rows; ++row) {
    const double q = lattice.point(row, 0).y();
    lattice.reach[row] = halfStepsWithin(reachInRow(outline, q, margin), cell, row);
  }
  removeSpurs(lattice.reach);
  return lattice;
}

std::size_t trianglesAbove(const Lattice& lattice, int row) {
  const int here = lattice.reach[row];
  const int above = lattice.reach[row + 1];
  return static_cast<std::size_t>(std::min(here - 1, above) + 1) + (std::min(above - 1, here) + 1);
}

std::size_t latticeTriangles(const Lattice& lattice) {
  std::size_t sum = 0;
  for (int row = 0; row + 1 < lattice.rows(); ++row) sum += trianglesAbove(lattice, row);
  return sum;
}

std::vector<LatticePoint> latticeRim(const Lattice& lattice) {
  std::vector<LatticePoint> right;
  for (int row = 0; row + 1 < lattice.rows(); ++row) {
    walkRightEnd(lattice, row, [&](const LatticePoint& point) { right.push_back(point); });
  }
  std::vector<LatticePoint> rim;
  for (int k = -lattice.reach.front(); k <= lattice.reach.front(); k += 2) rim.push_back({0, k});
  rim.insert(rim.end(), right.begin(), right.end());
  const int top = lattice.rows() - 1;
  for (int k = lattice.reach[top] - 2; k > -lattice.reach[top]; k -= 2) rim.push_back({top, k});
  std::reverse(right.begin(), right.end());
  for (const LatticePoint& point : right) rim.push_back({point.row, -point.half_step});
  return rim;
}

std::size_t latticeRimLength(const Lattice& lattice) {
  std::size_t right = 0;
  for (int row = 0; row + 1 < lattice.rows(); ++row) {
    walkRightEnd(lattice, row, [&](const LatticePoint&) { ++right; });
  }
  return 2 * right + lattice.reach.front() + lattice.reach.back();
}

}  // namespace palpate::body
