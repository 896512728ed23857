#include "palpate/elements/quad_mesh.h"

#include <algorithm>
#include <cmath>

namespace palpate::elements {

namespace {

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

constexpr double kOnBorder = 1e-9;

void addFreedoms(QuadMesh& mesh, const BonePost& bone) {
  for (std::size_t n = 0; n < mesh.r.size(); ++n) {
    const bool held = mesh.z[n] < kOnBorder || mesh.r[n] > mesh.columns.back() - kOnBorder ||
                      bone.holds(mesh.r[n], mesh.height() - mesh.z[n]);
    const bool axis = mesh.r[n] < kOnBorder;
    std::array<int, 2>& freedoms = mesh.freedoms.emplace_back(std::array{kHeld, kHeld});
    if (!held && !axis) freedoms[0] = mesh.freedom_count++;
    if (!held) freedoms[1] = mesh.freedom_count++;
  }
}

}  // namespace

bool BonePost::holds(double r, double depth_mm) const {
  if (!(radius_mm > 0.0)) return false;
  if (flat_top) return r < radius_mm + kOnBorder && depth_mm > cover_mm - kOnBorder;
  const double above_centre = std::max(0.0, cover_mm + radius_mm - depth_mm);
  return std::hypot(r, above_centre) < radius_mm + kOnBorder;
}

QuadMesh quadMesh(const tissue::LayerStack& stack, const MeshFineness& fineness) {
  QuadMesh mesh;
  const auto& lump = fineness.lump;
  mesh.columns = lump ? bordersAlong(fineness.columns, *lump) : bordersAlong(fineness.columns);
  const LayerRows rows = lump ? layerRows(stack, fineness.rows, *lump) : layerRows(stack, fineness.rows);
  for (const double depth : rows.depths_mm) mesh.rows.push_back(rows.depths_mm.back() - depth);
  const Numbering number(mesh);
  addNodes(mesh, number);
  addElements(mesh, number, rows.layers);
  addFreedoms(mesh, fineness.bone);
  return mesh;
}

}  // namespace palpate::elements
