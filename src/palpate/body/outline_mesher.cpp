#include "palpate/body/outline_mesher.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "palpate/base/error.h"
#include "palpate/body/band_improver.h"
#include "palpate/body/outline_lattice.h"

namespace palpate::body {

namespace {

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

/// A lattice and the number of border vertices that brings the count to what was asked.
struct Plan {
  Lattice lattice;
  std::size_t border = 0;
};

/// How far the border's edges are from the cell size: 0 is equal, positive is too many of them.
double borderExcess(double border, double border_length, double cell) { return border * cell / border_length - 1; }

double excessOf(const Lattice& lattice, std::size_t triangles, double border_length) {
  const double inner = static_cast<double>(latticeTriangles(lattice) + latticeRimLength(lattice));
  return borderExcess(static_cast<double>(triangles) - inner, border_length, lattice.cell);
}

/// The excess falls with the cell size in small jumps: a bisection finds the crossing, a scan the best value beside it.
Plan searchPlan(const FlatOutline& outline, std::size_t triangles, double area, double border_length) {
  const double guess = std::sqrt(4 / std::sqrt(3.0) * area / static_cast<double>(triangles));
  double low = 0.8 * guess;
  double high = 1.3 * guess;
  double best_cell = guess;
  double best = std::numeric_limits<double>::infinity();
  const auto consider = [&](double cell) {
    const double excess = excessOf(fitLattice(outline, cell), triangles, border_length);
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
    throw Error("a skin of " + std::to_string(triangles) + " triangles cannot be made: ask for 500 to 1,000,000,000");
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
