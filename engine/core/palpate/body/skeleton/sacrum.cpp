// The sacrum with the coccyx grown to it, in a frame of its own: x right, v along the chord from the first endplate to
// the apex (down and back), n dorsal. A thick plate hollow towards the pelvis, whose width, depth and bend follow
// tables over v; endplate, facets, crests and the coccyx are added, canal and four pairs of foramina are cut out.
//
// Sizes guided by: length 105-110 along the chord and breadth 115 of men, textbook values, [R] recalled; sacral slope
// 40 standing, lying less [R]; endplate of S1 about 50 x 34 [R]; anterior foramina 4 pairs [S]. Here breadth 111,
// chord 108, slope 33 degrees: the lumbar spine of this body is a flat one (L1-L5 24 degrees). The tables over v are
// construction values of our choice.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "palpate/base/elementary.h"
#include "palpate/body/rotation.h"
#include "palpate/body/signed_distance.h"
#include "palpate/body/skeleton/skeleton_shapes.h"
#include "palpate/body/tetrahedra_mesher.h"

namespace palpate::body {
namespace {

const Vec3 kOrigin{0.0, -284.5, 17.0};  // the middle of the first endplate, one disc (8.8 mm) below L5
constexpr double kChordDeg = 36.0;      // the chord from the vertical, backwards
constexpr double kEndplateDeg = 3.0;    // endplate upwards from the chord: a sacral slope of 33

// Half width, ventral and dorsal face at a place v of the chord.
struct SacralSection {
  double v, half_width, ventral, dorsal;
};
constexpr std::array<SacralSection, 9> kSections = {{{-6, 53, -14, 28},
                                                     {8, 56, -12, 31},
                                                     {26, 55, -2, 36},
                                                     {44, 47, 9, 39},
                                                     {62, 36, 14, 39},
                                                     {80, 27, 12, 31},
                                                     {96, 18, 4, 17},
                                                     {108, 10, -4, 6},
                                                     {116, 8, -8, 1}}};

SacralSection sacralSectionAt(double v) {
  const auto next =
      std::find_if(kSections.begin() + 1, kSections.end() - 1, [&](const SacralSection& s) { return s.v > v; });
  const SacralSection& before = *(next - 1);
  const double t = std::clamp((v - before.v) / (next->v - before.v), 0.0, 1.0);
  return {v, mix(before.half_width, next->half_width, t), mix(before.ventral, next->ventral, t),
          mix(before.dorsal, next->dorsal, t)};
}

struct Foramen {
  double v, x, radius;
};
constexpr std::array<Foramen, 4> kForamina = {{{24, 22.5, 4.6}, {43, 20.0, 4.3}, {60, 16.5, 3.6}, {76, 13.5, 3.0}}};

// Spinous tubercles of S1 to S4: their place on the chord and how far they rise over the dorsal face.
struct Tubercle {
  double v, rise;
};
constexpr std::array<Tubercle, 4> kMedianCrest = {{{19, 8.0}, {38, 8.5}, {56, 7.5}, {72, 5.0}}};

// Middle of each piece of the coccyx and its half width; it bends forwards.
constexpr std::array<std::array<double, 3>, 4> kCoccyx = {
    {{111, -2.5, 10.0}, {118.5, -8.0, 8.0}, {123.5, -14.5, 6.2}, {126.5, -21.5, 5.0}}};

Eigen::Isometry3d sacralFrame() {
  // The axis v of the table points down; here (x, -v, n) is right-handed, so y of the frame is -v.
  Eigen::Isometry3d placed = Eigen::Isometry3d::Identity();
  placed.translate(kOrigin);
  placed.rotate(rotationAbout(Vec3::UnitX(), radians(-kChordDeg)));
  return placed;
}

struct SacrumParts {
  std::vector<PlateCapsule> tubercles;
  std::vector<Capsule> lateral_crest, intermediate;
  PlateCapsule facet{{23.5, -10, 26}, {24, 2.5, 25}, Vec3(0.5, 0, 1).normalized(), {6.5, 3.4}};
  Tube crest_ridge{{{0, -14, 33}, {0, -38, 39}, {0, -56, 40.5}, {0, -76, 34}}, {3.0, 2.2}, 6};
  EllipticCapsule canal{{0, 12, 21}, {0, -74, 28}, Vec3::UnitX(), {15.5, 8.5}, {5.0, 2.6}};
  std::vector<EllipticCapsule> coccyx;

  SacrumParts() {
    for (const Tubercle& t : kMedianCrest) {
      const SacralSection s = sacralSectionAt(t.v);
      tubercles.push_back(
          {{0, -t.v, s.dorsal - 2.0}, {0, -t.v - 3.0, s.dorsal + t.rise - 2.6}, Vec3::UnitY(), {7.5, 3.4}, {5.2, 2.6}});
    }
    for (const Foramen& f : kForamina) {
      const SacralSection s = sacralSectionAt(f.v + 9.0);
      lateral_crest.push_back({{s.half_width - 13.0, -f.v - 8.0, s.dorsal - 7.0},
                               {s.half_width - 12.0, -f.v - 11.0, s.dorsal - 5.5},
                               4.0,
                               3.4});
    }
    for (std::size_t i = 0; i + 1 < kCoccyx.size(); ++i) {
      const auto& a = kCoccyx[i];
      const auto& b = kCoccyx[i + 1];
      coccyx.push_back({{0, -a[0], a[1]},
                        {0, -b[0] + 2.5, b[1] + 1.5},
                        Vec3::UnitX(),
                        {a[2], 4.6 - 0.3 * double(i)},
                        {b[2] - 0.6, 3.4}});
    }
  }

  // The plate: rounded in the section (x, n), its dorsal face falling away to the sides, the wings set back in front.
  double plateDistance(const Vec3& p) const {
    const double v = -p.y();
    const SacralSection s = sacralSectionAt(v);
    const double side = std::clamp(std::abs(p.x()) / s.half_width, 0.0, 1.2);
    const double ventral = s.ventral + 9.0 * side * side * std::clamp(1.0 - v / 60.0, 0.0, 1.0) + 3.0 * side * side;
    const double dorsal = s.dorsal - 11.0 * side * side * std::clamp(1.3 - v / 80.0, 0.2, 1.0);
    const double half = 0.5 * (dorsal - ventral);
    const double slab = std::abs(p.z() - 0.5 * (dorsal + ventral)) - half;
    const double across = roundedIntersection(std::abs(p.x()) - s.half_width, 0.92 * slab, std::min(9.0, 0.8 * half));
    // The upper face slopes down to the sides, over the wings, and to the back, where the canal opens under L5.
    const double top = 0.82 * (p.y() - 1.0 + 13.0 * std::clamp((std::abs(p.x()) - 20.0) / 36.0, 0.0, 1.2) +
                               12.0 * std::clamp((p.z() - 16.0) / 16.0, 0.0, 1.4));
    return std::max(roundedIntersection(across, top, 4.0), -108.0 - p.y());
  }

  double endplateDistance(const Vec3& p) const {
    // A short column, its top turned by the slope of the endplate.
    const double turn = radians(kEndplateDeg);
    const double up = elementary::cos(turn) * p.y() + elementary::sin(turn) * p.z();
    const double back = elementary::cos(turn) * p.z() - elementary::sin(turn) * p.y();
    const double side = superellipseDistance(p.x(), back, 24.5, 16.8, 2.4);
    return roundedIntersection(side, std::abs(up + 11.0) - 11.0, 2.2);
  }

  double distance(const Vec3& p) const {
    double d = smoothUnion(plateDistance(p), endplateDistance(p), 5.0);
    for (const Capsule& crest : lateral_crest) d = smoothUnion(d, crest.distance(p), 4.0);
    d = smoothDifference(d, canal.distance(p), 2.0);
    d = smoothUnion(d, crest_ridge.distance(p), 3.0);
    d = smoothUnion(d, nearestDistance(tubercles, p), 3.0);
    d = smoothUnion(d, facet.distance(p), 3.0);
    for (const Foramen& f : kForamina) {
      d = smoothDifference(d, elementary::hypot(p.x() - f.x, p.y() + f.v) - f.radius, 2.5);
    }
    return smoothUnion(d, nearestDistance(coccyx, p), 2.5);
  }
};

const SacrumParts& sacrumParts() {
  static const SacrumParts made;
  return made;
}

}  // namespace

mesh::TriangleMesh makeSacrumHalf(double cell_mm) {
  const MesherSettings box{.low = {0.0, -146.0, -30.0}, .high = {64.0, 24.0, 54.0}, .cell_mm = cell_mm};
  mesh::TriangleMesh half = relaxedSurface(sacrumParts(), box, kSkeletonRelaxRounds);
  const Eigen::Isometry3d placed = sacralFrame();
  for (Vec3& p : half.positions) {
    const double x = p.x();  // the turn is about x: the border stays in the plane to the last bit
    p = placed * p;
    p.x() = x;
  }
  return half;
}

double sacrumDistance(const Vec3& p) {
  static const Eigen::Isometry3d inverse = sacralFrame().inverse();
  Vec3 local = inverse * p;
  local.x() = std::abs(local.x());
  return sacrumParts().plateDistance(local);
}

SacrumPoints sacrumPoints() {
  const Eigen::Isometry3d placed = sacralFrame();
  SacrumPoints points;
  for (std::size_t i = 0; i < 3; ++i) {
    const Tubercle& t = kMedianCrest[i];
    points.median_crest[i] = placed * Vec3(0.0, -t.v - 3.0, sacralSectionAt(t.v).dorsal + t.rise);
  }
  points.promontory = placed * Vec3(0.0, -2.0, -16.0);
  points.coccyx_tip = placed * Vec3(0.0, -kCoccyx.back()[0] + 1.5, kCoccyx.back()[1] - 2.0);
  return points;
}

}  // namespace palpate::body
