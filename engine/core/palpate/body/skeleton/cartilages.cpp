// Costal cartilages: an ellipse swept on from the end of its rib (body/ribs.cpp), in the rib's own direction and
// section, to a notch of the sternum (1-7) or to the lower border of the cartilage above (8-10). 5 to 10 first continue
// downwards and then turn up, which forms the costal arch; that of the first rib is short and broad.
//
// The courses are those of anatomical plates, our choice; so are the sections, which narrow towards the sternum. They
// are at least 5 mm under the skin of the chest.
#include <algorithm>
#include <cmath>
#include <vector>

#include "palpate/body/signed_distance.h"
#include "palpate/body/skeleton/skeleton_shapes.h"

namespace palpate::body {
namespace {

constexpr double kRibStationMm = 2.2;  // the rib's end hangs on it by a hair
constexpr double kJointGap = 0.4;      // mm between the flat end of the rib and that of the cartilage
constexpr double kSternumGap = 1.1;    // mm to the notch
constexpr double kArchGap = 0.6;       // mm between neighbours of the arch
constexpr double kEndHeight = 8.5;     // mm, section at the sternum
constexpr double kEndThickness = 7.0;
constexpr double kArchEndHeight = 6.0;  // for 8 to 10, which end in a point
constexpr double kArchEndThickness = 5.0;
constexpr double kLeadShare = 0.35;  // share of the way to the next point, along the rib's direction

// Points between the rib's end and the end; empty for a course that needs none.
const std::array<std::vector<Vec3>, kCartilageCount> kCourse = {{
    {},
    {},
    {},
    {},
    {{54, 11, -93}, {38, 15, -90}},
    {{68, -24, -101}, {50, -16, -97.5}, {34, -2, -92.5}},
    {{80, -60, -99}, {62, -55, -101}, {42, -36, -97.5}, {26, -15, -93}},
    {{91, -81, -90}, {82, -79, -93}},
    {{99, -110, -81}, {91, -105, -86}},
    {{103, -140, -75}, {97, -134, -79}},
}};

// Ends of cartilages 8 to 10: the share of the cartilage above from its rib on.
constexpr std::array<double, 3> kJoinsAt = {0.36, 0.55, 0.60};

std::vector<Station> cartilageStations(int number, double edge_mm);

Vec3 outwardAt(const Vec3& centre, const Vec3& along) {
  const Vec3 from_cage = Vec3(0.75 * centre.x(), 0.0, centre.z() + 10.0).normalized();
  return (from_cage - from_cage.dot(along) * along).normalized();
}

Vec3 cartilageEnd(int number, double edge_mm) {
  if (number <= 7) return sternalNotch(number) + Vec3(kSternumGap + kCostochondralEnd.rounding_mm, 0.0, 0.0);
  const std::vector<Station> above = cartilageStations(number - 1, edge_mm);
  const double place = kJoinsAt[static_cast<std::size_t>(number - 8)] * static_cast<double>(above.size() - 1);
  const Station& at = above[static_cast<std::size_t>(place)];
  const Vec3 down = at.upward.y() > 0.0 ? Vec3(-at.upward) : at.upward;
  return at.centre + (at.half_height + kArchGap + 0.5 * kArchEndThickness) * down;
}

std::vector<Vec3> sampleCartilageLine(int number, const Station& rib, double edge_mm) {
  const Vec3 start = rib.centre + (kJointGap + 2.0 * kCostochondralEnd.rounding_mm) * rib.along;
  const Vec3 end = cartilageEnd(number, edge_mm);
  std::vector<Vec3> points{start};
  const std::vector<Vec3>& course = kCourse[static_cast<std::size_t>(number - 1)];
  const Vec3 next = course.empty() ? end : course.front();
  if (number > 1)
    points.emplace_back(start + kLeadShare * (next - start).norm() * rib.along);  // the first is too short
  points.insert(points.end(), course.begin(), course.end());
  points.push_back(end);
  const CubicSpline line(points);
  const auto count = static_cast<std::size_t>(std::ceil(line.length() / edge_mm)) + 1;
  return line.evenly(std::max<std::size_t>(count, 6));
}

std::vector<Station> cartilageStations(int number, double edge_mm) {
  const Station rib = rightRibEnd(number, trunkRibRows()[number - 1], kRibStationMm);
  const std::vector<Vec3> line = sampleCartilageLine(number, rib, edge_mm);
  const double end_height = 0.5 * (number <= 7 ? kEndHeight : kArchEndHeight);
  const double end_thickness = 0.5 * (number <= 7 ? kEndThickness : kArchEndThickness);
  std::vector<Station> stations;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(line.size() - 1);
    Vec3 along = (line[std::min(i + 1, line.size() - 1)] - line[i > 0 ? i - 1 : 0]).normalized();
    if (i == 0) along = (along + (number > 1 ? 4.0 : 0.8) * rib.along).normalized();
    // From the rib's own frame to that of the chest wall over the first third.
    const double turn = std::clamp(3.0 * share, 0.0, 1.0);
    Vec3 outward = mix(1.0, 0.0, turn) * rib.outward + turn * outwardAt(line[i], along);
    outward = (outward - outward.dot(along) * along).normalized();
    stations.push_back({line[i], along, outward, along.cross(outward), mix(rib.half_height, end_height, share),
                        mix(rib.half_thickness, end_thickness, share)});
  }
  return stations;
}

}  // namespace

mesh::TriangleMesh makeRightCartilage(int number, double edge_mm) {
  const std::vector<Station> stations = cartilageStations(number, edge_mm);
  const Index corners = cornersOf(2.0 * stations.front().half_height, 2.0 * stations.front().half_thickness, edge_mm);
  return sweepEllipse(stations, corners, kCostochondralEnd, number <= 7 ? kCostochondralEnd : SweptEnd{});
}

Vec3 rightCostochondralPoint(int number) {
  const Station rib = rightRibEnd(number, trunkRibRows()[number - 1], kRibStationMm);
  return rib.centre + rib.half_thickness * rib.outward;
}

}  // namespace palpate::body
