// Lattice, border, plan, mesh: the four sections below; the last step, improveBand, is in border_band.cpp.
//
// Own: a lattice within the outline and a band that joins it to the border meet an exact count by a search for the cell
// size; no general mesher promises a count.
#include "palpate/body/outline_mesher.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "palpate/base/error.h"

namespace palpate::body {

namespace {

// --- the lattice: its points within the outline, the number of their triangles, and their rim ---

// All of it is counted before a single triangle is made, because the search for the cell size repeats it many times.

/// Rows of lattice points at a constant q. Row j has the half-steps -reach[j], -reach[j] + 2, ..., reach[j]; a
/// half-step k is at p = k * cell / 2, and k has the parity of j, so that neighbouring rows are staggered.
struct Lattice {
  double cell = 0;       ///< edge length, mm
  double first_row = 0;  ///< q of row 0
  std::vector<int> reach;

  double rowHeight() const { return cell * std::sqrt(3.0) / 2; }
  Vec2 point(int row, int half_step) const { return {0.5 * cell * half_step, first_row + row * rowHeight()}; }
  int rows() const { return static_cast<int>(reach.size()); }
};

/// A lattice point: row and half-step.
struct LatticePoint {
  int row;
  int half_step;
};

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

/// The largest lattice of this cell size that stays inside the outline by a margin and is a disc.
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

/// Triangles between row and row + 1.
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

/// The rim, counter-clockwise from the left end of row 0.
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

// --- the border: vertices on the outline ---

using Line = std::vector<Vec2>;

double lengthOf(const Line& line) {
  double length = 0;
  for (std::size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  return length;
}

/// The border as lines from corner to corner, counter-clockwise from the lower left corner.
std::vector<Line> borderLines(const FlatOutline& outline) {
  const auto& right = outline.right;
  const auto mirrored = [](const Vec2& point) { return Vec2(-point.x(), point.y()); };
  std::vector<Line> rising;
  for (std::size_t i = 1; i < outline.corners.size(); ++i) {
    rising.emplace_back(right.begin() + outline.corners[i - 1], right.begin() + outline.corners[i] + 1);
  }
  std::vector<Line> lines{{mirrored(right.front()), right.front()}};
  lines.insert(lines.end(), rising.begin(), rising.end());
  lines.push_back({right.back(), mirrored(right.back())});
  std::reverse(rising.begin(), rising.end());
  for (const Line& line : rising) {
    Line falling(line.rbegin(), line.rend());
    for (Vec2& point : falling) point = mirrored(point);
    lines.push_back(std::move(falling));
  }
  return lines;
}

/// Hands `count` edges to the lines by their lengths: at least one each, largest remainders first.
std::vector<std::size_t> edgesOfLines(const std::vector<Line>& lines, std::size_t count) {
  std::vector<double> share;
  share.reserve(lines.size());
  for (const Line& line : lines) share.push_back(lengthOf(line));
  const double total = std::accumulate(share.begin(), share.end(), 0.0);
  std::vector<std::size_t> edges;
  for (double& length : share) {
    length *= static_cast<double>(count) / total;
    edges.push_back(std::max<std::size_t>(1, static_cast<std::size_t>(length)));
  }
  const auto shortage = [&](std::size_t i) { return share[i] - static_cast<double>(edges[i]); };
  for (std::size_t sum = std::accumulate(edges.begin(), edges.end(), std::size_t{0}); sum < count; ++sum) {
    std::size_t neediest = 0;
    for (std::size_t i = 1; i < edges.size(); ++i) {
      if (shortage(i) > shortage(neediest)) neediest = i;
    }
    ++edges[neediest];
  }
  return edges;
}

/// `count` points at equal distances along the line, its last point left out.
void appendEvenly(const Line& line, std::size_t count, std::vector<Vec2>& points) {
  const double step = lengthOf(line) / static_cast<double>(count);
  std::size_t segment = 1;
  double before = 0;  // length up to the start of the segment
  for (std::size_t i = 0; i < count; ++i) {
    const double at = static_cast<double>(i) * step;
    double length = (line[segment] - line[segment - 1]).norm();
    while (before + length < at && segment + 1 < line.size()) {
      before += length;
      ++segment;
      length = (line[segment] - line[segment - 1]).norm();
    }
    points.push_back(line[segment - 1] + (at - before) / length * (line[segment] - line[segment - 1]));
  }
}

std::vector<Vec2> borderPoints(const std::vector<Line>& lines, std::size_t count) {
  const std::vector<std::size_t> edges = edgesOfLines(lines, count);
  std::vector<Vec2> points;
  points.reserve(count);
  for (std::size_t i = 0; i < lines.size(); ++i) appendEvenly(lines[i], edges[i], points);
  return points;
}

// --- the plan: a cell size that meets the count ---

/// A lattice and the number of border vertices that give the requested count.
struct Plan {
  Lattice lattice;
  std::size_t border = 0;
};

/// Deviation of the border's edges from the cell size: 0 is equal, positive is too many of them.
double borderExcess(double border, double border_length, double cell) { return border * cell / border_length - 1; }

double latticeExcess(const Lattice& lattice, std::size_t triangles, double border_length) {
  const double inner = static_cast<double>(latticeTriangles(lattice) + latticeRimLength(lattice));
  return borderExcess(static_cast<double>(triangles) - inner, border_length, lattice.cell);
}

/// The excess falls with the cell size in small jumps: a bisection finds the crossing, a scan the best value near it.
Plan searchPlan(const FlatOutline& outline, std::size_t triangles, double area, double border_length) {
  const double guess = std::sqrt(4 / std::sqrt(3.0) * area / static_cast<double>(triangles));
  double low = 0.8 * guess;
  double high = 1.3 * guess;
  double best_cell = guess;
  double best = std::numeric_limits<double>::infinity();
  const auto consider = [&](double cell) {
    const double excess = latticeExcess(fitLattice(outline, cell), triangles, border_length);
    if (std::abs(excess) < best) best = std::abs(excess), best_cell = cell;
    return excess;
  };
  for (int step = 0; step < 40; ++step) {
    const double middle = (low + high) / 2;
    (consider(middle) < 0 ? low : high) = middle;
  }
  // One row or column more or less is the size of the jumps, so look as far as that on both sides.
  constexpr int kScan = 60;
  constexpr double kGoodEnough = 0.01;  // a border edge one percent off the cell size cannot be seen
  const double reach = 2 * guess / std::sqrt(area);
  for (int i = 1; i <= kScan && best > kGoodEnough; ++i) {
    consider(low * (1 + reach * i / kScan));
    consider(low * (1 - reach * i / kScan));
  }
  Plan plan{fitLattice(outline, best_cell)};
  plan.border = triangles - latticeTriangles(plan.lattice) - latticeRimLength(plan.lattice);
  return plan;
}

// --- the mesh ---

/// Vertex numbers of the lattice: border first, then row by row.
class LatticeNumbers {
 public:
  LatticeNumbers(const Lattice& lattice, Index first) : lattice_(lattice) {
    for (int row = 0; row < lattice.rows(); ++row) {
      row_start_.push_back(first);
      first += lattice.reach[row] + 1;
    }
  }
  Index operator()(int row, int half_step) const { return row_start_[row] + (half_step + lattice_.reach[row]) / 2; }

 private:
  const Lattice& lattice_;
  std::vector<Index> row_start_;
};

void appendLattice(const Lattice& lattice, const LatticeNumbers& number, FlatMesh& mesh) {
  for (int row = 0; row < lattice.rows(); ++row) {
    for (int k = -lattice.reach[row]; k <= lattice.reach[row]; k += 2) mesh.points.push_back(lattice.point(row, k));
  }
  for (int row = 0; row + 1 < lattice.rows(); ++row) {
    const int upright = std::min(lattice.reach[row] - 1, lattice.reach[row + 1]);
    for (int apex = -upright; apex <= upright; apex += 2) {
      mesh.triangles.push_back({number(row, apex - 1), number(row, apex + 1), number(row + 1, apex)});
    }
    const int hanging = std::min(lattice.reach[row + 1] - 1, lattice.reach[row]);
    for (int apex = -hanging; apex <= hanging; apex += 2) {
      mesh.triangles.push_back({number(row + 1, apex + 1), number(row + 1, apex - 1), number(row, apex)});
    }
  }
}

/// For each rim vertex the border vertex nearest to it, ascending; one entry more closes the round.
std::vector<std::size_t> matchRim(const std::vector<Index>& rim, const FlatMesh& mesh) {
  // Rim and border go round side by side; at a corner the border runs ahead by a few vertices, never by this many.
  constexpr std::size_t kAhead = 16;
  std::vector<std::size_t> match;
  std::size_t last = 0;
  for (const Index vertex : rim) {
    const auto distance = [&](std::size_t o) {
      return (mesh.points[o % mesh.border] - mesh.points[vertex]).squaredNorm();
    };
    std::size_t nearest = last;
    for (std::size_t o = last; o <= std::min<std::size_t>(last + kAhead, mesh.border); ++o) {
      if (distance(o) < distance(nearest)) nearest = o;
    }
    match.push_back(last = nearest);
  }
  match.push_back(mesh.border);
  return match;
}

/// Joins the border to the rim of the lattice: walks both at the same pace, one triangle a step.
void appendBand(const std::vector<Index>& rim, FlatMesh& mesh) {
  const std::vector<std::size_t> match = matchRim(rim, mesh);
  std::size_t inner = 0;
  std::size_t outer = 0;
  while (inner < rim.size() || outer < mesh.border) {
    const Index i = rim[inner % rim.size()];
    const Index next_i = rim[(inner + 1) % rim.size()];
    const auto o = static_cast<Index>(outer % mesh.border);
    const auto next_o = static_cast<Index>((outer + 1) % mesh.border);
    const bool border_is_behind = inner == rim.size() || 2 * outer + 1 < match[inner] + match[inner + 1];
    if (border_is_behind && outer < mesh.border) {
      mesh.triangles.push_back({o, next_o, i});
      ++outer;
    } else {
      mesh.triangles.push_back({next_i, i, o});
      ++inner;
    }
  }
}

double areaInside(const FlatOutline& outline) {
  double area = 0;
  for (std::size_t i = 1; i < outline.right.size(); ++i) {
    area += (outline.right[i].x() + outline.right[i - 1].x()) * (outline.right[i].y() - outline.right[i - 1].y());
  }
  return area;
}

}  // namespace

FlatMesh meshOutline(const FlatOutline& outline, std::size_t triangles, const Lift& lift) {
  if (triangles < kFewestTriangles || triangles > kNoIndex / 4) {
    throw Error("skin: cannot be made of " + std::to_string(triangles) + " triangles; expected 500 to 1,000,000,000");
  }
  const std::vector<Line> lines = borderLines(outline);
  double border_length = 0;
  for (const Line& line : lines) border_length += lengthOf(line);
  const Plan plan = searchPlan(outline, triangles, areaInside(outline), border_length);
  FlatMesh mesh;
  mesh.points.reserve(triangles / 2 + plan.border + 2);
  mesh.triangles.reserve(triangles);
  mesh.points = borderPoints(lines, plan.border);
  mesh.border = static_cast<Index>(plan.border);
  const LatticeNumbers number(plan.lattice, mesh.border);
  appendLattice(plan.lattice, number, mesh);
  std::vector<Index> rim;
  for (const LatticePoint& point : latticeRim(plan.lattice)) rim.push_back(number(point.row, point.half_step));
  appendBand(rim, mesh);
  improveBand(mesh, lift);
  return mesh;
}

}  // namespace palpate::body
