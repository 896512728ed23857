#include "palpate/elements/stiffness_matrix.h"

#include <algorithm>
#include <utility>

namespace palpate::elements {

namespace {

std::array<int, kQuadFreedoms> elementFreedoms(const QuadMesh& mesh, std::size_t element) {
  std::array<int, kQuadFreedoms> freedoms{};
  for (std::size_t a = 0; a < kQuadNodes; ++a) {
    const auto& node = mesh.freedoms[static_cast<std::size_t>(mesh.nodes[element][a])];
    freedoms[2 * a] = node[0];
    freedoms[2 * a + 1] = node[1];
  }
  return freedoms;
}

}  // namespace

StiffnessMatrix::StiffnessMatrix(const QuadMesh& mesh) : mesh_(mesh) {
  std::vector<Eigen::Triplet<double>> pattern;
  for (std::size_t element = 0; element < mesh.nodes.size(); ++element) {
    const auto freedoms = elementFreedoms(mesh, element);
    for (const int row : freedoms) {
      for (const int column : freedoms) {
        if (column != kHeld && row >= column) pattern.emplace_back(row, column, 0.0);
      }
    }
  }
  lower_.resize(mesh.freedom_count, mesh.freedom_count);
  lower_.setFromTriplets(pattern.begin(), pattern.end());
  lower_.makeCompressed();
  factors_.analyzePattern(lower_);

  places_.resize(mesh.nodes.size());
  for (std::size_t element = 0; element < mesh.nodes.size(); ++element) {
    const auto freedoms = elementFreedoms(mesh, element);
    std::size_t entry = 0;
    for (std::size_t i = 0; i < kQuadFreedoms; ++i) {
      for (std::size_t j = 0; j <= i; ++j) places_[element][entry++] = placeOf(freedoms[i], freedoms[j]);
    }
  }
}

int StiffnessMatrix::placeOf(int row, int column) const {
  if (row == kHeld || column == kHeld) return kHeld;
  if (row < column) std::swap(row, column);
  const int* begin = lower_.innerIndexPtr() + lower_.outerIndexPtr()[column];
  const int* end = lower_.innerIndexPtr() + lower_.outerIndexPtr()[column + 1];
  return static_cast<int>(std::lower_bound(begin, end, row) - lower_.innerIndexPtr());
}

void StiffnessMatrix::clear() { std::fill_n(lower_.valuePtr(), lower_.nonZeros(), 0.0); }

void StiffnessMatrix::add(std::size_t element, const std::array<double, kQuadEntries>& entries) {
  double* values = lower_.valuePtr();
  const auto& places = places_[element];
  for (std::size_t i = 0; i < kQuadEntries; ++i) {
    if (places[i] != kHeld) values[places[i]] += entries[i];
  }
}

void StiffnessMatrix::add(const std::array<int, 3>& edge, const EdgeAnswer& answer) {
  const auto freedom = [&](std::size_t i) { return mesh_.freedoms[static_cast<std::size_t>(edge[i / 2])][i % 2]; };
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const int place = placeOf(freedom(i), freedom(j));
      if (place != kHeld) lower_.valuePtr()[place] += answer.stiffness[i][j];
    }
  }
}

int StiffnessMatrix::factorise() {
  factors_.factorize(lower_);
  if (factors_.info() != Eigen::Success) return -1;
  const auto pivots = factors_.vectorD();
  int negative = 0;
  for (Eigen::Index i = 0; i < pivots.size(); ++i) negative += pivots[i] > 0.0 ? 0 : 1;
  return negative;
}

}  // namespace palpate::elements
