// A smooth cap, as high as the scene says, along the normal of the skin over the lump. The bones stay, so there is more
// tissue over them. Cold: a pass over the vertices for each swelling.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "palpate/base/elementary.h"
#include "palpate/base/error.h"
#include "palpate/body/places.h"
#include "palpate/scene/body_parts.h"
#include "palpate/scene/lumps_of_body.h"

namespace palpate::scene {

namespace {

/// Where the middle of a cap stands.
struct CapPlace {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  ///< unit
};

Vec2 placeOf(const LumpSettings& lump, const BodyParts& body) {
  if (lump.at.empty()) return {lump.x_mm, lump.y_mm};
  return body::placeNamed(body.anatomy.landmarks, lump.at).point.head<2>();
}

/// The height of a triangle over a place of the map plane, where it looks up there.
std::optional<double> heightOver(const std::array<Vec3, 3>& corners, const Vec2& place) {
  const auto side = [&](const Vec3& a, const Vec3& b) {
    return (b.x() - a.x()) * (place.y() - a.y()) - (b.y() - a.y()) * (place.x() - a.x());
  };
  const double c = side(corners[0], corners[1]);
  const double a = side(corners[1], corners[2]);
  const double b = side(corners[2], corners[0]);
  if (a < 0.0 || b < 0.0 || c < 0.0 || !(a + b + c > 0.0)) return std::nullopt;
  return (a * corners[0].z() + b * corners[1].z() + c * corners[2].z()) / (a + b + c);
}

std::optional<CapPlace> capPlace(const mesh::TriangleMesh& skin, const Vec2& place) {
  std::optional<CapPlace> highest;
  for (const Triangle& triangle : skin.triangles) {
    const std::array<Vec3, 3> corners = {skin.positions[triangle[0]], skin.positions[triangle[1]],
                                         skin.positions[triangle[2]]};
    const std::optional<double> height = heightOver(corners, place);
    if (!height || (highest && *height <= highest->point.z())) continue;
    highest = {{place.x(), place.y(), *height},
               mesh::areaVector2(corners[0], corners[1], corners[2]).stableNormalized()};
  }
  return highest;
}

/// How wide a cap is: a deep lump lifts a wide one.
double capRadius(const LumpSettings& lump) {
  const Vec3 half = lump.halfAxes();
  return 1.5 * elementary::pow(half.x() * half.y() * half.z(), 1.0 / 3.0) + lump.depth_mm;
}

/// The mean normal of the skin within the cap, so that no single facet turns it.
Vec3 meanNormal(const mesh::TriangleMesh& skin, const CapPlace& cap, double radius_mm) {
  Vec3 sum = Vec3::Zero();
  for (const Triangle& triangle : skin.triangles) {
    const Vec3& a = skin.positions[triangle[0]];
    if ((a - cap.point).squaredNorm() > radius_mm * radius_mm) continue;
    const Vec3 area = mesh::areaVector2(a, skin.positions[triangle[1]], skin.positions[triangle[2]]);
    if (area.dot(cap.normal) > 0.0) sum += area;
  }
  return sum.norm() > 0.0 ? Vec3(sum.normalized()) : cap.normal;
}

/// The vertices of skin that looks the cap's way: the other side of a limb stays as it is.
std::vector<std::uint8_t> facing(const mesh::TriangleMesh& skin, const Vec3& normal) {
  std::vector<Vec3> normals(skin.positions.size(), Vec3::Zero());
  for (const Triangle& triangle : skin.triangles) {
    const Vec3 area = mesh::areaVector2(skin, triangle);
    for (const Index vertex : triangle) normals[vertex] += area;
  }
  std::vector<std::uint8_t> looks(normals.size());
  std::ranges::transform(normals, looks.begin(), [&](const Vec3& one) { return one.dot(normal) > 0.0 ? 1 : 0; });
  return looks;
}

void raise(const LumpSettings& lump, BodyParts& body) {
  const Vec2 place = placeOf(lump, body);
  std::optional<CapPlace> cap = capPlace(body.skin, place);
  if (!cap) throw Error(fmt::format("lump '{}': there is no skin above it to raise", lump.name));
  const double radius = capRadius(lump);
  cap->normal = meanNormal(body.skin, *cap, radius);
  const std::vector<std::uint8_t> looks = facing(body.skin, cap->normal);
  for (std::size_t v = 0; v < body.skin.positions.size(); ++v) {
    const Vec3 from = body.skin.positions[v] - cap->point;
    const double along = from.dot(cap->normal);
    const double q2 = (from - along * cap->normal).squaredNorm() / (radius * radius);
    if (looks[v] == 0 || q2 >= 1.0 || std::abs(along) > radius) continue;
    const double height = lump.raise_mm * (1.0 - q2) * (1.0 - q2);
    body.skin.positions[v] += height * cap->normal;
    if (!body.anatomy.depth_mm.empty()) body.anatomy.depth_mm[v] += height;
  }
}

std::vector<const LumpSettings*> findSwellings(const Scene& scene) {
  std::vector<const LumpSettings*> swellings;
  for (const LumpSettings& lump : scene.lumps) {
    if (lump.raise_mm > 0.0) swellings.push_back(&lump);
  }
  return swellings;
}

bool areAlike(const LumpSettings& one, const LumpSettings& other) {
  const bool same_place = one.at == other.at && (!one.at.empty() || (one.x_mm == other.x_mm && one.y_mm == other.y_mm));
  return same_place && one.raise_mm == other.raise_mm && one.depth_mm == other.depth_mm &&
         one.halfAxes() == other.halfAxes();
}

}  // namespace

void raiseSkin(const Scene& scene, BodyParts& body) {
  for (const LumpSettings* lump : findSwellings(scene)) {
    try {
      raise(*lump, body);
    } catch (const Error& error) {
      if (lump->line == 0) throw;
      throw Error::atLine(lump->scene_file, lump->line, error.what());
    }
  }
}

bool haveEqualSwellings(const Scene& one, const Scene& other) {
  const std::vector<const LumpSettings*> here = findSwellings(one);
  const std::vector<const LumpSettings*> there = findSwellings(other);
  return std::equal(here.begin(), here.end(), there.begin(), there.end(),
                    [](const LumpSettings* a, const LumpSettings* b) { return areAlike(*a, *b); });
}

}  // namespace palpate::scene
