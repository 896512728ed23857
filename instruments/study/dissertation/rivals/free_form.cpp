// Cubic B-splines over a regular lattice, and the least move of its points.
#include "dissertation/rivals/free_form.h"

#include <algorithm>
#include <cmath>

namespace palpate::study {

namespace {

// The four cubic B-splines that reach a place `t` of the way between the second and the third of their knots.
std::array<double, 4> splineWeights(double t) {
  const double s = 1.0 - t;
  return {s * s * s / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0, (3.0 * s * s * s - 6.0 * s * s + 4.0) / 6.0,
          t * t * t / 6.0};
}

}  // namespace

FreeForm::FreeForm(const TissueBlock& block, double lattice_mm) : lattice_mm_(lattice_mm) {
  const Vec3 low = block.place(0);
  for (int axis = 0; axis < 3; ++axis) {
    const int below = static_cast<int>(std::ceil(-low[axis] / lattice_mm)) + 2;
    origin_[axis] = -lattice_mm * below;
    points_[static_cast<std::size_t>(axis)] = below + 3 + (axis == 2 ? 0 : below - 2);
  }
  std::size_t points = 1;
  for (const int along : points_) points *= static_cast<std::size_t>(along);
  moves_.resize(points);
  for (std::size_t n = block.firstTopNode(); n < block.nodes(); ++n) vertices_.push_back(vertexAt(block.place(n)));
  middle_ = vertexAt(Vec3::Zero());
}

FreeForm::Vertex FreeForm::vertexAt(const Vec3& place) const {
  Vertex vertex;
  for (int axis = 0; axis < 3; ++axis) {
    const double at = (place[axis] - origin_[axis]) / lattice_mm_;
    const int knot = static_cast<int>(std::floor(at));
    vertex.along[static_cast<std::size_t>(axis)] = {knot - 1, splineWeights(at - knot)};
  }
  return vertex;
}

template <class Function>
void FreeForm::forEachControl(const Vertex& vertex, const Function& function) const {
  const auto& [x, y, z] = vertex.along;
  for (int k = 0; k < 4; ++k) {
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) {
        const int control = ((z.first + k) * points_[1] + y.first + j) * points_[0] + x.first + i;
        function(static_cast<std::size_t>(control), x.weights[static_cast<std::size_t>(i)] *
                                                        y.weights[static_cast<std::size_t>(j)] *
                                                        z.weights[static_cast<std::size_t>(k)]);
      }
    }
  }
}

std::vector<Vec3> FreeForm::press(double central_depth_mm) {
  double squares = 0.0;
  forEachControl(middle_, [&](std::size_t, double weight) { squares += weight * weight; });
  std::fill(moves_.begin(), moves_.end(), Vec3::Zero());
  forEachControl(
      middle_, [&](std::size_t control, double weight) { moves_[control].z() = -central_depth_mm * weight / squares; });
  std::vector<Vec3> displacements(vertices_.size(), Vec3::Zero());
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    forEachControl(vertices_[v],
                   [&](std::size_t control, double weight) { displacements[v] += weight * moves_[control]; });
  }
  return displacements;
}

std::size_t FreeForm::bytes() const { return moves_.size() * sizeof(Vec3) + vertices_.size() * sizeof(Vertex); }

}  // namespace palpate::study
