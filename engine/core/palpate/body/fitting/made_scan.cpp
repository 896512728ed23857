#include "palpate/body/fitting/made_scan.h"

#include <cmath>

#include "palpate/base/elementary.h"
#include "palpate/base/random.h"
#include "palpate/body/back.h"

namespace palpate::body {

namespace {

constexpr std::size_t kScanTriangles = 12000;
constexpr double kNoiseMm = 0.25;  // hand-held scanners of structured light
constexpr std::uint64_t kScanSeed = 7;
const Vec2 kHoleAt(62.0, -48.0);
const Vec2 kHoleHalf(34.0, 24.0);
constexpr double kRaggedMm = 9.0;

/// Waves of the edge in a direction, -1 to 1.
double waves(double angle) {
  return 0.5 * elementary::sin(3.0 * angle + 0.4) + 0.3 * elementary::sin(7.0 * angle + 1.9) +
         0.2 * elementary::sin(12.0 * angle);
}

bool inHole(const Vec3& place) {
  const Vec2 at = (place.head<2>() - kHoleAt).cwiseQuotient(kHoleHalf);
  return at.norm() < 1.0 + 0.22 * waves(elementary::atan2(at.y(), at.x()));
}

/// The scan ends a little within the patch, here more and there less.
bool beyondBorder(const Vec3& place, const Eigen::AlignedBox3d& box) {
  const Vec2 middle = box.center().head<2>();
  const Vec2 half = 0.5 * box.sizes().head<2>();
  const Vec2 at = place.head<2>() - middle;
  const double inside = (half - at.cwiseAbs()).minCoeff();
  return inside < kRaggedMm * (1.0 + waves(2.0 * elementary::atan2(at.y(), at.x())));
}

}  // namespace

mesh::TriangleMesh makeScan() {
  Skin skin = makeBackSkin({kScanTriangles, {.stature_mm = 1750, .relief = {}, .asymmetry = 1}});
  Random random(kScanSeed);
  mesh::TriangleMesh scan = std::move(skin.mesh);
  const Eigen::AlignedBox3d box = mesh::boundingBox(scan);
  std::erase_if(scan.triangles, [&](const Triangle& t) {
    const Vec3 middle = mesh::centreOf(scan, t);
    return inHole(middle) || beyondBorder(middle, box);
  });
  for (std::size_t v = 0; v < scan.positions.size(); ++v) {
    scan.positions[v] += kNoiseMm * random.normal() * skin.normals[v];
  }
  return scan;
}

}  // namespace palpate::body
