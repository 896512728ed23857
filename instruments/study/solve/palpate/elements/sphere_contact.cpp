#include "palpate/elements/sphere_contact.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace palpate::elements {

namespace {

/// A point of the skin against the sphere.
struct Touch {
  double rest_r = 0.0;
  std::array<double, 3> shape{};
  double gap = 0.0;       ///< mm inside the sphere; <= 0: outside
  double distance = 0.0;  ///< from the centre
  double normal_r = 0.0;  ///< from the centre to the point
  double normal_z = 0.0;
};

Touch touchAt(const QuadMesh& mesh, const std::array<int, 3>& nodes, double s, const Sphere& sphere,
              const Eigen::VectorXd& displacement) {
  Touch touch;
  touch.shape = edgeShape(s);
  double r = 0.0;
  double z = sphere.depth_mm - sphere.radius_mm;  // above the centre
  for (std::size_t a = 0; a < 3; ++a) {
    const auto node = static_cast<std::size_t>(nodes[a]);
    touch.rest_r += touch.shape[a] * mesh.r[node];
    r += touch.shape[a] * (mesh.r[node] + displacement[2 * nodes[a]]);
    z += touch.shape[a] * displacement[2 * nodes[a] + 1];
  }
  touch.distance = std::hypot(r, z);
  touch.gap = sphere.radius_mm - touch.distance;
  touch.normal_r = r / touch.distance;
  touch.normal_z = z / touch.distance;
  return touch;
}

void addTouch(const Touch& touch, double weight, Tangent tangent, EdgeAnswer& answer) {
  // Hessian of 1/2 w gap^2: w (n n^T - gap / distance (I - n n^T)).
  const double turning = tangent == Tangent::convex ? 0.0 : touch.gap / touch.distance;
  const double nr = touch.normal_r;
  const double nz = touch.normal_z;
  const double rr = weight * (nr * nr - turning * nz * nz);
  const double rz = weight * (1.0 + turning) * nr * nz;
  const double zz = weight * (nz * nz - turning * nr * nr);
  for (std::size_t a = 0; a < 3; ++a) {
    answer.forces[2 * a] -= weight * touch.gap * nr * touch.shape[a];
    answer.forces[2 * a + 1] -= weight * touch.gap * nz * touch.shape[a];
    for (std::size_t b = 0; b <= a; ++b) {
      const double both = touch.shape[a] * touch.shape[b];
      answer.stiffness[2 * a][2 * b] += rr * both;
      answer.stiffness[2 * a + 1][2 * b] += rz * both;
      answer.stiffness[2 * a + 1][2 * b + 1] += zz * both;
      if (a != b) answer.stiffness[2 * a][2 * b + 1] += rz * both;
    }
  }
}

}  // namespace

std::vector<ContactRing> contactRings(const QuadMesh& mesh, const Sphere& sphere, const Eigen::VectorXd& displacement) {
  constexpr int kRingsAnEdge = 16;
  std::vector<ContactRing> rings;
  for (std::size_t edge = 0; edge < mesh.surface.size(); ++edge) {
    if (mesh.columns[edge] > 3.0 * sphere.radius_mm) break;
    const double width = (mesh.columns[edge + 1] - mesh.columns[edge]) / kRingsAnEdge;
    for (int i = 0; i < kRingsAnEdge; ++i) {
      const double s = (2.0 * i + 1.0) / kRingsAnEdge - 1.0;
      const Touch touch = touchAt(mesh, mesh.surface[edge], s, sphere, displacement);
      if (!(touch.gap > 0.0)) continue;
      const double weight = sphere.stiffness_kpa_per_mm * width * 2.0 * std::numbers::pi * touch.rest_r;
      rings.push_back({touch.normal_r * touch.distance, -weight * touch.gap * touch.normal_z});
    }
  }
  return rings;
}

ContactSum addContact(const QuadMesh& mesh, const Sphere& sphere, const Eigen::VectorXd& displacement, Tangent tangent,
                      const std::function<void(const std::array<int, 3>& nodes, const EdgeAnswer&)>& add) {
  // Gauss-Legendre with four points.
  constexpr std::array<std::pair<double, double>, 4> kPoints = {{{-0.861136311594053, 0.347854845137454},
                                                                 {-0.339981043584856, 0.652145154862546},
                                                                 {0.339981043584856, 0.652145154862546},
                                                                 {0.861136311594053, 0.347854845137454}}};
  ContactSum sum;
  Touch last;
  for (std::size_t edge = 0; edge < mesh.surface.size(); ++edge) {
    if (mesh.columns[edge] > 3.0 * sphere.radius_mm) break;
    const double half_width = 0.5 * (mesh.columns[edge + 1] - mesh.columns[edge]);
    EdgeAnswer answer;
    bool touches = false;
    for (const auto& [s, share] : kPoints) {
      const Touch touch = touchAt(mesh, mesh.surface[edge], s, sphere, displacement);
      if (touch.gap > 0.0) {
        const double weight = sphere.stiffness_kpa_per_mm * share * half_width * 2.0 * std::numbers::pi * touch.rest_r;
        sum.energy += 0.5 * weight * touch.gap * touch.gap;
        sum.force_mn -= weight * touch.gap * touch.normal_z;
        addTouch(touch, weight, tangent, answer);
        sum.radius_mm = touch.rest_r;
        touches = true;
      } else if (last.gap > 0.0) {  // the rim lies where the gap passes zero
        sum.radius_mm += (touch.rest_r - last.rest_r) * last.gap / (last.gap - touch.gap);
      }
      last = touch;
    }
    if (touches) add(mesh.surface[edge], answer);
  }
  return sum;
}

}  // namespace palpate::elements
