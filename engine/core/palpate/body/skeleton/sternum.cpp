// The sternum: a plate in the midline whose outline (manubrium, body, xiphoid), depth and height follow tables over y;
// notches for the throat, the clavicles and the first seven costal cartilages are cut out.
//
// Guided by: manubrium about 50 long, body 95-110, both 150-170 of men, 8-12 thick, manubrium 50-65 wide, body 25-40:
// [R] recalled textbook values. The jugular notch is level with T2-T3, the sternal angle with T4-T5, the joint of the
#include <algorithm>
#include <cmath>

#include "palpate/base/elementary.h"
#include "palpate/body/plane_outline.h"
#include "palpate/body/signed_distance.h"
#include "palpate/body/skeleton/skeleton_shapes.h"
#include "palpate/body/tetrahedra_mesher.h"

namespace palpate::body {
namespace {

// The right edge from the throat down to the xiphoid; x, y.
const std::vector<Vec3> kSternumEdge = {{9, 140, 0},   {19, 141, 0},  {28, 134, 0}, {29, 124, 0}, {24, 112, 0},
                                        {18, 100, 0},  {16.5, 92, 0}, {15, 80, 0},  {16, 60, 0},  {18, 40, 0},
                                        {19.5, 22, 0}, {18.5, 8, 0},  {13, -4, 0},  {8, -10, 0},  {6, -20, 0},
                                        {4.5, -32, 0}, {1.5, -39, 0}};

// The middle of the plate and its half thickness over y.
struct SternumDepth {
  double y, z, half;
};
constexpr std::array<SternumDepth, 8> kDepths = {{{146, -28.0, 5.2},
                                                  {122, -35.2, 5.6},
                                                  {96, -52.5, 5.0},
                                                  {70, -65.5, 4.6},
                                                  {40, -78.5, 4.6},
                                                  {5, -85.5, 4.4},
                                                  {-20, -89.0, 3.2},
                                                  {-45, -92.0, 2.6}}};

SternumDepth sternumDepthAt(double y) {
  const auto next =
      std::find_if(kDepths.begin() + 1, kDepths.end() - 1, [&](const SternumDepth& d) { return d.y < y; });
  const SternumDepth& before = *(next - 1);
  const double t = std::clamp((y - before.y) / (next->y - before.y), -0.5, 1.5);
  return {y, mix(before.z, next->z, t), mix(before.half, next->half, std::clamp(t, 0.0, 1.0))};
}

constexpr double kSideDrop = 0.010;  // per mm: the plate's sides are a little deeper than its middle, (0.010 x) x

// Height of the notches of cartilages 1 to 7.
constexpr std::array<double, 7> kNotchY = {111, 94, 69, 47, 27, 11, -3};
constexpr double kNotchRadius = 5.0;
constexpr double kNotchDepth = 1.2;

double edgeAt(double y) {
  for (std::size_t i = 3; i + 1 < kSternumEdge.size(); ++i) {
    if (kSternumEdge[i + 1].y() <= y) {
      const double t = (y - kSternumEdge[i].y()) / (kSternumEdge[i + 1].y() - kSternumEdge[i].y());
      return mix(kSternumEdge[i].x(), kSternumEdge[i + 1].x(), t);
    }
  }
  return kSternumEdge.back().x();
}

double middleZ(double x, double y) { return sternumDepthAt(y).z + kSideDrop * x * x; }

std::vector<Vec3> wholeOutline() {
  std::vector<Vec3> points = kSternumEdge;
  for (std::size_t i = kSternumEdge.size(); i-- > 0;)
    points.emplace_back(-kSternumEdge[i].x(), kSternumEdge[i].y(), 0.0);
  return points;
}

struct SternumParts {
  PlaneOutline outline{wholeOutline(), 160, {{-4.0, -56.0}, 45, 212}};
  Ball socket = sternoclavicularSocket();

  double distance(const Vec3& p) const {
    const SternumDepth depth = sternumDepthAt(p.y());
    // Steepest at the manubrium: 0.55 along y.
    const double slab = 0.88 * (std::abs(p.z() - middleZ(p.x(), p.y())) - depth.half);
    double d = roundedIntersection(outline.distance({p.x(), p.y()}), slab, std::min(3.4, 0.8 * depth.half));
    // The ridge of the sternal angle.
    d = smoothUnion(d, Capsule{{0, 96, -52.2}, {13, 96, -50.8}, 5.0, 4.2}.distance(p), 3.0);
    for (int number = 1; number <= 7; ++number) {
      const Vec3 middle = sternalNotch(number) + Vec3(kNotchRadius - kNotchDepth, 0.0, 0.0);
      d = smoothDifference(d, elementary::hypot(p.x() - middle.x(), p.y() - middle.y()) - kNotchRadius, 2.0);
    }
    d = smoothDifference(d, elementary::hypot(p.x(), p.y() - 150.0) - 13.0, 2.5);
    return smoothDifference(d, (p - socket.centre).norm() - socket.radius, 1.5);
  }
};

}  // namespace

Vec3 sternalNotch(int number) {
  const double y = kNotchY[static_cast<std::size_t>(number - 1)];
  const double x = edgeAt(y);
  return {x, y, middleZ(x, y)};
}

mesh::TriangleMesh makeSternumHalf(double cell_mm) {
  const MesherSettings box{.low = {0.0, -46.0, -104.0}, .high = {36.0, 150.0, -14.0}, .cell_mm = cell_mm};
  return relaxedSurface(SternumParts(), box, kSkeletonRelaxRounds);
}

SternumPoints sternumPoints() {
  const auto front = [](double y) { return Vec3(0.0, y, sternumDepthAt(y).z - sternumDepthAt(y).half); };
  return {{0.0, 137.0, sternumDepthAt(137.0).z}, front(96.0) + Vec3(0.0, 0.0, -0.6), front(-38.0)};
}

}  // namespace palpate::body
