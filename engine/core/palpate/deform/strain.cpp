// Strain at a vertex from the edges around it, as a mean and as a tensor; and the colour of a strain.
//
// Data flow: displacements -> here, for the blocks of the plan -> strain of the surface -> colours of files and
// pictures. Based on: Ji, dissertation 2008, section 4.7, with E24.
#include "palpate/deform/strain.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "palpate/base/elementary.h"

namespace palpate::deform {

namespace {

/// Skin without strain: light enough for both colours to show, dark enough to show shading.
constexpr Rgb kNeutral{225, 220, 215};
constexpr Rgb kTension{200, 20, 30};
constexpr Rgb kCompression{30, 60, 200};

/// Two unit vectors across a unit normal.
struct TangentPlane {
  Vec3 x;
  Vec3 y;
  explicit TangentPlane(const Vec3& normal) : x(normal.unitOrthogonal()), y(normal.cross(x)) {}
};

/// Normal equations for the three numbers of a symmetric tensor: E_xx, E_yy, 2 E_xy.
class Rosette {
 public:
  explicit Rosette(const TangentPlane& plane) : plane_(plane) {}

  void addGauge(const Vec3& edge, const Vec3& stretch) {
    const Vec2 direction(edge.dot(plane_.x), edge.dot(plane_.y));
    const double flat2 = direction.squaredNorm();
    const double length2 = edge.squaredNorm();
    if (!(flat2 > kSteep * length2)) return;
    const double green = (2.0 * edge + stretch).dot(stretch) / (2.0 * length2);
    const Vec3 row(direction.x() * direction.x(), direction.y() * direction.y(), direction.x() * direction.y());
    matrix_ += (row / flat2) * (row / flat2).transpose();
    right_ += row / flat2 * green;
  }

  PrincipalStrains solved() const {
    if (right_.isZero(0.0)) return {};
    const Eigen::LDLT<Mat3> factors(matrix_);
    // The pivots of three gauges in good directions are around 0.1; of two directions only one is 0.
    if (!(factors.vectorD().minCoeff() > kSingular)) return {};
    const Vec3 strain = factors.solve(right_);
    const double middle = 0.5 * (strain[0] + strain[1]);
    const double radius = 0.5 * elementary::hypot(strain[0] - strain[1], strain[2]);
    return {lengthening(middle + radius), lengthening(middle - radius)};
  }

 private:
  /// Squared cosine below which an edge is perpendicular to the tangent plane and ignored.
  static constexpr double kSteep = 1e-6;
  static constexpr double kSingular = 1e-9;

  /// Relative change of length of a Green strain; -1 is squashed flat.
  static double lengthening(double green) { return 2.0 * green / (std::sqrt(std::max(0.0, 1.0 + 2.0 * green)) + 1.0); }

  const TangentPlane& plane_;
  Mat3 matrix_ = Mat3::Zero();
  Vec3 right_ = Vec3::Zero();
};

}  // namespace

double edgeStrain(const Vec3& rest_edge_mm, const Vec3& stretch_mm) noexcept {
  const double rest = rest_edge_mm.norm();
  if (!(rest > 0.0)) return 0.0;
  // |e + s| - |e| without the cancellation of two nearly equal lengths.
  const double grown2 = (2.0 * rest_edge_mm + stretch_mm).dot(stretch_mm);
  return grown2 / (rest * ((rest_edge_mm + stretch_mm).norm() + rest));
}

float strainOfVertex(const Skin& skin, const PositionStreams& displacements, Index vertex) noexcept {
  const PositionStreams places{skin.rest[0], skin.rest[1], skin.rest[2]};
  const Vec3 place = places.at(vertex);
  const Vec3 moved = displacements.at(vertex);
  double sum = 0.0;
  const auto ring = skin.neighbours[vertex];
  for (const Index w : ring) sum += edgeStrain(places.at(w) - place, displacements.at(w) - moved);
  return ring.empty() ? 0.0f : static_cast<float>(sum / static_cast<double>(ring.size()));
}

PrincipalStrains principalStrains(const Skin& skin, const PositionStreams& displacements, Index vertex) noexcept {
  const Vec3 normal = skin.restNormal(vertex).cast<double>();
  if (!(normal.squaredNorm() > 0.0)) return {};
  const TangentPlane plane(normal);
  const PositionStreams places{skin.rest[0], skin.rest[1], skin.rest[2]};
  Rosette rosette(plane);
  for (const Index t : skin.triangles_of_vertex[vertex]) {
    const Triangle& corners = skin.triangles[t];
    for (std::size_t i = 0; i < 3; ++i) {
      const Index from = corners[i];
      const Index to = corners[(i + 1) % 3];
      rosette.addGauge(places.at(to) - places.at(from), displacements.at(to) - displacements.at(from));
    }
  }
  return rosette.solved();
}

Rgb strainColour(float strain, float range) noexcept {
  if (std::isnan(strain) || !(range > 0.0f)) return kNeutral;
  const float share = std::min(std::abs(strain) / range, 1.0f);
  const Rgb& full = strain > 0.0f ? kTension : kCompression;
  Rgb colour{};
  for (std::size_t i = 0; i < 3; ++i) {
    const float from = kNeutral[i];
    colour[i] = static_cast<std::uint8_t>(std::lround(from + share * (static_cast<float>(full[i]) - from)));
  }
  return colour;
}

void colourByStrain(std::span<const float> strain, float range, std::span<Rgb> colours) noexcept {
  for (std::size_t v = 0; v < strain.size(); ++v) colours[v] = strainColour(strain[v], range);
}

}  // namespace palpate::deform
