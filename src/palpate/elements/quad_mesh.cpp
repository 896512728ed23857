#include "palpate/elements/quad_mesh.h"

#include <algorithm>
#include <cmath>

namespace palpate::elements {

namespace {

/// Borders from 0 to the radius.
std::vector<double> columnBorders(const MeshFineness& fineness) {
  std::vector<double> borders = {0.0};
  const double uniform_to = std::min(fineness.uniform_to_mm, fineness.radius_mm);
  const int uniform = std::max(1, static_cast<int>(std::lround(uniform_to / fineness.width_mm)));
  for (int i = 1; i <= uniform; ++i) borders.push_back(uniform_to * i / uniform);
  const double tail_from = borders.back();
  if (tail_from >= fineness.radius_mm) return borders;
  double width = uniform_to / uniform;
  const std::size_t first = borders.size();
  while (borders.back() < fineness.radius_mm) {
    width = std::min(width * fineness.growth, fineness.widest_mm);
    borders.push_back(borders.back() + width);
  }
  const double fit = (fineness.radius_mm - tail_from) / (borders.back() - tail_from);
  for (std::size_t i = first; i < borders.size(); ++i) borders[i] = tail_from + fit * (borders[i] - tail_from);
  return borders;
}

/// Heights of the rows of one layer whose top lies at `depth`, from the top.
std::vector<double> rowHeights(double thickness, double depth, const MeshFineness& fineness) {
  constexpr double kHeightADepth = 0.15;  // far below the sphere nothing is small
  constexpr double kGrowth = 1.25;
  const double first = std::max(fineness.height_mm, kHeightADepth * depth);
  const bool thick = thickness > 3.0 * first;
  std::vector<double> heights;
  double sum = 0.0;
  for (double height = first; sum < thickness - 1e-9 && static_cast<int>(heights.size()) < fineness.most_rows;) {
    heights.push_back(height);
    sum += height;
    if (thick) height *= kGrowth;
  }
  if (static_cast<int>(heights.size()) < fineness.fewest_rows) {
    heights.assign(static_cast<std::size_t>(fineness.fewest_rows), 1.0);
    sum = fineness.fewest_rows;
  }
  for (double& height : heights) height *= thickness / sum;
  return heights;
}

struct Rows {
  std::vector<double> borders;
  std::vector<int> layers;
};

Rows rowsOf(const tissue::LayerStack& stack, const MeshFineness& fineness) {
  const double total = tissue::totalThickness(stack);
  Rows rows{{total}, {}};
  double depth = 0.0;
  for (std::size_t layer = 0; layer < stack.layers.size(); ++layer) {
    const double thickness = stack.layers[layer].thickness_mm;
    double within = 0.0;
    for (const double height : rowHeights(thickness, depth, fineness)) {
      within += height;
      rows.borders.push_back(total - depth - within);
      rows.layers.push_back(static_cast<int>(layer));
    }
    depth += thickness;
    rows.borders.back() = total - depth;
  }
  rows.borders.back() = 0.0;
  return rows;
}

/// Nodes column by column: those of a border (corners and upright sides), then those between it and the next.
class Numbering {
 public:
  explicit Numbering(const QuadMesh& mesh) : rows_(static_cast<int>(mesh.rows.size()) - 1) {}
  int onBorder(int column, int half_row) const { return column * (3 * rows_ + 2) + half_row; }
  int between(int column, int row) const { return onBorder(column, 2 * rows_ + 1) + row; }
  int rows() const { return rows_; }

 private:
  int rows_;
};

void addNodes(QuadMesh& mesh, const Numbering& number) {
  const auto add = [&](double r, double z) {
    mesh.r.push_back(r);
    mesh.z.push_back(z);
  };
  const auto row = [&](int i) { return mesh.rows[static_cast<std::size_t>(i)]; };
  for (std::size_t column = 0; column < mesh.columns.size(); ++column) {
    const double r = mesh.columns[column];
    for (int half = 0; half <= 2 * number.rows(); ++half) {
      add(r, half % 2 == 0 ? row(half / 2) : 0.5 * (row(half / 2) + row(half / 2 + 1)));
    }
    if (column + 1 == mesh.columns.size()) break;
    for (int i = 0; i <= number.rows(); ++i) add(0.5 * (r + mesh.columns[column + 1]), row(i));
  }
}

void addElements(QuadMesh& mesh, const Numbering& number, const std::vector<int>& row_layers) {
  const int columns = static_cast<int>(mesh.columns.size()) - 1;
  for (int i = 0; i < columns; ++i) {
    mesh.surface.push_back({number.onBorder(i, 0), number.between(i, 0), number.onBorder(i + 1, 0)});
    for (int j = 0; j < number.rows(); ++j) {
      mesh.nodes.push_back({number.onBorder(i, 2 * j + 2), number.onBorder(i + 1, 2 * j + 2),
                            number.onBorder(i + 1, 2 * j), number.onBorder(i, 2 * j),  //
                            number.between(i, j + 1), number.onBorder(i + 1, 2 * j + 1), number.between(i, j),
                            number.onBorder(i, 2 * j + 1)});
      mesh.layers.push_back(row_layers[static_cast<std::size_t>(j)]);
    }
  }
}

void addFreedoms(QuadMesh& mesh) {
  constexpr double kOnBorder = 1e-9;
  for (std::size_t n = 0; n < mesh.r.size(); ++n) {
    const bool held = mesh.z[n] < kOnBorder || mesh.r[n] > mesh.columns.back() - kOnBorder;
    const bool axis = mesh.r[n] < kOnBorder;
    std::array<int, 2>& freedoms = mesh.freedoms.emplace_back(std::array{kHeld, kHeld});
    if (!held && !axis) freedoms[0] = mesh.freedom_count++;
    if (!held) freedoms[1] = mesh.freedom_count++;
  }
}

}  // namespace

QuadMesh quadMesh(const tissue::LayerStack& stack, const MeshFineness& fineness) {
  QuadMesh mesh;
  mesh.columns = columnBorders(fineness);
  Rows rows = rowsOf(stack, fineness);
  mesh.rows = std::move(rows.borders);
  const Numbering number(mesh);
  addNodes(mesh, number);
  addElements(mesh, number, rows.layers);
  addFreedoms(mesh);
  return mesh;
}

}  // namespace palpate::elements
