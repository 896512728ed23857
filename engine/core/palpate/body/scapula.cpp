// The scapula in its own frame: u lateral along its spine, v cranial, n dorsal (stored as x, y, z), origin where the
// spine meets the medial border. A thin curved blade cut by an outline, with a roll along the medial border, a pillar
// along the lateral one, neck and glenoid, the spine as a fin, acromion and coracoid as chains of capsules.
//
// Sizes guided by: von Schroeder 2001, Clin Orthop 383:131 (superior to inferior angle 155 +- 16, spine 134 +- 12,
// acromion 48 x 22 x 9, glenoid 36 x 29, spine width 7 / 18 / 46 along it, medial border 4) [A]; Siriraj Med J 2004
// (length 139, lateral border 8.2, inferior angle 41 degrees) [A]. Rest: level of the spine's root T3, of the inferior
// angle T8 (mean T8.03, PMC2647093) [A]; 41 degrees internal, 5 upward, 13 tilt, Ludewig 2009, is [R] recalled. The
// coordinates are construction values of our choice.
#include "palpate/body/bone_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "palpate/base/elementary.h"
#include "palpate/body/cubic_spline.h"
#include "palpate/body/plane_outline.h"
#include "palpate/body/rotation.h"
#include "palpate/body/signed_distance.h"
#include "palpate/body/tetrahedra_mesher.h"

namespace palpate::body {
namespace {

const std::vector<Vec3> kOutline = {{8, 43, 0},    {2, 30, 0},   {0, 12, 0},   {0, 0, 0},     {1, -20, 0},
                                    {3, -45, 0},   {6, -72, 0},  {10, -95, 0}, {16, -110, 0}, {24, -112, 0},
                                    {32, -101, 0}, {45, -80, 0}, {60, -57, 0}, {76, -36, 0},  {90, -22, 0},
                                    {98, -14, 0},  {101, 2, 0},  {98, 18, 0},  {90, 26, 0},   {80, 25, 0},
                                    {72, 24, 0},   {66, 30, 0},  {50, 37, 0},  {30, 43, 0},   {16, 46, 0}};
constexpr std::size_t kOutlinePoints = 160;  // polygon with a sagitta below 0.05 mm

// The crest of the spine: u, v at the blade, height over the blade.
const std::vector<Vec3> kCrest = {{2, 1, 3}, {12, 3, 7}, {40, 7, 18}, {70, 12, 26}, {90, 15, 31}};
constexpr double kFinLean = 0.22;  // v per height: the spine leans cranially
constexpr double kFinHalfThickness = 1.7;

constexpr int kScapulaRelaxRounds = 3;

// The blade's middle surface over its plane: hollow towards the ribs, the superior angle bent forwards.
double bladeOffset(double u, double v) {
  const double dome =
      5.0 * (1.0 - elementary::square((u - 48.0) / 52.0)) * std::max(0.0, 1.0 - elementary::square((v + 30.0) / 95.0));
  return dome - 0.016 * elementary::square(std::max(0.0, v - 12.0));
}

// Length of the normal (-dn/du, -dn/dv, 1) of the middle surface: a height over it, divided by this, is a distance.
double bladeSteepness(double u, double v) {
  constexpr double kStep = 0.5;
  const double du = (bladeOffset(u + kStep, v) - bladeOffset(u - kStep, v)) / (2.0 * kStep);
  const double dv = (bladeOffset(u, v + kStep) - bladeOffset(u, v - kStep)) / (2.0 * kStep);
  return std::sqrt(1.0 + du * du + dv * dv);
}

Vec3 onBlade(double u, double v) { return {u, v, bladeOffset(u, v)}; }

// The crest's v and height over u, tabulated from its spline.
class CrestTable {
 public:
  CrestTable() {
    const std::vector<Vec3> fine = CubicSpline(kCrest).evenly(400);
    std::size_t next = 1;
    for (int i = 0; i <= kSteps; ++i) {
      const double u = mix(first(), last(), static_cast<double>(i) / kSteps);
      while (next + 1 < fine.size() && fine[next].x() < u) ++next;
      const double t = (u - fine[next - 1].x()) / (fine[next].x() - fine[next - 1].x());
      places_.push_back(fine[next - 1] + t * (fine[next] - fine[next - 1]));
    }
  }
  /// (u, v at the blade, height), u clamped to the crest's range.
  Vec3 at(double u) const {
    const double place = std::clamp((u - first()) / (last() - first()), 0.0, 1.0) * (kSteps - 1e-6);
    const auto i = static_cast<std::size_t>(place);
    return places_[i] + (place - static_cast<double>(i)) * (places_[i + 1] - places_[i]);
  }
  static double first() { return kCrest.front().x(); }
  static double last() { return kCrest.back().x(); }

 private:
  static constexpr int kSteps = 88;
  std::vector<Vec3> places_;
};

struct ScapulaParts {
  PlaneOutline outline{kOutline, kOutlinePoints, {{-20.0, -130.0}, 150, 190}};
  Tube medial_roll{{onBlade(9, 41), onBlade(3.5, 28), onBlade(2.2, 5), onBlade(3, -20), onBlade(5, -45),
                    onBlade(8, -72), onBlade(12, -95)},
                   {2.0, 2.2, 2.6, 2.6, 2.8, 3.1, 3.4},
                   12};
  Tube pillar{{onBlade(27, -104), onBlade(42, -80), onBlade(57, -57.5), onBlade(73, -36), onBlade(88, -19)},
              {4.2, 4.4, 4.8, 5.4, 6.0},
              8};
  EllipticCapsule neck{onBlade(80, 0), onBlade(100.5, 3), Vec3::UnitY(), {9.0, 4.5}, {16.5, 10.5}};
  CrestTable crest_table;
  Tube crest{crestPoints(), {2.6, 2.6, 3.2, 4.0, 4.4}, 12};
  FlatTube<PlateCapsule> acromion{acromionRings(), 4};
  FlatTube<EllipticCapsule> coracoid{{{{86, 24, 0}, Vec3::UnitX(), {8, 6}},
                                      {{92, 36, -10}, Vec3::UnitX(), {7, 5.6}},
                                      {{112, 30, -34}, Vec3::UnitY(), {6, 5}}},
                                     6};

  static std::vector<Vec3> crestPoints() {
    std::vector<Vec3> points;
    points.reserve(kCrest.size());
    for (const Vec3& c : kCrest)
      points.emplace_back(c.x(), c.y() + kFinLean * c.z(), bladeOffset(c.x(), c.y()) + c.z());
    return points;
  }

  // A flat plate that turns forwards around the head of the humerus; its wide side looks up and outwards.
  static std::vector<FlatRing> acromionRings() {
    const Vec3 wide = Vec3::UnitY();
    return {{{86, 20.5, 30}, wide, {5.0, 4.2}},
            {{102, 25.5, 31.5}, Vec3(0, 1, 0.2).normalized(), {7.0, 4.4}},
            {{113, 30, 26}, Vec3(-0.6, 0.8, 0.1).normalized(), {10.0, 4.4}},
            {{118.5, 34, 12}, Vec3(-1, 0.4, 0).normalized(), {12.0, 4.4}},
            {{116, 36.5, -4}, Vec3(-1, 0.25, 0).normalized(), {9.5, 4.2}}};
  }

  double bladeDistance(const Vec3& p) const {
    const double near_neck = std::clamp((p.x() - 60.0) / 30.0, 0.0, 1.0);
    const double half = 2.0 + 0.8 * near_neck;
    const double height = std::abs(p.z() - bladeOffset(p.x(), p.y()));
    const double slab = height / bladeSteepness(p.x(), p.y()) - half;
    return roundedIntersection(outline.distance({p.x(), p.y()}), slab, 0.95 * half);
  }

  double finDistance(const Vec3& p) const {
    const Vec3 crest_here = crest_table.at(p.x());
    const double height = p.z() - bladeOffset(p.x(), p.y());
    const double wall = std::abs(p.y() - kFinLean * height - crest_here.y()) - kFinHalfThickness;
    const double top = height - crest_here.z();
    const double end = std::max(CrestTable::first() - p.x(), p.x() - CrestTable::last());
    return std::max({wall, top, -height - 1.0, end});
  }

  double distance(const Vec3& p) const {
    double d = smoothUnion(bladeDistance(p), medial_roll.distance(p), 2.0);
    d = smoothUnion(d, pillar.distance(p), 6.0);
    d = smoothUnion(d, ellipsoidDistance(p - onBlade(21, -102), {9.0, 9.0, 4.2}), 7.0);
    d = smoothUnion(d, neck.distance(p), 9.0);
    d = smoothDifference(d, (p - Vec3(131.0, 3.0, 0.0)).norm() - 27.5, 1.5);  // the glenoid's hollow
    d = smoothUnion(d, std::min(finDistance(p), crest.distance(p)), 3.0);
    d = smoothUnion(d, acromion.distance(p), 4.0);
    return smoothUnion(d, coracoid.distance(p), 4.0);
  }
};

}  // namespace

Eigen::Isometry3d scapulaFrame(const ScapulaPlace& place) {
  const auto turn = [](double degrees, const Vec3& axis) { return rotationAbout(axis, radians(degrees)); };
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.translate(place.root);
  frame.rotate(turn(place.internal_deg, Vec3::UnitY()) * turn(place.upward_deg, Vec3::UnitZ()) *
               turn(-place.tilt_deg, Vec3::UnitX()));
  return frame;
}

mesh::TriangleMesh makeRightScapula(double cell_mm, const ScapulaPlace& place) {
  const MesherSettings box{.low = {-6.0, -122.0, -46.0}, .high = {140.0, 62.0, 44.0}, .cell_mm = cell_mm};
  return inFrame(scapulaFrame(place), relaxedSurface(ScapulaParts(), box, kScapulaRelaxRounds));
}

ScapulaPoints rightScapulaPoints(const ScapulaPlace& place) {
  const Eigen::Isometry3d frame = scapulaFrame(place);
  const auto raised = [&](double u, double v, double n) { return frame * Vec3(onBlade(u, v) + n * Vec3::UnitZ()); };
  return {raised(12, 43, 2.5), raised(2, 1.6, 5.6), raised(20, -106, 5.1), frame * Vec3(112, 31, 32)};
}

}  // namespace palpate::body
