// The grid of the block: rows as high as the cells are wide at most, at least one a layer.
#include "dissertation/rivals/tissue_block.h"

#include <cmath>

namespace palpate::study {

TissueBlock::TissueBlock(const std::vector<TissueLayer>& layers, double side_mm, int cells)
    : cells_(cells), spacing_mm_(side_mm / cells) {
  constexpr double kNewtonPerMm2 = 1e-3;  // N/mm^2 in a kPa
  double z = 0.0;
  for (const TissueLayer& layer : layers) z -= layer.thickness_mm;
  heights_.push_back(z);
  for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer) {
    const int rows = static_cast<int>(std::ceil(layer->thickness_mm / spacing_mm_));
    for (int row = 0; row < rows; ++row) {
      heights_.push_back(z + layer->thickness_mm * (row + 1) / rows);
      row_modulus_.push_back(kNewtonPerMm2 * layer->modulus_kpa);
    }
    z += layer->thickness_mm;
  }
  heights_.back() = 0.0;
}

Vec3 TissueBlock::place(std::size_t node) const {
  const std::size_t level = node / nodesOfALevel();
  const auto in_level = static_cast<int>(node % nodesOfALevel());
  const double half = 0.5 * spacing_mm_ * cells_;
  const int column = in_level % (cells_ + 1);
  const int line = in_level / (cells_ + 1);
  return {spacing_mm_ * column - half, spacing_mm_ * line - half, heights_[level]};
}

bool TissueBlock::isFixed(std::size_t node, int axis) const {
  if (node < nodesOfALevel()) return true;
  const auto in_level = static_cast<int>(node % nodesOfALevel());
  if (axis == 2) return false;
  const int at = axis == 0 ? in_level % (cells_ + 1) : in_level / (cells_ + 1);
  return at == 0 || at == cells_;
}

mesh::TriangleMesh TissueBlock::skin() const {
  mesh::TriangleMesh skin;
  for (std::size_t n = firstTopNode(); n < nodes(); ++n) skin.positions.push_back(place(n));
  const auto corner = [this](int i, int j) { return static_cast<Index>(j * (cells_ + 1) + i); };
  for (int j = 0; j < cells_; ++j) {
    for (int i = 0; i < cells_; ++i) {
      skin.triangles.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)});
      skin.triangles.push_back({corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)});
    }
  }
  return skin;
}

double ballDepth(double distance_mm, double central_depth_mm) {
  if (distance_mm >= kBallRadiusMm) return -1.0;
  return central_depth_mm - kBallRadiusMm + std::sqrt(kBallRadiusMm * kBallRadiusMm - distance_mm * distance_mm);
}

}  // namespace palpate::study
