// A rigid sphere without friction on the surface's edges: a stiff spring at every point of the skin that lies inside
// it.
//
// Energy 1/2 k gap^2 over the skin's area at rest, with its exact first and second derivatives.
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

#include "palpate/elements/quad_element.h"
#include "palpate/elements/quad_mesh.h"

namespace palpate::elements {

struct Sphere {
  double radius_mm = 8.0;
  double depth_mm = 0.0;  ///< its lowest point under the surface at rest
  double stiffness_kpa_per_mm = 1500.0;
};

/// On the freedoms of one edge: u_r and u_z of its three nodes in turn.
struct EdgeAnswer {
  std::array<double, 6> forces{};                    ///< mN
  std::array<std::array<double, 6>, 6> stiffness{};  ///< below and on the diagonal
};

/// Sums over the whole contact.
struct ContactSum {
  double energy = 0.0;    ///< uJ
  double force_mn = 0.0;  ///< along the axis
  /// Radius of the touching skin, at rest; 0: nothing touches.
  double radius_mm = 0.0;
};

/// Load on a narrow ring of the skin, seen along the axis.
struct ContactRing {
  double radius_mm = 0.0;  ///< radius of the pressed skin
  double force_mn = 0.0;   ///< along the axis
};
/// From the middle outwards, about 0.05 mm wide each; those that touch.
std::vector<ContactRing> contactRings(const QuadMesh& mesh, const Sphere& sphere, const Eigen::VectorXd& displacement);

/// Goes over the edges that touch. `displacement`: u_r, u_z of every node.
ContactSum addContact(const QuadMesh& mesh, const Sphere& sphere, const Eigen::VectorXd& displacement, Tangent tangent,
                      const std::function<void(const std::array<int, 3>& nodes, const EdgeAnswer&)>& add);

}  // namespace palpate::elements
