// The right hand as smoothly joined tubes and ellipsoids (signed_distance.h), drawn as a surface (tetrahedra_mesher.h)
// and reduced (mesh/decimate.h); the left is its mirror image. Only drawn: no finger feels it.
//
// Own: all dimensions are our choice for a hand of 190 mm, wrist crease to middle finger, set by eye against
// photographs.
#include "palpate/body/hand.h"

#include <array>
#include <numbers>
#include <utility>

#include "palpate/base/elementary.h"
#include "palpate/base/error.h"
#include "palpate/body/rotation.h"
#include "palpate/body/signed_distance.h"
#include "palpate/body/tetrahedra_mesher.h"
#include "palpate/mesh/decimate.h"

namespace palpate::body {
namespace {

constexpr double kTableLengthMm = 221.0;
constexpr double kWristCutY = -32.0;
constexpr double kCellMm = 2.2;
constexpr int kHandRelaxRounds = 4;
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

Vec3 mix3(const Vec3& from, const Vec3& to, double t) { return from + t * (to - from); }

// The joints of a finger from knuckle to tip.
std::vector<Vec3> jointsOf(const FingerRow& finger) {
  std::vector<Vec3> joints{finger.knuckle};
  const double abduction = radians(finger.abduction_deg);
  double flexion = 0.0;
  for (std::size_t i = 0; i < finger.lengths.size(); ++i) {
    flexion += radians(finger.flexion_deg[i]);
    const Vec3 direction(elementary::sin(abduction) * elementary::cos(flexion),
                         elementary::cos(abduction) * elementary::cos(flexion), -elementary::sin(flexion));
    joints.push_back(joints.back() + finger.lengths[i] * direction);
  }
  return joints;
}

// A chain of capsules through the joints with a waist in every phalanx.
class Phalanges : public UnionOfPieces<Capsule> {
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
    return ellipsoidDistance(rotationAbout(Vec3::UnitZ(), -radians(turn_deg)) * (p - centre), radii);
  }
};

// A palm and its four fingers.
struct Palm {
  Pad middle, thenar, hypothenar;
  std::vector<EllipticCapsule> metacarpals;
  std::vector<Phalanges> fingers;

  Palm(const std::array<Pad, 3>& pads, const std::array<FingerRow, 4>& rows, HalfAxes root, HalfAxes knuckle)
      : middle(pads[0]), thenar(pads[1]), hypothenar(pads[2]) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      metacarpals.emplace_back(kMetacarpalRoots[i], rows[i].knuckle, Vec3::UnitZ(), root, knuckle);
      fingers.emplace_back(jointsOf(rows[i]), rows[i].radii);
    }
  }

  // Without the fingers.
  double distance(const Vec3& p) const {
    double d = middle.distance(p);
    for (const EllipticCapsule& metacarpal : metacarpals) d = smoothUnion(d, metacarpal.distance(p), 13.0);
    d = smoothUnion(d, thenar.distance(p), 13.0);
    return smoothUnion(d, hypothenar.distance(p), 13.0);
  }
};

struct HandParts {
  Palm palm{
      {{{{2, 56, -2.5}, {36, 52, 14.5}, 0}, {{-26, 40, -15}, {15, 30, 13}, 28}, {{22, 36, -12}, {13, 34, 12}, -14}}},
      kFingers,
      {10.5, 11.0},
      {13.0, 12.0}};
  Phalanges thumb{kThumb, kThumbRadii};
  EllipticCapsule wrist{{0, -60, -1}, {0, 16, -2}, Vec3::UnitX(), {28.5, 20}, {25, 14}};

  double distance(const Vec3& p) const {
    double d = smoothUnion(palm.distance(p), wrist.distance(p), 18.0);
    for (const FingerRow& finger : kFingers) {
      d = smoothUnion(d, (p - finger.knuckle).norm() - 0.8 * finger.radii[0] * kSkinFactor, 5.0);
    }
    d = smoothUnion(d, nearestDistance(palm.fingers, p), 5.0);
    d = smoothUnion(d, thumb.distance(p), 9.0);
    return roundedIntersection(d, kWristCutY - p.y(), 3.0);
  }
};

mesh::TriangleMesh rightHand() {
  const MesherSettings box{.low = {-92.0, kWristCutY - 6.0, -92.0}, .high = {66.0, 204.0, 34.0}, .cell_mm = kCellMm};
  return relaxedSurface(HandParts(), box, kHandRelaxRounds);
}

// ---- the hand that palpates

constexpr double kPalpatingCellMm = 2.4;
constexpr std::size_t kPalpatingTriangles = 10000;
constexpr double kForearmMm = 260.0;
constexpr double kWristBackDeg = 20.0;

/// The index finger is bent enough that its pad, not its end, meets skin parallel to the palm.
const std::array<FingerRow, 4> kPalpatingFingers = {{
    {{-27, 94, 1}, {46, 27, 18}, {10.4, 9.1, 7.9, 6.9}, {13, 14, 4}, -3},
    {{-5, 99, 3}, {51, 31, 19}, {10.7, 9.4, 8.1, 7.1}, {-7, 20, 11}, 0},
    {{16, 94, 1}, {47, 29, 19}, {10.0, 8.8, 7.6, 6.7}, {-8, 24, 13}, 5},
    {{34, 83, -3}, {37, 21, 17}, {8.9, 7.7, 6.6, 5.8}, {-10, 24, 12}, 13},
}};
const std::vector<Vec3> kPalpatingThumb = {{-19, 18, -9}, {-41, 52, -17}, {-52, 82, -22}, {-54, 109, -24}};
const std::array<double, 4> kPalpatingThumbRadii = {14.5, 11.6, 10.2, 8.4};
/// Out of the thumb's nail.
const Vec3 kThumbBack(-0.85, 0.0, 0.53);

Vec3 forearmDirection() {
  const double back = radians(kWristBackDeg);
  return {0.0, -elementary::cos(back), elementary::sin(back)};
}

/// The last joint of a finger.
struct FingerEnd {
  Vec3 joint, tip;
  Vec3 back;  // unit, out of its nail
  double radius;
  Vec3 along() const { return (tip - joint).normalized(); }
};

FingerEnd makeFingerEnd(const std::vector<Vec3>& joints, const Vec3& back, double radius) {
  FingerEnd end{joints[joints.size() - 2], joints.back(), {}, kSkinFactor * radius};
  end.back = (back - back.dot(end.along()) * end.along()).normalized();
  return end;
}

std::vector<FingerEnd> fingerEnds() {
  std::vector<FingerEnd> ends = {makeFingerEnd(kPalpatingThumb, kThumbBack, kPalpatingThumbRadii[3])};
  for (const FingerRow& finger : kPalpatingFingers) {
    ends.push_back(makeFingerEnd(jointsOf(finger), Vec3::UnitZ(), finger.radii[3]));
  }
  return ends;
}

/// The flesh under the last joint, which makes a pad of a tube's end.
EllipticCapsule makePulp(const FingerEnd& end) {
  const Vec3 sunk = -0.22 * end.radius * end.back;
  const HalfAxes axes{0.98 * end.radius, 0.95 * end.radius};
  return {mix3(end.joint, end.tip, 0.45) + sunk, mix3(end.joint, end.tip, 0.95) + sunk, end.back.cross(end.along()),
          axes};
}

Nail makeNail(const FingerEnd& end) {
  Nail nail;
  nail.centre = end.tip - 0.5 * end.along() + 0.80 * end.radius * end.back;
  nail.along = 0.90 * end.radius * end.along();
  nail.across = 0.74 * end.radius * end.along().cross(end.back);
  nail.up = 0.6 * end.radius * end.back;
  return nail;
}

struct PalpatingParts {
  Palm palm{
      {{{{2, 56, -3}, {35, 50, 13.5}, 0}, {{-25, 38, -15}, {14, 29, 12.5}, 24}, {{22, 36, -12}, {13, 34, 12}, -14}}},
      kPalpatingFingers,
      {10.0, 10.5},
      {12.4, 11.5}};
  std::vector<EllipticCapsule> pulps;
  std::vector<Capsule> tendons;
  Phalanges thumb{kPalpatingThumb, kPalpatingThumbRadii};
  std::vector<EllipticCapsule> forearm;
  Vec3 end = kForearmMm * forearmDirection();

  PalpatingParts() {
    for (const FingerRow& finger : kPalpatingFingers) {
      tendons.push_back({Vec3(0.3 * finger.knuckle.x(), 8.0, 13.0), finger.knuckle + Vec3(0, -6, 8.5), 2.6, 3.4});
    }
    for (const FingerEnd& finger_end : fingerEnds()) pulps.push_back(makePulp(finger_end));
    addForearm();
  }

  void addForearm() {
    const Vec3 axis = forearmDirection();
    const auto ring = [](double wide, double thick) { return HalfAxes{wide, thick}; };
    forearm.emplace_back(Vec3(0, 17, -2), 26.0 * axis, Vec3::UnitX(), ring(24.5, 14), ring(27.5, 18.5));
    forearm.emplace_back(26.0 * axis, 120.0 * axis, Vec3::UnitX(), ring(27.5, 18.5), ring(36, 31));
    forearm.emplace_back(120.0 * axis, 300.0 * axis, Vec3::UnitX(), ring(36, 31), ring(46, 43));
  }

  double handDistance(const Vec3& p) const {
    double d = palm.distance(p);
    for (const EllipticCapsule& part : forearm) d = smoothUnion(d, part.distance(p), 16.0);
    // The head of the ulna, on the little finger's side of the back of the wrist.
    d = smoothUnion(d, (p - Vec3(19, -22, 15)).norm() - 9.0, 9.0);
    return smoothUnion(d, nearestDistance(tendons, p), 6.0);
  }

  double fingerDistance(const Vec3& p) const {
    double d = nearestDistance(palm.fingers, p);
    for (const EllipticCapsule& pulp : pulps) d = smoothUnion(d, pulp.distance(p), 3.0);
    return d;
  }

  double distance(const Vec3& p) const {
    double d = handDistance(p);
    for (const FingerRow& finger : kPalpatingFingers) {
      d = smoothUnion(d, (p - finger.knuckle - Vec3(0, 0, 1.0)).norm() - 0.84 * finger.radii[0] * kSkinFactor, 5.0);
    }
    d = smoothUnion(d, fingerDistance(p), 6.0);
    d = smoothUnion(d, thumb.distance(p), 9.0);
    return roundedIntersection(d, (p - end).dot(forearmDirection()), 3.0);
  }
};

mesh::TriangleMesh palpatingShape() {
  const MesherSettings box{.low = {-72.0, -270.0, -72.0}, .high = {72.0, 204.0, 146.0}, .cell_mm = kPalpatingCellMm};
  return mesh::decimate(relaxedSurface(PalpatingParts(), box, kHandRelaxRounds), kPalpatingTriangles);
}

/// Places where skin is redder, and how far that reaches.
struct RedPlace {
  Vec3 place;
  double reach_mm;
};

std::vector<RedPlace> redPlaces() {
  std::vector<RedPlace> places;
  for (const FingerRow& finger : kPalpatingFingers) {
    const std::vector<Vec3> joints = jointsOf(finger);
    places.push_back({joints[0] + Vec3(0, 0, 9.0), 13.0});
    for (const std::size_t joint : {1u, 2u}) places.push_back({joints[joint] + Vec3(0, 0, 8.0), 10.0});
    places.push_back({joints[3], 15.0});
  }
  places.push_back({kPalpatingThumb[2] + 9.0 * kThumbBack, 11.0});
  places.push_back({kPalpatingThumb[3], 16.0});
  return places;
}

float rednessAt(const std::vector<RedPlace>& places, const Vec3& p) {
  double redness = p.z() < -8.0 && p.y() > 0.0 ? 0.35 : 0.0;  // the palm
  for (const RedPlace& red : places) {
    const double away = (p - red.place).squaredNorm() / (red.reach_mm * red.reach_mm);
    redness = std::max(redness, elementary::exp(-1.5 * away));
  }
  return static_cast<float>(redness);
}

PalpatingHand rightPalpatingHand() {
  PalpatingHand hand;
  hand.mesh = palpatingShape();
  const std::vector<RedPlace> red = redPlaces();
  for (const Vec3& p : hand.mesh.positions) hand.redness.push_back(rednessAt(red, p));
  const std::vector<FingerEnd> ends = fingerEnds();
  for (std::size_t i = 0; i < hand.nails.size(); ++i) hand.nails[i] = makeNail(ends[i]);
  const FingerEnd& index = ends[1];
  hand.pad = mix3(index.joint, index.tip, 0.8) - 0.3 * index.radius * index.back;
  hand.pad_along = index.along();
  hand.forearm = forearmDirection();
  hand.forearm_mm = kForearmMm;
  return hand;
}

PalpatingHand mirroredHand(PalpatingHand hand) {
  hand.mesh = mirrored(std::move(hand.mesh));
  for (Nail& nail : hand.nails) {
    nail = {mirrored(nail.centre), mirrored(nail.along), mirrored(nail.across), mirrored(nail.up)};
  }
  hand.pad = mirrored(hand.pad);
  hand.pad_along = mirrored(hand.pad_along);
  return hand;
}

}  // namespace

PalpatingHand makePalpatingHand(Side side) {
  PalpatingHand hand = rightPalpatingHand();
  return side == Side::right ? hand : mirroredHand(std::move(hand));
}

mesh::TriangleMesh makeHand(const HandSettings& settings) {
  if (settings.triangles % 2 != 0) throw Error("hand: the number of triangles must be even (closed surface)");
  if (settings.triangles < kFewestHandTriangles) throw Error("hand: the number of triangles must be at least 200");
  if (!(settings.length_mm >= 20.0 && settings.length_mm <= 1000.0)) {
    throw Error("hand: the length must be 20 to 1000 mm");
  }
  mesh::TriangleMesh hand = rightHand();
  if (hand.triangles.size() < settings.triangles) {
    throw Error("a hand can have at most " + std::to_string(hand.triangles.size()) + " triangles");
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
