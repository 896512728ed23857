#include "palpate/elements/hex_element.h"

#include <cmath>

namespace palpate::elements {

namespace {

using Gradients = Eigen::Matrix<double, 8, 3>;

/// Gradients of the nodes' functions at a place of the cube from -1 to 1.
Gradients gradientsAt(const Vec3& place, const Vec3& size) {
  Gradients gradients;
  for (int v = 0; v < 8; ++v) {
    const Vec3 side((v & 1) != 0 ? 1.0 : -1.0, (v & 2) != 0 ? 1.0 : -1.0, (v & 4) != 0 ? 1.0 : -1.0);
    const Vec3 rise = Vec3::Ones() + side.cwiseProduct(place);
    gradients(v, 0) = side.x() * rise.y() * rise.z() / (4.0 * size.x());
    gradients(v, 1) = side.y() * rise.x() * rise.z() / (4.0 * size.y());
    gradients(v, 2) = side.z() * rise.x() * rise.y() / (4.0 * size.z());
  }
  return gradients;
}

/// Shear without change of volume: 2 mu times the deviator's square.
void addShear(const Gradients& d, double weight, HexMatrix& stiffness) {
  const Eigen::Matrix<double, 8, 8> products = d * d.transpose();
  for (int a = 0; a < 8; ++a) {
    for (int b = 0; b < 8; ++b) {
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
          stiffness(3 * a + i, 3 * b + j) += weight * (d(a, j) * d(b, i) - 2.0 / 3.0 * d(a, i) * d(b, j));
        }
        stiffness(3 * a + i, 3 * b + i) += weight * products(a, b);
      }
    }
  }
}

}  // namespace

HexMatrix hexStiffness(const Vec3& size, double young_kpa, double poisson) {
  const double shear = young_kpa / (2.0 * (1.0 + poisson));
  const double bulk = young_kpa / (3.0 * (1.0 - 2.0 * poisson));
  const double at = 1.0 / std::sqrt(3.0);
  const double volume = size.prod();
  HexMatrix stiffness = HexMatrix::Zero();
  Eigen::Matrix<double, 24, 1> dilatation = Eigen::Matrix<double, 24, 1>::Zero();
  for (int q = 0; q < 8; ++q) {
    const Vec3 place((q & 1) != 0 ? at : -at, (q & 2) != 0 ? at : -at, (q & 4) != 0 ? at : -at);
    const Gradients gradients = gradientsAt(place, size);
    addShear(gradients, shear * volume / 8.0, stiffness);
    for (int a = 0; a < 8; ++a) dilatation.segment<3>(3 * a) += gradients.row(a).transpose() / 8.0;
  }
  return stiffness + bulk * volume * dilatation * dilatation.transpose();
}

}  // namespace palpate::elements
