#include "support/textured_bytes.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace palpate::support {

mesh::TexturePlace onSheet(const Vec3& place, const Vec3& /*middle*/) {
  return (place.head<2>() / 100.0).cast<float>();
}

mesh::TexturePlace onCube(const Vec3& place, const Vec3& middle) {
  const Vec3 out = (middle - Vec3::Constant(5.0)).cwiseAbs();
  Eigen::Index axis = 0;
  out.maxCoeff(&axis);
  const double column = static_cast<double>(axis) / 3.0;
  const double row = middle[axis] > 5.0 ? 0.5 : 0.0;
  const Vec2 within(place[(axis + 1) % 3], place[(axis + 2) % 3]);
  return Vec2(column + within.x() / 30.0, row + within.y() / 20.0).cast<float>();
}

mesh::TexturePlace onSphere(const Vec3& place, const Vec3& middle) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const double about = std::atan2(middle.y(), middle.x());
  const bool at_pole = place.head<2>().norm() < 1e-9 * place.norm();
  const double angle = at_pole ? about : std::atan2(place.y(), place.x());
  const double u = about + std::remainder(angle - about, kTurn);
  return Vec2(0.5 + u / kTurn, 0.5 + 0.5 * place.z() / place.norm()).cast<float>();
}

std::vector<mesh::TextureCorners> cornersBy(const TextureLaw& law, const mesh::TriangleMesh& mesh) {
  std::vector<mesh::TextureCorners> corners;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 middle = centreOf(mesh, t);
    corners.push_back(
        {law(mesh.positions[t[0]], middle), law(mesh.positions[t[1]], middle), law(mesh.positions[t[2]], middle)});
  }
  return corners;
}

std::string texturedObjBytes(const mesh::TriangleMesh& mesh, const TextureLaw& law) {
  std::string text;
  for (const Vec3& p : mesh.positions) text += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
  const std::vector<mesh::TextureCorners> corners = cornersBy(law, mesh);
  for (std::size_t t = 0; t < corners.size(); ++t) {
    for (const mesh::TexturePlace& place : corners[t]) text += fmt::format("vt {} {}\n", place.x(), place.y());
    const auto& [a, b, c] = mesh.triangles[t];
    text += fmt::format("f {}/-3 {}/-2 {}/-1\n", a + 1, b + 1, c + 1);
  }
  return text;
}

}  // namespace palpate::support
