// The right hip bone: the ilium is a bent plate cut by an outline, with a roll along its crest; acetabulum, ischium and
// pubis are balls and tubes around the obturator foramen, joined smoothly. At the sacrum it leaves the width of a
// joint.
//
// Guided by: breadth over the crests 280 of men, over the anterior superior spines 240, between the posterior ones
// 90-100, hip bone 210-220 high, acetabulum 50-54 wide, [R] recalled textbook values; crest level with the spinous
// process of L4 on images [A] (meta-analysis 2017, 47 papers), posterior spine with that of S2 in 81 % of 100 CT
// (McGaugh 2007, Clin Anat 20:819) [A]; centre of the hip 0.36 of the breadth over the spines lateral, 0.19 behind and
// 0.30 below the spine (Bell 1990, J Biomech 23:617) [R]. The skin of this body is narrow at the hips: the crests are
// 266 apart here, our choice. All coordinates are construction values of our choice.
#include <array>
#include <cmath>
#include <vector>

#include "palpate/base/dense_solve.h"
#include "palpate/base/elementary.h"
#include "palpate/body/plane_outline.h"
#include "palpate/body/signed_distance.h"
#include "palpate/body/skeleton/skeleton_shapes.h"
#include "palpate/body/tetrahedra_mesher.h"

namespace palpate::body {
namespace {

constexpr double kSacroiliacGap = 0.9;  // mm, half of what is left of the joint's cartilage
constexpr double kSymphysisHalf = 2.2;  // mm, half of the disc between the pubic bones
constexpr double kAcetabulumRadius = 26.0;

// The edge of the ilium, from the anterior superior spine back over the crest and round below; body frame.
const std::vector<Vec3> kRim = {{117, -314, -54},  {122.5, -289, -42}, {126.5, -264, -25}, {123, -250, -1},
                                {113, -240.5, 22}, {98, -239, 42},     {80, -249, 57},     {64, -270, 71},
                                {49, -300, 90},    {43, -320, 92},     {43, -337, 86},     {53, -347, 68},
                                {64, -350, 48},    {72, -368, 33},     {80, -392, 14},     {86, -400, -10},
                                {85, -388, -34},   {97, -352, -45},    {109, -333, -47}};
constexpr std::size_t kCrestFirst = 0;
constexpr std::size_t kCrestLast = 9;
// Inside the rim: along the joint with the sacrum, and the hollow of the iliac fossa.
const std::vector<Vec3> kInner = {{63, -291, 34}, {61, -301, 48}, {57, -311, 63},
                                  {52, -322, 79}, {101, -288, 4}, {72, -345, 14}};

const Vec3 kHipCentre{86.0, -383.0, -10.0};
const Vec3 kHipAxis = Vec3(0.80, -0.45, -0.40).normalized();  // out of the socket
const Vec3 kTuberosity{62.0, -433.0, 27.0};
const Vec3 kPubicTubercle{27.0, -392.0, -67.0};

// u forwards and outwards, v up, n out of the outer face.
Eigen::Isometry3d wingFrame() {
  const Vec3 forwards = Vec3(0.42, 0.0, -0.9075).normalized();
  const Vec3 up = Vec3(0.367, 0.915, 0.17).normalized();
  const Vec3 outwards = forwards.cross(up).normalized();
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear() << forwards, outwards.cross(forwards), outwards;
  frame.translation() = Vec3(96.0, -320.0, 0.0);
  return frame;
}

std::vector<Vec3> inWing(const std::vector<Vec3>& points) {
  const Eigen::Isometry3d inverse = wingFrame().inverse();
  std::vector<Vec3> local;
  local.reserve(points.size());
  for (const Vec3& p : points) local.push_back(inverse * p);
  return local;
}

// The smoothest height over (u, v) through the points (a thin plate that is bent), tabulated.
class BentPlate {
 public:
  explicit BentPlate(const std::vector<Vec3>& points) : points_(points) {
    const auto n = static_cast<Eigen::Index>(points.size());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n + 3, n + 3);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n + 3);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Vec3& p = points[static_cast<std::size_t>(i)];
      for (Eigen::Index j = 0; j < n; ++j) matrix(i, j) = bend(p, points[static_cast<std::size_t>(j)]);
      matrix(i, i) += kSlack;
      matrix.row(i).tail(3) << 1.0, p.x(), p.y();
      matrix.col(i).tail(3) << 1.0, p.x(), p.y();
      right[i] = p.z();
    }
    weights_ = solved(std::move(matrix), right);
    for (int j = 0; j < kRows; ++j) {
      for (int i = 0; i < kColumns; ++i) table_.push_back(exact(kLow + kStepMm * Vec2(i, j)));
    }
  }

  double height(double u, double v) const {
    const Vec2 q = ((Vec2(u, v) - kLow) / kStepMm).cwiseMax(0.0).cwiseMin(Vec2(kColumns - 1.001, kRows - 1.001));
    const auto i = static_cast<std::size_t>(q.x());
    const auto j = static_cast<std::size_t>(q.y());
    const double* cell = &table_[j * kColumns + i];
    const double s = q.x() - static_cast<double>(i);
    return mix(mix(cell[0], cell[1], s), mix(cell[kColumns], cell[kColumns + 1], s), q.y() - static_cast<double>(j));
  }
  double steepness(double u, double v) const {
    const double du = (height(u + kStepMm, v) - height(u - kStepMm, v)) / (2.0 * kStepMm);
    const double dv = (height(u, v + kStepMm) - height(u, v - kStepMm)) / (2.0 * kStepMm);
    return std::sqrt(1.0 + du * du + dv * dv);
  }

 private:
  static constexpr int kColumns = 110;
  static constexpr int kRows = 110;
  static constexpr double kStepMm = 2.0;
  static constexpr double kSlack = 200.0;  // mm^2: lets the plate pass points by a little and stay smooth
  inline static const Vec2 kLow{-125.0, -105.0};

  static double bend(const Vec3& a, const Vec3& b) {
    const double r2 = (a - b).head<2>().squaredNorm();
    return r2 > 0.0 ? r2 * elementary::log(r2) : 0.0;
  }
  double exact(const Vec2& p) const {
    const auto n = static_cast<Eigen::Index>(points_.size());
    double z = weights_[n] + weights_[n + 1] * p.x() + weights_[n + 2] * p.y();
    for (Eigen::Index i = 0; i < n; ++i) {
      z += weights_[i] * bend(Vec3(p.x(), p.y(), 0.0), points_[static_cast<std::size_t>(i)]);
    }
    return z;
  }

  std::vector<Vec3> points_;
  Eigen::VectorXd weights_;
  std::vector<double> table_;
};

std::vector<Vec3> joined(std::vector<Vec3> a, const std::vector<Vec3>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

struct HipParts {
  Eigen::Isometry3d into_wing = wingFrame().inverse();
  PlaneOutline outline{inWing(kRim), 140, {{-125.0, -105.0}, 110, 110, 2.0}};
  BentPlate plate{joined(inWing(kRim), inWing(kInner))};
  Tube crest{{kRim.begin() + kCrestFirst, kRim.begin() + kCrestLast + 1}, {6.2, 5.0, 7.0, 5.4, 4.8, 5.0, 5.8, 6.5}, 22};
  Tube brim{{{60, -318, 40}, {64, -338, 24}, {70, -356, 2}, {68, -372, -26}, {52, -382, -50}, {30, -391, -64}},
            {6.5, 7.5, 10.0, 9.5, 7.5, 6.5},
            14};
  Capsule front_edge{{97, -354, -43}, {86, -374, -30}, 7.0, 11.0};  // the anterior inferior spine
  Capsule back_edge{{44, -318, 91}, {47, -336, 84}, 6.0, 4.5};      // between the posterior spines
  Capsule sciatic{{68, -352, 42}, {74, -385, 24}, 6.0, 11.0};       // behind the socket
  Capsule ischium{{78, -398, 12}, {66, -430, 24}, 14.0, 12.0};
  Capsule ischial_spine{{66, -391, 30}, {49, -399, 42}, 7.0, 2.8};
  Tube ramus{{{60, -442, 16}, {46, -441, -8}, {30, -434, -30}, {14, -425, -48}}, {8.0, 6.2, 5.6, 6.4}, 10};
  PlateCapsule pubis{{16, -399, -63}, {10, -424, -51}, Vec3::UnitX(), {12.0, 6.2}};
  Capsule tubercle{kPubicTubercle, {16, -393, -65}, 4.6, 5.5};

  double wingDistance(const Vec3& p) const {
    const Vec3 q = into_wing * p;
    const double rim = outline.distance({q.x(), q.y()});
    // Thin in the fossa, thick behind at the joint with the sacrum and towards the socket.
    const double behind = std::clamp((-q.x() - 40.0) / 40.0, 0.0, 1.0);
    const double below = std::clamp((-q.y() - 5.0) / 35.0, 0.0, 1.0);
    const double half = 2.4 + 4.0 * behind + 4.0 * below;
    const double slab = std::abs(q.z() - plate.height(q.x(), q.y())) / plate.steepness(q.x(), q.y()) - half;
    return roundedIntersection(rim, slab, 2.2);
  }

  double distance(const Vec3& p) const {
    double d = smoothUnion(wingDistance(p), crest.distance(p), 5.0);
    d = smoothUnion(d, back_edge.distance(p), 5.0);
    d = smoothUnion(d, brim.distance(p), 8.0);
    d = smoothUnion(d, front_edge.distance(p), 8.0);
    d = smoothUnion(d, sciatic.distance(p), 10.0);
    d = smoothUnion(d, (p - kHipCentre + 6.0 * kHipAxis).norm() - 34.0, 8.0);
    d = smoothUnion(d, ischium.distance(p), 9.0);
    d = smoothUnion(d, ischial_spine.distance(p), 6.0);
    d = smoothUnion(d, ellipsoidDistance(p - kTuberosity, {13.0, 20.0, 14.0}), 7.0);
    d = smoothUnion(d, std::min(ramus.distance(p), pubis.distance(p)), 6.0);
    d = smoothUnion(d, tubercle.distance(p), 4.0);
    const double socket = (p - kHipCentre).norm() - kAcetabulumRadius;
    const double beyond_rim = 11.0 - (p - kHipCentre).dot(kHipAxis);  // the lip of the socket
    d = smoothDifference(d, std::min(socket, std::max(beyond_rim, (p - kHipCentre).norm() - 46.0)), 3.0);
    d = roundedIntersection(d, kSymphysisHalf - p.x(), 2.5);
    return smoothDifference(d, sacrumDistance(p) - kSacroiliacGap, 1.5);
  }
};

}  // namespace

mesh::TriangleMesh makeRightHip(double cell_mm) {
  const MesherSettings box{.low = {-2.0, -470.0, -84.0}, .high = {146.0, -226.0, 112.0}, .cell_mm = cell_mm};
  return relaxedSurface(HipParts(), box, kSkeletonRelaxRounds);
}

HipPoints rightHipPoints() {
  return {kRim[0] + Vec3(1.5, 0.0, -6.0), kRim[8] + Vec3(0.0, 0.0, 6.0), kRim[5] + Vec3(0.0, 5.0, 0.0),
          kTuberosity + Vec3(0.0, -18.2, 5.0), kPubicTubercle + Vec3(1.0, 0.0, -4.6)};
}

}  // namespace palpate::body
