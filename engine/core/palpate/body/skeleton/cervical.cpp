// C5, C6 and C7: small bodies with uncinate lips, wide triangular canals, articular pillars, transverse processes with
// a foramen, and spinous processes that are short and bifid except for that of C7, the vertebra prominens.
//
// Based on: Panjabi 1991, Spine 16(8):861, "Cervical human vertebrae", [R] recalled: bodies 17-20 wide and 15-17 deep
// at their endplates (here with the uncinate lips), 11-13 high (dry bone, x 1.1 as in the thorax), canal 24-27 x 14-15,
// spinous processes longest at C7; the caudal vertebra is the larger one [S]. Inclination, spans of the transverse
// processes (50-70) and the placement, which carries on the line of T1 into the leaning neck of the skin, are our
// choice; the spinous lengths were set by the cover under the skin.
#include <cmath>
#include <numbers>

#include "palpate/base/elementary.h"
#include "palpate/body/rotation.h"
#include "palpate/body/signed_distance.h"
#include "palpate/body/skeleton/skeleton_shapes.h"
#include "palpate/body/tetrahedra_mesher.h"

namespace palpate::body {
namespace {

constexpr std::array<VertebraRow, kCervicalCount> kCervicalRows = {{
    // name  body            canal       pedicle   spinous process   transverse    disc  centre y, z, pitch
    {"C5", 13.0, 20.0, 16.0, 25.0, 14.5, 5.5, 7.0, 21.0, 14, 7.5, 5.0, 53, 20, 3.6, 5.0, 216.5, -14.0, 8},
    {"C6", 13.0, 21.0, 16.5, 25.5, 14.5, 5.8, 7.2, 25.0, 18, 8.0, 5.2, 55, 20, 3.8, 5.0, 200.0, -12.5, 13},
    {"C7", 14.5, 23.0, 17.0, 24.5, 15.0, 6.5, 7.8, 38.0, 22, 8.5, 6.0, 66, 22, 4.4, 5.0, 182.8, -10.8, 20},
}};

constexpr double kCervicalEndplateEdge = 2.2;  // mm, rounding of the rim of the endplates
constexpr double kForamenRadius = 2.6;         // mm, half the width of the transverse foramen, our choice
constexpr double kBifidSpread = 4.2;           // mm from the midline to the middle of one end of a bifid process
constexpr double kLaminaHalfThick = 2.4;

bool bifid(const VertebraRow& row) { return row.name[1] != '7'; }

Vec3 cervicalSpinousDirection(const VertebraRow& row) {
  const double down = radians(row.spinous_down_deg);
  return {0.0, -elementary::sin(down), elementary::cos(down)};
}

Vec3 cervicalSpinousRoot(const VertebraRow& row) { return {0.0, -1.5, row.depth / 2 + row.canal_depth + 0.5}; }

Vec3 cervicalSpinousEnd(const VertebraRow& row) {
  return cervicalSpinousRoot(row) + row.spinous_length * cervicalSpinousDirection(row);
}

struct CervicalParts {
  VertebraRow row;
  double half_width, half_depth, half_canal, pillar_x, pillar_z;
  PlateCapsule pedicle, pillar, spinous;
  FlatTube<PlateCapsule> lamina;
  Capsule transverse_front, transverse_back, foramen, uncinate, spine_end;

  explicit CervicalParts(const VertebraRow& r)
      : row(r),
        half_width(r.width / 2),
        half_depth(r.depth / 2),
        half_canal(r.canal_width / 2),
        pillar_x(half_canal + 5.0),
        pillar_z(half_depth + 5.0),
        pedicle({half_width - 3.0, 0.5, half_depth - 4.0}, {pillar_x - 1.0, 0.5, pillar_z}, Vec3::UnitY(),
                {r.pedicle_height / 2, r.pedicle_width / 2}),
        // The facets of a neck look up and back: the pillar is a slanted block between an upper and a lower one.
        pillar({pillar_x, 0.5 * r.height - 2.2, pillar_z - 1.2},
               {pillar_x, -0.5 * r.height + (bifid(r) ? 2.0 : 3.4), pillar_z + (bifid(r) ? 3.2 : 10.2)}, Vec3::UnitX(),
               {5.0, 3.4}),
        spinous(cervicalSpinousRoot(r), cervicalSpinousEnd(r), Vec3::UnitY(), {0.55 * r.spinous_height, 3.0},
                {0.5 * r.spinous_height, bifid(r) ? 2.6 : 0.5 * r.spinous_thickness}),
        lamina(laminaRings(r, pillar_x, pillar_z), 2),
        transverse_front{{half_width - 2.0, 0.0, -1.0}, tip() + Vec3(-1.0, 0.0, -2.0), 2.8, 2.6},
        transverse_back{{pillar_x - 1.0, 0.5, pillar_z - 1.0}, tip(), 3.2, r.transverse_radius},
        foramen{{half_width + 4.6, -20.0, half_depth - 5.2},
                {half_width + 4.6, 20.0, half_depth - 5.2},
                kForamenRadius,
                kForamenRadius},
        uncinate{{half_width - 1.2, 0.5 * r.height - 1.5, -0.4 * half_depth},
                 {half_width - 1.2, 0.5 * r.height - 0.5, 0.6 * half_depth},
                 2.4,
                 2.4},
        spine_end{cervicalSpinousEnd(r) - 4.0 * cervicalSpinousDirection(r) + Vec3(1.0, 0.0, 0.0),
                  cervicalSpinousEnd(r) + Vec3(kBifidSpread, -1.5, 0.5), 2.4, 2.7} {}

  // Tip of the transverse process.
  Vec3 tip() const {
    const double x = row.transverse_span / 2 - row.transverse_radius;
    return {x, -1.0, half_depth - 2.0 + elementary::tan(radians(row.transverse_back_deg)) * 0.5 * (x - half_width)};
  }

  static std::vector<FlatRing> laminaRings(const VertebraRow& r, double pillar_x, double pillar_z) {
    const double dorsal_z = r.depth / 2 + r.canal_depth + 2.0;
    const auto axes = [&](double share) { return HalfAxes{share * r.height, kLaminaHalfThick}; };
    return {{{pillar_x - 1.0, 0.0, pillar_z + 1.5}, Vec3::UnitY(), axes(0.22)},
            {{0.62 * pillar_x, -0.5, mix(pillar_z + 1.0, dorsal_z, 0.52)}, Vec3::UnitY(), axes(0.38)},
            {{0.0, -1.5, dorsal_z}, Vec3::UnitY(), axes(0.40)}};
  }

  double bodyDistance(const Vec3& p) const {
    const double height = std::min(std::abs(2.0 * p.y() / row.height), 1.0);
    const double waist = 1.0 - 0.06 * (1.0 - height * height);
    const double side = superellipseDistance(p.x(), p.z(), half_width * waist, half_depth * waist, 2.4);
    const double column = roundedIntersection(side, std::abs(p.y()) - row.height / 2, kCervicalEndplateEdge);
    return smoothUnion(column, uncinate.distance(p), 2.0);
  }

  // Wide and low, a triangle with round corners: an ellipse whose dorsal half is the narrower one.
  double canalDistance(const Vec3& p) const {
    const double z = p.z() - (half_depth + row.canal_depth / 2 - 0.5);
    const double narrowing = 1.0 - 0.25 * std::clamp(z / row.canal_depth + 0.5, 0.0, 1.0);
    return ellipseDistance(p.x(), z, half_canal * narrowing, row.canal_depth / 2);
  }

  double distance(const Vec3& p) const {
    double d = smoothUnion(bodyDistance(p), pedicle.distance(p), 2.5);
    d = smoothUnion(d, std::min(transverse_front.distance(p), transverse_back.distance(p)), 2.5);
    d = smoothUnion(d, lamina.distance(p), 2.5);
    d = smoothUnion(d, pillar.distance(p), 2.0);
    d = smoothDifference(d, canalDistance(p), 2.0);
    d = smoothDifference(d, foramen.distance(p), 1.5);
    d = smoothUnion(d, spinous.distance(p), 2.5);
    return bifid(row) ? smoothUnion(d, spine_end.distance(p), 2.0) : d;
  }

  MesherSettings box(double cell_mm) const {
    const Vec3 end = cervicalSpinousEnd(row);
    return {.low = {0.0, std::min(-0.5 * row.height - 8.0, end.y() - 10.0), -half_depth - 4.0},
            .high = {row.transverse_span / 2 + 4.0, 0.5 * row.height + 8.0, end.z() + 7.0},
            .cell_mm = cell_mm};
  }
};

}  // namespace

std::span<const VertebraRow, kCervicalCount> cervicalRows() { return kCervicalRows; }

mesh::TriangleMesh makeCervicalHalf(const VertebraRow& row, double cell_mm) {
  const CervicalParts parts(row);
  return relaxedSurface(parts, parts.box(cell_mm), kSkeletonRelaxRounds);
}

Vec3 cervicalSpinousTip(const VertebraRow& row) {
  return cervicalSpinousEnd(row) +
         (bifid(row) ? 2.3 : 0.5 * row.spinous_thickness - 0.9) * cervicalSpinousDirection(row);
}

}  // namespace palpate::body
