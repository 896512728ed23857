// The clavicle: an ellipse swept along an S from the manubrium to the acromion. Thick at the sternum, round in the
// shaft, flat at the acromion; convex forwards in its medial two thirds, backwards in the lateral one.
//
// Guided by: length 145-150 of men, shaft 11-13 thick, sternal end about 22-25, acromial end 20-25 wide and 10-12
// high, [R] recalled textbook values. The course under the skin, 5 mm and more, is our choice.
#include <cmath>

#include "palpate/base/elementary.h"
#include "palpate/body/signed_distance.h"
#include "palpate/body/skeleton/skeleton_shapes.h"

namespace palpate::body {
namespace {

const std::vector<Vec3> kClavicleLine = {{29, 143, -22}, {44, 146, -18}, {66, 147.8, -8}, {90, 148, 6},
                                         {112, 149, 19}, {132, 147, 26}, {152, 144, 24}};

// Half height and half thickness (front to back) at even shares of the length.
constexpr std::array<HalfAxes, 7> kClavicleSection = {
    {{10.5, 10.0}, {8.0, 7.6}, {6.2, 6.2}, {5.7, 6.2}, {5.4, 7.2}, {5.0, 9.0}, {4.6, 10.0}}};  // wide: height
constexpr SweptEnd kSternalEnd{4.0};
constexpr SweptEnd kAcromialEnd{3.0};
constexpr double kSocketMargin = 1.2;  // mm of cartilage around the sternal end

HalfAxes clavicleSectionAt(double share) {
  const double place = share * static_cast<double>(kClavicleSection.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(place), kClavicleSection.size() - 2);
  const double t = place - static_cast<double>(i);
  return {mix(kClavicleSection[i].wide, kClavicleSection[i + 1].wide, t),
          mix(kClavicleSection[i].thick, kClavicleSection[i + 1].thick, t)};
}

std::vector<Station> clavicleStations(double edge_mm) {
  const CubicSpline spline(kClavicleLine);
  const auto count = static_cast<std::size_t>(std::ceil(spline.length() / edge_mm)) + 1;
  const std::vector<Vec3> line = spline.evenly(count);
  std::vector<Station> stations;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 along = (line[std::min(i + 1, count - 1)] - line[i > 0 ? i - 1 : 0]).normalized();
    // Outward is the back here: along x outward must point up.
    Vec3 outward = Vec3(0.0, 0.25, -1.0);
    outward = (outward - outward.dot(along) * along).normalized();
    const HalfAxes section = clavicleSectionAt(static_cast<double>(i) / static_cast<double>(count - 1));
    stations.push_back({line[i], along, outward, along.cross(outward), section.wide, section.thick});
  }
  return stations;
}

}  // namespace

mesh::TriangleMesh makeRightClavicle(double edge_mm) {
  return sweepEllipse(clavicleStations(edge_mm), cornersOf(14.0, 14.0, edge_mm), kSternalEnd, kAcromialEnd);
}

Ball sternoclavicularSocket() {
  const Vec3 along = (kClavicleLine[1] - kClavicleLine[0]).normalized();
  return {kClavicleLine[0] + 4.0 * along, elementary::hypot(kClavicleSection[0].wide, 4.0) + kSocketMargin};
}

ClaviclePoints rightClaviclePoints() {
  return {kClavicleLine.front() + Vec3(0.0, kClavicleSection.front().wide, 0.0),
          kClavicleLine.back() + Vec3(0.0, kClavicleSection.back().wide, 0.0)};
}

}  // namespace palpate::body
