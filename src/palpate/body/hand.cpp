// The right hand as smoothly joined tubes and ellipsoids (signed_distance.h), drawn as a surface (tetrahedra_mesher.h)
// and reduced (mesh/decimate.h); the left is its mirror image. Only drawn: no finger feels it.
//
// Own: all dimensions are our choice for a hand of 190 mm, wrist crease to middle finger, set by eye against
// photographs.
#include "palpate/body/hand.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/body/signed_distance.h"
#include "palpate/body/tetrahedra_mesher.h"
#include "palpate/mesh/decimate.h"

namespace palpate::body {
namespace {

constexpr double kTableLengthMm = 221.0;
constexpr double kWristCutY = -32.0;
constexpr double kCellMm = 2.2;
constexpr int kRelaxRounds = 4;
constexpr std::size_t kFewestHandTriangles = 200;
constexpr double kSkinFactor = 1.05;  // on the radii of the table, which are those of slim fingers
constexpr double kWaist = 0.955;      // a phalanx is a little thinner between its joints; 0.93 looks bony

struct FingerRow {
  Vec3 knuckle;
  std::array<double, 3> lengths;
  std::array<double, 4> radii;  // knuckle, middle joint, end joint, tip
  std::array<double, 3> flexion_deg;
  double abduction_deg;  // towards the little finger
};

const std::array<FingerRow, 4> kFingers = {{
    {{-27, 94, 1}, {46, 27, 17}, {10.6, 9.2, 8.0, 7.2}, {8, 6, 4}, -4},
    {{-5, 99, 3}, {51, 31, 18}, {10.9, 9.5, 8.2, 7.5}, {30, 38, 22}, 0},
    {{16, 94, 1}, {47, 29, 18}, {10.2, 8.9, 7.7, 7.0}, {36, 42, 25}, 5},
    {{34, 83, -3}, {37, 21, 16}, {9.0, 7.8, 6.8, 6.2}, {38, 40, 25}, 12},
}};
const std::array<Vec3, 4> kMetacarpalRoots = {Vec3(-15, 18, 2), Vec3(-4, 16, 4), Vec3(7, 16, 3), Vec3(17, 18, 0)};
const std::vector<Vec3> kThumb = {{-20, 20, -8}, {-44, 56, -14}, {-60, 86, -17}, {-70, 110, -18}};
const std::array<double, 4> kThumbRadii = {15.0, 11.8, 10.4, 8.8};

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

// The joints of a finger from knuckle to tip.
std::vector<Vec3> jointsOf(const FingerRow& finger) {
  std::vector<Vec3> joints{finger.knuckle};
  const double abduction = radians(finger.abduction_deg);
  double flexion = 0.0;
  for (std::size_t i = 0; i < finger.lengths.size(); ++i) {
    flexion += radians(finger.flexion_deg[i]);
    const Vec3 direction(std::sin(abduction) * std::cos(flexion), std::cos(abduction) * std::cos(flexion),
                         -std::sin(flexion));
    joints.push_back(joints.back() + finger.lengths[i] * direction);
  }
  return joints;
}

// A chain of capsules through the joints with a waist in every phalanx.
class Phalanges : public Chain<Capsule> {
 public:
  Phalanges(const std::vector<Vec3>& joints, const std::array<double, 4>& radii) {
    for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
      const double from = kSkinFactor * radii[i];
      const double to = kSkinFactor * radii[i + 1];
      const Vec3 middle = 0.5 * (joints[i] + joints[i + 1]);
      const double waist = kWaist * 0.5 * (from + to);
      pieces_.push_back({joints[i], middle, from, waist});
      pieces_.push_back({middle, joints[i + 1], waist, to});
    }
  }
};

// An ellipsoid turned about the dorsal axis.
struct Pad {
  Vec3 centre, radii;
  double turn_deg;

  double distance(const Vec3& p) const {
    return ellipsoidDistance(Eigen::AngleAxisd(-radians(turn_deg), Vec3::UnitZ()) * (p - centre), radii);
  }
};

struct Parts {
  std::vector<Phalanges> fingers;
  std::vector<EllipticCapsule> metacarpals;
  Phalanges thumb{kThumb, kThumbRadii};
  Pad palm{{2, 56, -2.5}, {36, 52, 14.5}, 0};
  Pad thenar{{-26, 40, -15}, {15, 30, 13}, 28};
  Pad hypothenar{{22, 36, -12}, {13, 34, 12}, -14};
  EllipticCapsule wrist{{0, -60, -1}, {0, 16, -2}, Vec3::UnitX(), {28.5, 20}, {25, 14}};

  Parts() {
    for (std::size_t i = 0; i < kFingers.size(); ++i) {
      fingers.emplace_back(jointsOf(kFingers[i]), kFingers[i].radii);
      metacarpals.emplace_back(kMetacarpalRoots[i], kFingers[i].knuckle, Vec3::UnitZ(), HalfAxes{10.5, 11.0},
                               HalfAxes{13.0, 12.0});
    }
  }

  double palmDistance(const Vec3& p) const {
    double d = palm.distance(p);
    for (const EllipticCapsule& metacarpal : metacarpals) d = smoothUnion(d, metacarpal.distance(p), 13.0);
    d = smoothUnion(d, thenar.distance(p), 13.0);
    d = smoothUnion(d, hypothenar.distance(p), 13.0);
    return smoothUnion(d, wrist.distance(p), 18.0);
  }

  double distance(const Vec3& p) const {
    double d = palmDistance(p);
    for (std::size_t i = 0; i < fingers.size(); ++i) {
      d = smoothUnion(d, (p - kFingers[i].knuckle).norm() - 0.8 * kFingers[i].radii[0] * kSkinFactor, 5.0);
    }
    d = smoothUnion(d, nearestDistance(fingers, p), 5.0);
    d = smoothUnion(d, thumb.distance(p), 9.0);
    return roundedIntersection(d, kWristCutY - p.y(), 3.0);
  }
};

mesh::TriangleMesh rightHand() {
  const Parts parts;
  const Field field = [&](const Vec3& p) { return parts.distance(p); };
  MesherSettings box;
  box.low = {-92.0, kWristCutY - 6.0, -92.0};
  box.high = {66.0, 204.0, 34.0};
  box.cell_mm = kCellMm;
  mesh::TriangleMesh mesh = meshZeroSurface(field, box);
  relaxOnSurface(mesh, field, kRelaxRounds);
  return mesh;
}

}  // namespace

mesh::TriangleMesh makeHand(const HandSettings& settings) {
  if (settings.triangles % 2 != 0) throw Error("a closed hand has an even number of triangles");
  if (settings.triangles < kFewestHandTriangles) throw Error("a hand needs at least 200 triangles");
  if (!(settings.length_mm >= 20.0 && settings.length_mm <= 1000.0)) {
    throw Error("the length of a hand must lie between 20 and 1000 mm");
  }
  mesh::TriangleMesh hand = rightHand();
  if (hand.triangles.size() < settings.triangles) {
    throw Error("a hand has at most " + std::to_string(hand.triangles.size()) + " triangles");
  }
  hand = mesh::decimate(std::move(hand), settings.triangles);
  for (Vec3& p : hand.positions) p *= settings.length_mm / kTableLengthMm;
  return settings.side == Side::right ? hand : mirrored(std::move(hand));
}

Vec3 indexTip(const HandSettings& settings) {
  const std::vector<Vec3> joints = jointsOf(kFingers[0]);
  const Vec3 along = (joints[3] - joints[2]).normalized();
  Vec3 tip = joints[3] + kSkinFactor * kFingers[0].radii[3] * along;
  if (settings.side == Side::left) tip.x() = -tip.x();
  return settings.length_mm / kTableLengthMm * tip;
}

}  // namespace palpate::body
