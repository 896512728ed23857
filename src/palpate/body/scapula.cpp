// The scapula in its own frame: u lateral along its spine, v cranial, n dorsal (stored as x, y, z), origin where the
// spine meets the medial border. A thin curved blade cut by an outline, with a roll along the medial border, a pillar
// along the lateral one, neck and glenoid, the spine as a fin, acromion and coracoid as chains of capsules.
//
// Sizes guided by: von Schroeder 2001, Clin Orthop 383:131 (superior to inferior angle 155 +- 16, spine 134 +- 12,
// acromion 48 x 22 x 9, glenoid 36 x 29, spine width 7 / 18 / 46 along it, medial border 4) [A]; Siriraj Med J 2004
// (length 139, lateral border 8.2, inferior angle 41 degrees) [A]. Rest: level of the spine's root T3, of the inferior
// angle T8 (mean T8.03, PMC2647093) [A]; 41 degrees internal, 5 upward, 13 tilt, Ludewig 2009, is [R] recalled. The
// coordinates are construction values of our choice.
#include "palpate/body/scapula.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "palpate/body/cubic_spline.h"
#include "palpate/body/signed_distance.h"
#include "palpate/body/tetrahedra_mesher.h"

namespace palpate::body {
namespace {

// Placement: where the spine's root lies and how the blade is turned, solved for the depths under the fitted skin
// (root 9.4, inferior angle 11.6, acromion at least 4 mm).
const Vec3 kRoot{81.0, 101.0, 95.0};
constexpr double kTiltDeg = 10.5;      // about u: the upper border leans forwards
constexpr double kUpwardDeg = 0.5;     // about n: the lateral side rises
constexpr double kInternalDeg = 41.6;  // about y: the lateral side turns forwards

const std::vector<Vec3> kOutline = {{8, 43, 0},    {2, 30, 0},   {0, 12, 0},   {0, 0, 0},     {1, -20, 0},
                                    {3, -45, 0},   {6, -72, 0},  {10, -95, 0}, {16, -110, 0}, {24, -112, 0},
                                    {32, -101, 0}, {45, -80, 0}, {60, -57, 0}, {76, -36, 0},  {90, -22, 0},
                                    {98, -14, 0},  {101, 2, 0},  {98, 18, 0},  {90, 26, 0},   {80, 25, 0},
                                    {72, 24, 0},   {66, 30, 0},  {50, 37, 0},  {30, 43, 0},   {16, 46, 0}};
constexpr std::size_t kOutlinePoints = 160;  // of the polygon: sagitta below 0.05 mm

// The crest of the spine: u, v at the blade, height over the blade.
const std::vector<Vec3> kCrest = {{2, 1, 3}, {12, 3, 7}, {40, 7, 18}, {70, 12, 26}, {90, 15, 31}};
constexpr double kFinLean = 0.22;  // v per height: the spine leans cranially
constexpr double kFinHalfThickness = 1.7;

double square(double x) { return x * x; }

// The blade's middle surface over its plane: hollow towards the ribs, the superior angle bent forwards.
double bladeOffset(double u, double v) {
  const double dome = 5.0 * (1.0 - square((u - 48.0) / 52.0)) * std::max(0.0, 1.0 - square((v + 30.0) / 95.0));
  return dome - 0.016 * square(std::max(0.0, v - 12.0));
}

Vec3 onBlade(double u, double v) { return {u, v, bladeOffset(u, v)}; }

// A chain of capsules along a spline, joined by the plain minimum: a smooth union would bulge at every joint.
class Tube {
 public:
  Tube(const std::vector<Vec3>& points, const std::vector<double>& radii, std::size_t pieces) {
    const CubicSpline line(points);
    const auto at = [&](std::size_t i) { return line.length() * static_cast<double>(i) / static_cast<double>(pieces); };
    const auto radius = [&](double s) {
      const double place = s / line.length() * static_cast<double>(radii.size() - 1);
      const auto i = std::min(static_cast<std::size_t>(place), radii.size() - 2);
      return mix(radii[i], radii[i + 1], place - static_cast<double>(i));
    };
    for (std::size_t i = 0; i < pieces; ++i) {
      capsules_.push_back({line.at(at(i)), line.at(at(i + 1)), radius(at(i)), radius(at(i + 1))});
    }
  }
  double distance(const Vec3& p) const {
    double d = capsules_.front().distance(p);
    for (const Capsule& c : capsules_) d = std::min(d, c.distance(p));
    return d;
  }

 private:
  std::vector<Capsule> capsules_;
};

// The same with elliptic sections.
class EllipticTube {
 public:
  struct Ring {
    Vec3 centre, wide_direction;
    EllipticCapsule::HalfAxes axes;
  };
  EllipticTube(const std::vector<Ring>& rings, std::size_t pieces_per_ring) {
    std::vector<Vec3> points;
    for (const Ring& ring : rings) points.push_back(ring.centre);
    const CubicSpline line(points);
    for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
      for (std::size_t k = 0; k < pieces_per_ring; ++k) {
        const double from = static_cast<double>(k) / static_cast<double>(pieces_per_ring);
        const double to = static_cast<double>(k + 1) / static_cast<double>(pieces_per_ring);
        const auto place = [&](double t) { return line.at(mix(line.knot(i), line.knot(i + 1), t)); };
        const auto axes = [&](double t) {
          return EllipticCapsule::HalfAxes{mix(rings[i].axes.wide, rings[i + 1].axes.wide, t),
                                           mix(rings[i].axes.thick, rings[i + 1].axes.thick, t)};
        };
        const Vec3 wide = mix3(rings[i].wide_direction, rings[i + 1].wide_direction, 0.5 * (from + to));
        capsules_.emplace_back(place(from), place(to), wide, axes(from), axes(to));
      }
    }
  }
  double distance(const Vec3& p) const {
    double d = capsules_.front().distance(p);
    for (const EllipticCapsule& c : capsules_) d = std::min(d, c.distance(p));
    return d;
  }

 private:
  static Vec3 mix3(const Vec3& from, const Vec3& to, double t) { return from + t * (to - from); }
  std::vector<EllipticCapsule> capsules_;
};

// Signed distance in the plane of the blade to its outline.
class Outline {
 public:
  Outline() {
    for (const Vec3& p : CubicSpline(kOutline, CubicSpline::Ends::closed).evenly(kOutlinePoints)) {
      polygon_.emplace_back(p.x(), p.y());
    }
  }
  double distance(const Vec2& p) const {
    double nearest2 = (p - polygon_[0]).squaredNorm();
    bool inside = false;
    for (std::size_t i = 0, j = polygon_.size() - 1; i < polygon_.size(); j = i++) {
      const Vec2 edge = polygon_[j] - polygon_[i];
      const Vec2 w = p - polygon_[i];
      const double t = std::clamp(w.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
      nearest2 = std::min(nearest2, (w - t * edge).squaredNorm());
      const bool crosses = (polygon_[i].y() > p.y()) != (polygon_[j].y() > p.y());
      if (crosses && w.x() < edge.x() * w.y() / edge.y()) inside = !inside;
    }
    return (inside ? -1.0 : 1.0) * std::sqrt(nearest2);
  }

 private:
  std::vector<Vec2> polygon_;
};

struct Parts {
  Outline outline;
  Tube medial_roll{{onBlade(9, 41), onBlade(3.5, 28), onBlade(2.2, 5), onBlade(3, -20), onBlade(5, -45),
                    onBlade(8, -72), onBlade(12, -95)},
                   {2.0, 2.2, 2.6, 2.6, 2.8, 3.1, 3.4},
                   24};
  Tube pillar{{onBlade(27, -104), onBlade(42, -80), onBlade(57, -57.5), onBlade(73, -36), onBlade(88, -19)},
              {4.2, 4.4, 4.8, 5.4, 6.0},
              16};
  EllipticCapsule neck{onBlade(86, 2), onBlade(101, 3), Vec3::UnitY(), {12.0, 8.0}, {17.0, 11.5}};
  CubicSpline crest_line{kCrest};
  Tube crest{crestPoints(), {2.6, 2.6, 3.2, 4.0, 4.4}, 20};
  EllipticTube acromion{acromionRings(), 4};
  EllipticTube coracoid{{{{86, 24, 0}, Vec3::UnitX(), {8, 6}},
                         {{92, 36, -10}, Vec3::UnitX(), {7, 5.6}},
                         {{112, 30, -34}, Vec3::UnitY(), {6, 5}}},
                        6};

  static std::vector<Vec3> crestPoints() {
    std::vector<Vec3> points;
    for (const Vec3& c : kCrest)
      points.emplace_back(c.x(), c.y() + kFinLean * c.z(), bladeOffset(c.x(), c.y()) + c.z());
    return points;
  }

  // A flat plate that turns forwards around the head of the humerus; its wide side looks up and outwards.
  static std::vector<EllipticTube::Ring> acromionRings() {
    const Vec3 wide = Vec3::UnitY();
    return {{{88, 21, 31}, wide, {6.0, 4.5}},
            {{103, 27, 32}, wide, {8.0, 4.5}},
            {{114, 32, 27}, Vec3(-0.5, 1, 0).normalized(), {10.5, 4.5}},
            {{121, 38, 13}, Vec3(-1, 0.8, 0).normalized(), {11.5, 4.5}},
            {{118, 42, -3}, Vec3(-1, 0.6, 0).normalized(), {9.0, 4.5}}};
  }

  double bladeDistance(const Vec3& p) const {
    const double near_neck = std::clamp((p.x() - 60.0) / 30.0, 0.0, 1.0);
    const double half = 2.0 + 0.8 * near_neck;
    const double slab = std::abs(p.z() - bladeOffset(p.x(), p.y())) - half;
    if (slab > 12.0) return slab;  // far from the blade the outline does not matter
    return roundedIntersection(outline.distance({p.x(), p.y()}), slab, 1.5);
  }

  double finDistance(const Vec3& p) const {
    const double u = std::clamp(p.x(), kCrest.front().x(), kCrest.back().x());
    const Vec3 crest_here = crestAt(u);
    const double height = p.z() - bladeOffset(p.x(), p.y());
    const double wall = std::abs(p.y() - kFinLean * height - crest_here.y()) - kFinHalfThickness;
    const double top = height - crest_here.z();
    const double end = std::max(kCrest.front().x() - p.x(), p.x() - kCrest.back().x());
    return std::max({wall, top, -height - 1.0, end});
  }

  // The crest's v and height at u: its spline is monotonic in u, so a few bisections find the place.
  Vec3 crestAt(double u) const {
    double low = 0.0;
    double high = crest_line.length();
    for (int i = 0; i < 12; ++i) (crest_line.at(0.5 * (low + high)).x() < u ? low : high) = 0.5 * (low + high);
    return crest_line.at(0.5 * (low + high));
  }

  double distance(const Vec3& p) const {
    double d = smoothUnion(bladeDistance(p), medial_roll.distance(p), 2.0);
    d = smoothUnion(d, pillar.distance(p), 3.0);
    d = smoothUnion(d, ellipsoidDistance(p - onBlade(21, -102), {9.0, 9.0, 4.2}), 3.0);
    d = smoothUnion(d, neck.distance(p), 4.0);
    d = smoothDifference(d, (p - Vec3(131.0, 3.0, 0.0)).norm() - 27.5, 1.5);  // the glenoid's hollow
    d = smoothUnion(d, std::min(finDistance(p), crest.distance(p)), 3.0);
    d = smoothUnion(d, acromion.distance(p), 4.0);
    return smoothUnion(d, coracoid.distance(p), 4.0);
  }
};

Eigen::Isometry3d placement() {
  const auto turn = [](double degrees, const Vec3& axis) {
    return Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis);
  };
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.translate(kRoot);
  frame.rotate(turn(kInternalDeg, Vec3::UnitY()) * turn(kUpwardDeg, Vec3::UnitZ()) * turn(-kTiltDeg, Vec3::UnitX()));
  return frame;
}

}  // namespace

mesh::TriangleMesh makeRightScapula(double cell_mm) {
  const Parts parts;
  MesherSettings box;
  box.low = {-6.0, -122.0, -46.0};
  box.high = {140.0, 62.0, 44.0};
  box.cell_mm = cell_mm;
  mesh::TriangleMesh mesh = meshZeroSurface([&](const Vec3& p) { return parts.distance(p); }, box);
  const Eigen::Isometry3d frame = placement();
  for (Vec3& p : mesh.positions) p = frame * p;
  return mesh;
}

ScapulaPoints rightScapulaPoints() {
  const Eigen::Isometry3d frame = placement();
  const auto raised = [&](double u, double v, double n) { return frame * Vec3(onBlade(u, v) + n * Vec3::UnitZ()); };
  return {raised(12, 43, 2.5), raised(2, 1.6, 5.6), raised(20, -106, 4.2), frame * Vec3(112, 31, 33)};
}

}  // namespace palpate::body
