// An 8-node box of linear elastic tissue: its stiffness, with the mean of its dilatation for the volume, so that nearly
// incompressible tissue does not lock.
#pragma once

#include <Eigen/Core>

#include "palpate/base/vec.h"

namespace palpate::elements {

/// u_x, u_y, u_z of its nodes in turn; node v lies on the high side of x, y, z where bit 0, 1, 2 of v is set.
using HexMatrix = Eigen::Matrix<double, 24, 24>;

/// `size`: mm along x, y, z. kPa mm = mN/mm.
HexMatrix hexStiffness(const Vec3& size, double young_kpa, double poisson);

}  // namespace palpate::elements
