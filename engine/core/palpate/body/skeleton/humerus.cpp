// The upper end of the humerus: a ball at the scapula's socket, the two tubercles with their groove, and the shaft
// within the stump of the arm, which hangs outwards as the skin's arms do.
//
// Guided by: diameter of the head 46-48 of men, shaft 22-24, retroversion 20-30 degrees, [R] recalled textbook values.
// The direction of the shaft (41 degrees off the vertical) follows the arm of the skin; the rest is our choice.
#include <cmath>

#include "palpate/body/signed_distance.h"
#include "palpate/body/skeleton/skeleton_shapes.h"
#include "palpate/body/tetrahedra_mesher.h"

namespace palpate::body {
namespace {

constexpr double kHeadRadius = 23.5;  // mm
constexpr double kShaftEnd = 78.0;    // mm beyond the head's centre: the stump of the skin ends at about 109
// In the scapula's frame: in front of the hollow of the socket (a ball of 27.5 mm about (131, 3, 0)).
const Vec3 kHeadInScapula{129.5, 3.0, 0.0};

// Frame of the humerus: origin at the head's centre, x away from the socket, y up along the shaft, z to the back.
Eigen::Isometry3d humerusFrame() {
  const Vec3 up = Vec3(-0.665, 0.745, 0.02).normalized();
  const Vec3 into_head = Vec3(-0.70, 0.35, 0.45);  // towards the socket: medially, up and back
  const Vec3 medial = (into_head - into_head.dot(up) * up).normalized();
  Eigen::Isometry3d placed = Eigen::Isometry3d::Identity();
  placed.linear() << -medial, up, (-medial).cross(up);
  placed.translation() = rightHumeralHead();
  return placed;
}

struct HumerusParts {
  Capsule shaft{{10, -22, 0}, {11, -kShaftEnd, 0}, 14.5, 11.2};
  Capsule neck{{1, -2, 0}, {10, -26, 0}, 20.0, 14.5};
  double distance(const Vec3& p) const {
    double d = p.norm() - kHeadRadius;
    d = smoothUnion(d, neck.distance(p), 4.0);
    d = smoothUnion(d, ellipsoidDistance(p - Vec3(15.0, -3.0, 4.0), {11.5, 19.0, 15.0}), 6.0);  // greater tubercle
    d = smoothUnion(d, ellipsoidDistance(p - Vec3(8.0, -9.0, -15.5), {8.5, 13.0, 8.5}), 5.0);   // lesser tubercle
    d = smoothUnion(d, shaft.distance(p), 9.0);
    const Capsule groove{{19.5, 14.0, -13.0}, {18.5, -46.0, -12.5}, 4.2, 3.2};
    return smoothDifference(d, groove.distance(p), 3.5);
  }
};

}  // namespace

Vec3 rightAcromionTip() { return scapulaFrame(trunkScapulaPlace()) * Vec3(129.2, 29.7, 12.0); }

Vec3 rightHumeralHead() { return scapulaFrame(trunkScapulaPlace()) * kHeadInScapula; }

mesh::TriangleMesh makeRightHumerus(double cell_mm) {
  const MesherSettings box{.low = {-30.0, -kShaftEnd - 18.0, -32.0}, .high = {36.0, 30.0, 34.0}, .cell_mm = cell_mm};
  return inFrame(humerusFrame(), relaxedSurface(HumerusParts(), box, kSkeletonRelaxRounds));
}

Vec3 rightGreaterTubercle() { return humerusFrame() * Vec3(26.5, -3.0, 4.0); }

}  // namespace palpate::body
