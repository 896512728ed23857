// A rib is an ellipse swept along a spline: head and neck from its vertebra, the angle at a cover under the skin, then
// two quarter ellipses to the side and to the anterior end. It twists out of any plane by 5-7 mm as real ones do.
//
// Guided by: measures of all 24 ribs on an open mesh (one specimen): half widths, chords, pitch; Holcombe 2017 (PMID
// 28612467) [A] and Weaver 2014 (PMC4111931) [A] for the form, no coefficients taken; the section 12-15 x 6-8 mm is
// [R] recalled. Covers: rib 5 interscapular 27 +- 4 mm, Wada 2025, J Phys Ther Sci 37:84 [A]. The columns are
// construction values for stature 1750; `angle_z` was measured under the fitted skin, the depths of ribs 1-10
// shortened to leave 14 mm to the ventral skin of the same (flat) chest.
#include "palpate/body/bone_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "palpate/base/elementary.h"
#include "palpate/body/cubic_spline.h"
#include "palpate/body/rotation.h"
#include "palpate/body/signed_distance.h"
#include "palpate/body/spine_line.h"
#include "palpate/body/swept_ellipse.h"

namespace palpate::body {
namespace {

constexpr std::array<RibRow, kRibCount> kRibRows = {{
    {50, -4, 19.8, 58, 24, -16.8, 38, 53, -34.7, 11, 6, 55},
    {52, -6, 36.3, 88, 29, -19.9, 42, 65, -53.9, 12, 6.5, 38},
    {58, -5, 55.1, 110, 37, -30.5, 50, 69, -75.5, 13, 7, 22},
    {63, -2, 65.8, 124, 43, -41.7, 60, 74, -96.7, 13.5, 7.5, 12},
    {67, 3, 78.3, 131, 49, -54.6, 74, 82, -119.4, 14, 7.5, 8},
    {70, 7, 85.2, 136, 57, -62.9, 88, 91, -133.1, 14, 8, 5},
    {73, 9, 87.8, 138, 65, -66.1, 98, 99, -133.9, 14, 8, 3},
    {75, 13, 87.3, 138, 73, -65.8, 108, 106, -125.1, 14, 8, 0},
    {74, 13, 81.9, 136, 81, -69.5, 116, 112, -118.0, 13.5, 7.5, 0},
    {70, 15, 75.9, 128, 87, -75.7, 116, 116, -112.7, 13, 7.5, 0},
    {60, 14, 72.7, 112, 69, -50.0, 104, 85, -70.0, 12, 7, 0},
    {48, 12, 67.8, 80, 38, -10.0, 80, 38, -12.0, 9, 6, 0},
}};

// The section along the rib: head, neck, tubercle, then the even shaft.
struct SectionStop {
  double share, height, thickness;
};
constexpr std::array<SectionStop, 5> kSection = {
    {{0.0, 0.80, 1.20}, {0.03, 0.72, 1.00}, {0.07, 0.72, 0.95}, {0.16, 0.85, 1.15}, {0.30, 1.00, 1.00}}};

// Room between the tubercle's face and the transverse process (mm): cartilage, and the loss by smoothing and roll.
constexpr std::array<double, 10> kTubercleGap = {5.2, 6.6, 4.6, 3.6, 3.0, 3.0, 3.0, 3.0, 3.0, 4.0};

constexpr double kSmoothing =
    40.0;  // mm^2, twice the variance of the blur along the line: sections must not cross in bends
constexpr double kRollFrom = 0.16;   // share of the length where the face starts to roll,
constexpr double kRollUntil = 0.42;  // and where it has done so

const VertebraRow& vertebraRow(int number) { return spineRows()[number - 1]; }

// The contact of the head: between two bodies for ribs 2-9, on the side of one for the others.
Vec3 headPoint(int number) {
  const VertebraRow& v = vertebraRow(number);
  double lateral = 3.6;
  double dorsal = 0.72;
  double up = v.height / 2 + 1.0;
  if (number == 1) lateral = 8.5, dorsal = 0.15, up = 0.25 * v.height;
  if (number == 2) lateral = 5.4, dorsal = 0.5;
  if (number == 3) lateral = 4.8;
  if (number == 10) up = 0.35 * v.height;
  if (number > 10) up = 0.25 * v.height;
  return vertebraFrame(v) * Vec3(0.97 * v.width / 2 + lateral, up, dorsal * v.depth / 2);
}

// The tubercle is in front of the transverse process, clear of it.
Vec3 tuberclePoint(int number, const RibRow& row) {
  const VertebraRow& v = vertebraRow(number);
  const double ventral = v.transverse_radius + row.thickness / 2 + kTubercleGap[number - 1];
  return vertebraFrame(v) * (transverseTip(v) + Vec3(2.0, 1.5, -ventral));
}

Vec3 anglePoint(int number, const RibRow& r) { return {r.angle_x, headPoint(number).y() - r.angle_drop, r.angle_z}; }

// Appends a quarter ellipse: `from` and `to` are left and reached along the axes of `first`.
void addQuarter(std::vector<Vec3>& line, const Vec3& from, const Vec3& to, bool first, int count) {
  for (int i = 1; i <= count; ++i) {
    const double t = std::numbers::pi / 2 * i / count;
    const double early = elementary::sin(t);
    const double late = 1.0 - elementary::cos(t);
    line.emplace_back(mix(from.x(), to.x(), first ? early : late),
                      mix(from.y(), to.y(), static_cast<double>(i) / count),
                      mix(from.z(), to.z(), first ? late : early));
  }
}

std::vector<Vec3> controlPoints(int number, const RibRow& r) {
  const Vec3 head = headPoint(number);
  const Vec3 lateral(r.half_width - r.thickness / 2, head.y() - r.lateral_drop, head.z() + r.lateral_z);
  const Vec3 anterior(r.anterior_x, head.y() - r.anterior_drop, head.z() + r.anterior_z);
  std::vector<Vec3> line{head};
  if (number <= 10) line.push_back(tuberclePoint(number, r));
  line.push_back(anglePoint(number, r));
  addQuarter(line, Vec3(line.back()), lateral, true, 6);
  addQuarter(line, lateral, anterior, false, 5);
  return line;
}

// Takes the kinks out of the joints between the pieces; the ends stay.
void smoothLine(std::vector<Vec3>& line, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    std::vector<Vec3> next = line;
    for (std::size_t i = 1; i + 1 < line.size(); ++i) next[i] = 0.25 * line[i - 1] + 0.5 * line[i] + 0.25 * line[i + 1];
    line = std::move(next);
  }
}

SectionStop sectionAt(double share) {
  const auto next =
      std::find_if(kSection.begin(), kSection.end(), [&](const SectionStop& s) { return s.share > share; });
  if (next == kSection.end()) return kSection.back();
  const SectionStop& before = *(next - 1);
  const double t = smoothStep(before.share, next->share, share);
  return {share, mix(before.height, next->height, t), mix(before.thickness, next->thickness, t)};
}

std::vector<Station> ribStations(int number, const RibRow& row, double edge_mm) {
  const CubicSpline spline(controlPoints(number, row));
  const auto count = static_cast<std::size_t>(std::ceil(spline.length() / edge_mm)) + 1;
  std::vector<Vec3> line = spline.evenly(count);
  smoothLine(line, static_cast<int>(kSmoothing / (edge_mm * edge_mm)) + 1);
  const double cage_centre_z = headPoint(number).z() + 0.5 * row.anterior_z;

  std::vector<Station> stations;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    const SectionStop section = sectionAt(share);
    const double roll = radians(row.roll_deg) * smoothStep(kRollFrom, kRollUntil, share);
    const Vec3 along = (line[std::min(i + 1, count - 1)] - line[i > 0 ? i - 1 : 0]).normalized();
    const Vec3 from_cage = Vec3(line[i].x(), 0.0, line[i].z() - cage_centre_z).normalized();
    Vec3 outward = elementary::cos(roll) * from_cage + elementary::sin(roll) * Vec3::UnitY();
    outward = (outward - outward.dot(along) * along).normalized();
    stations.push_back({line[i], along, outward, along.cross(outward), 0.5 * row.height * section.height,
                        0.5 * row.thickness * section.thickness});
  }
  return stations;
}

}  // namespace

std::span<const RibRow, kRibCount> ribRows() { return kRibRows; }

mesh::TriangleMesh makeRightRib(int number, const RibRow& row, double edge_mm, SweptEnd anterior) {
  return sweepEllipse(ribStations(number, row, edge_mm), cornersOf(row.height, row.thickness, edge_mm), {}, anterior);
}

Station rightRibEnd(int number, const RibRow& row, double edge_mm) { return ribStations(number, row, edge_mm).back(); }

Vec3 rightRibAngle(int number, const RibRow& row) {
  return anglePoint(number, row) + Vec3(0.0, 0.0, row.thickness / 2);
}

}  // namespace palpate::body
