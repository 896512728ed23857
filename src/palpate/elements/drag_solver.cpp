#include "palpate/elements/drag_solver.h"

#include <fmt/format.h>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/Sparse>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/elements/grid_borders.h"
#include "palpate/elements/hex_element.h"

namespace palpate::elements {

namespace {

constexpr int kHeldHere = -1;

enum class Load { drag, press };

/// A grid of boxes under one quarter of the surface: x and y from the middle of the patch, layers downwards.
class Block {
 public:
  Block(const tissue::LayerStack& stack, const DragSettings& settings) : stack_(stack) {
    const double first = 1.5 / settings.fineness;
    lines = bordersAlong({.first_mm = first,
                          .uniform_to_mm = 12.0,
                          .growth = 1.0 + 0.22 / settings.fineness,
                          .widest_mm = 12.0 / settings.fineness,
                          .to_mm = settings.half_width_mm});
    rows = layerRows(stack, {.first_mm = 2.5 / settings.fineness,
                             .fewest = static_cast<int>(std::ceil(2.0 * settings.fineness)),
                             .most = static_cast<int>(std::ceil(6.0 * settings.fineness))});
  }

  int across() const { return static_cast<int>(lines.size()); }
  int deep() const { return static_cast<int>(rows.depths_mm.size()); }
  int nodes() const { return across() * across() * deep(); }
  int node(int i, int j, int k) const { return (i * across() + j) * deep() + k; }
  std::array<int, 8> nodesOf(int i, int j, int k) const {
    std::array<int, 8> all{};
    for (int v = 0; v < 8; ++v) all[static_cast<std::size_t>(v)] = node(i + (v & 1), j + (v >> 1 & 1), k + (v >> 2));
    return all;
  }
  HexMatrix stiffnessOf(int i, int j, int k) const {
    const auto width = [&](int l) {
      return lines[static_cast<std::size_t>(l) + 1] - lines[static_cast<std::size_t>(l)];
    };
    const auto row = static_cast<std::size_t>(k);
    const Vec3 size(width(i), width(j), rows.depths_mm[row + 1] - rows.depths_mm[row]);
    return hexStiffness(size, stack_.layers[static_cast<std::size_t>(rows.layers[row])].young_kpa, stack_.poisson);
  }

  std::vector<double> lines;
  LayerRows rows;

 private:
  const tissue::LayerStack& stack_;
};

/// What is held, what is moved by the patch, what is free.
struct Boundary {
  std::vector<int> freedoms;  ///< of u_x, u_y, u_z of every node; kHeldHere: not free
  Eigen::VectorXd given;      ///< of those that are not
  int count = 0;
};

Boundary boundaryOf(const Block& block, double patch_radius_mm, Load load) {
  Boundary boundary;
  boundary.freedoms.assign(3 * static_cast<std::size_t>(block.nodes()), 0);
  boundary.given = Eigen::VectorXd::Zero(3 * block.nodes());
  const auto hold = [&](int place) { boundary.freedoms[static_cast<std::size_t>(place)] = kHeldHere; };
  const int last = block.across() - 1;
  for (int i = 0; i <= last; ++i) {
    for (int j = 0; j <= last; ++j) {
      const double from_middle =
          std::hypot(block.lines[static_cast<std::size_t>(i)], block.lines[static_cast<std::size_t>(j)]);
      for (int k = 0; k < block.deep(); ++k) {
        const int x = 3 * block.node(i, j, k);
        const bool patch = k == 0 && from_middle <= patch_radius_mm;
        const bool held = i == last || j == last || k == block.deep() - 1;
        // Seen in the plane x = 0 a drag along x turns round, a press is the same.
        if (held || patch || (i == 0 && load == Load::press)) hold(x);
        if (held || patch || j == 0 || (i == 0 && load == Load::drag)) hold(x + 1);
        if (held || patch || (i == 0 && load == Load::drag)) hold(x + 2);
        if (patch) boundary.given[x + (load == Load::drag ? 0 : 2)] = 1.0;
      }
    }
  }
  for (int& freedom : boundary.freedoms) {
    if (freedom != kHeldHere) freedom = boundary.count++;
  }
  return boundary;
}

struct Equations {
  Eigen::SparseMatrix<double> matrix;
  Eigen::VectorXd right;
  double given_energy = 0.0;  ///< twice that of the given displacements alone
};

Equations equationsOf(const Block& block, const Boundary& boundary) {
  Equations equations;
  equations.right = Eigen::VectorXd::Zero(boundary.count);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(block.nodes()) * 300);
  for (int i = 0; i + 1 < block.across(); ++i) {
    for (int j = 0; j + 1 < block.across(); ++j) {
      for (int k = 0; k + 1 < block.deep(); ++k) {
        const HexMatrix stiffness = block.stiffnessOf(i, j, k);
        const std::array<int, 8> nodes = block.nodesOf(i, j, k);
        std::array<int, 24> places{};
        for (int a = 0; a < 24; ++a) {
          places[static_cast<std::size_t>(a)] = 3 * nodes[static_cast<std::size_t>(a / 3)] + a % 3;
        }
        for (int a = 0; a < 24; ++a) {
          const int place = places[static_cast<std::size_t>(a)];
          const int row = boundary.freedoms[static_cast<std::size_t>(place)];
          for (int b = 0; b < 24; ++b) {
            const int other = places[static_cast<std::size_t>(b)];
            const int column = boundary.freedoms[static_cast<std::size_t>(other)];
            if (row != kHeldHere && column != kHeldHere) {
              entries.emplace_back(row, column, stiffness(a, b));
            } else if (row != kHeldHere) {
              equations.right[row] -= stiffness(a, b) * boundary.given[other];
            } else if (column == kHeldHere) {
              equations.given_energy += boundary.given[place] * stiffness(a, b) * boundary.given[other];
            }
          }
        }
      }
    }
  }
  equations.matrix.resize(boundary.count, boundary.count);
  equations.matrix.setFromTriplets(entries.begin(), entries.end());
  return equations;
}

struct Moved {
  Eigen::VectorXd displacement;  ///< of every node
  double n_per_mm = 0.0;         ///< of the whole patch
};

/// Incomplete Cholesky in the grid's own order: a third of the iterations of the sparsest order.
using Solver = Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper,
                                        Eigen::IncompleteCholesky<double, Eigen::Lower, Eigen::NaturalOrdering<int>>>;

Moved solved(const Block& block, const DragSettings& settings, Load load) {
  const Boundary boundary = boundaryOf(block, settings.patch_radius_mm, load);
  const Equations equations = equationsOf(block, boundary);
  Solver solver;
  solver.setTolerance(1e-5);
  solver.setMaxIterations(5000);
  solver.compute(equations.matrix);
  const Eigen::VectorXd free = solver.solve(equations.right);
  if (solver.info() != Eigen::Success) {
    throw Error(fmt::format("the drag was not solved: residual {:.1e} after {} iterations", solver.error(),
                            solver.iterations()));
  }
  Moved moved{boundary.given, 0.0};
  for (Eigen::Index place = 0; place < moved.displacement.size(); ++place) {
    const int freedom = boundary.freedoms[static_cast<std::size_t>(place)];
    if (freedom != kHeldHere) moved.displacement[place] = free[freedom];
  }
  constexpr double kQuarters = 4.0;
  moved.n_per_mm = 1e-3 * kQuarters * (equations.given_energy - equations.right.dot(free));
  return moved;
}

void check(const tissue::LayerStack& stack, const DragSettings& settings) {
  tissue::check(stack);
  const double patch = settings.patch_radius_mm;
  if (!(patch >= 2.0 && patch <= 50.0)) throw Error(fmt::format("a patch of {:g} mm: it must have 2 to 50", patch));
  if (!(settings.half_width_mm >= 4.0 * patch && settings.half_width_mm <= 2000.0)) {
    throw Error(fmt::format("a block of {:g} mm to each side: it must have four radii of the patch to 2000",
                            settings.half_width_mm));
  }
  if (settings.fineness >= 0.5 && settings.fineness <= 4.0) return;
  throw Error(fmt::format("the mesh's fineness is {:g}; it must be 0.5 to 4", settings.fineness));
}

/// Bilinear in the quarter's grid.
double between(const std::vector<double>& lines, const std::vector<double>& values, double x, double y) {
  const auto cell = [&](double value) {
    const auto after = std::upper_bound(lines.begin() + 1, lines.end() - 1, value);
    return static_cast<std::size_t>(after - lines.begin()) - 1;
  };
  const std::size_t i = cell(x);
  const std::size_t j = cell(y);
  const double s = std::min(1.0, (x - lines[i]) / (lines[i + 1] - lines[i]));
  const double t = std::min(1.0, (y - lines[j]) / (lines[j + 1] - lines[j]));
  const std::size_t size = lines.size();
  const auto value = [&](std::size_t a, std::size_t b) { return values[a * size + b]; };
  return (1.0 - s) * ((1.0 - t) * value(i, j) + t * value(i, j + 1)) +
         s * ((1.0 - t) * value(i + 1, j) + t * value(i + 1, j + 1));
}

}  // namespace

double DragField::at(double x, double y) const { return between(lines_mm, along, x, y); }

Vec2 DragField::movedAt(const Vec2& place_mm) const {
  const double x = std::abs(place_mm.x());
  const double y = std::abs(place_mm.y());
  if (std::max(x, y) >= lines_mm.back()) return Vec2::Zero();
  const double sign = (place_mm.x() < 0.0) == (place_mm.y() < 0.0) ? 1.0 : -1.0;
  return {between(lines_mm, along, x, y), sign * between(lines_mm, across, x, y)};
}

DragField solveDragField(const tissue::LayerStack& stack, const DragSettings& settings, const Progress& progress) {
  check(stack, settings);
  const Block block(stack, settings);
  report(progress, "dragging", 0.0);
  const Moved dragged = solved(block, settings, Load::drag);
  report(progress, "dragging", 0.6);
  const Moved pressed = solved(block, settings, Load::press);
  report(progress, "dragging", 1.0);
  DragField field;
  field.lines_mm = block.lines;
  for (int i = 0; i < block.across(); ++i) {
    for (int j = 0; j < block.across(); ++j) {
      field.along.push_back(dragged.displacement[3 * block.node(i, j, 0)]);
      field.across.push_back(dragged.displacement[3 * block.node(i, j, 0) + 1]);
    }
  }
  field.drag_n_per_mm = dragged.n_per_mm;
  field.press_n_per_mm = pressed.n_per_mm;
  return field;
}

}  // namespace palpate::elements
