// A vertebra is a union of a column, elliptic capsules and their blends, described for the right half; it is never
// evaluated at x < 0. All sizes follow the row; the few plain numbers are proportions of our choice, set by eye against
// anatomical plates.
#include "palpate/body/bone_shapes.h"

#include <cmath>
#include <numbers>

#include "palpate/base/elementary.h"
#include "palpate/body/rotation.h"
#include "palpate/body/signed_distance.h"
#include "palpate/body/tetrahedra_mesher.h"

namespace palpate::body {
namespace {

constexpr double kOutOfReach = 8.0;  // mm, beyond every blend and the mesher's blocks
constexpr int kVertebraRelaxRounds = 3;
constexpr double kEndplateEdge = 2.5;    // mm, rounding of the rim of the endplates
constexpr double kLaminaOverhang = 2.0;  // mm from the canal's wall to the middle of the lamina
constexpr double kCanalLift = 0.5;       // mm by which the canal cuts into the body's dorsal wall
constexpr double kMinTransverseRoot = 4.2;

// Places on the neural arch that several parts share.
struct Arch {
  double half_width, half_depth, half_canal;
  double pedicle_x, pedicle_y;  // axis of the pedicle
  double root_z;                // where pedicle, lamina, facets and transverse process meet
  double lamina_z;              // dorsal end of the laminae, in the midline

  explicit Arch(const VertebraRow& row)
      : half_width(row.width / 2),
        half_depth(row.depth / 2),
        half_canal(row.canal_width / 2),
        pedicle_x(half_canal + row.pedicle_width / 2 - 1.0),
        pedicle_y((row.thoracic() ? 0.20 : 0.15) * row.height),
        root_z(half_depth + 0.45 * row.canal_depth),
        lamina_z(half_depth + row.canal_depth + kLaminaOverhang) {}
};

Vec3 spinousDirection(const VertebraRow& row) {
  const double down = radians(row.spinous_down_deg);
  return {0.0, -elementary::sin(down), elementary::cos(down)};
}

Vec3 spinousRoot(const VertebraRow& row) { return {0.0, -0.10 * row.height, Arch(row).lamina_z - 1.0}; }

Vec3 spinousEnd(const VertebraRow& row) { return spinousRoot(row) + row.spinous_length * spinousDirection(row); }

// Half height of the spinous process at its tip. The long overlapping thoracic ones end in a tubercle.
double spinousTipHalfHeight(const VertebraRow& row) {
  return row.thoracic() && row.spinous_height < 10.0 ? 4.0 : 0.4 * row.spinous_height;
}

Vec3 transverseRoot(const VertebraRow& row) {
  const Arch arch(row);
  return {arch.pedicle_x + 0.5, arch.pedicle_y - 1.0, arch.root_z - 1.0};
}

// Everything but the spinous process, the canal not yet cut.
struct VertebraParts {
  VertebraRow row;
  Arch arch;
  EllipticCapsule pedicle;
  FlatTube<PlateCapsule> lamina;
  PlateCapsule upper_facet, lower_facet;
  Capsule transverse;
  PlateCapsule spinous_root, spinous_tip;

  explicit VertebraParts(const VertebraRow& r)
      : row(r),
        arch(r),
        pedicle(makePedicle(r, arch)),
        lamina(makeLamina(r, arch)),
        upper_facet(makeUpperFacet(r, arch)),
        lower_facet(makeLowerFacet(r, arch)),
        transverse(makeTransverse(r)),
        spinous_root(makeSpinousRoot(r)),
        spinous_tip(makeSpinousTip(r)) {}

  static EllipticCapsule makePedicle(const VertebraRow& r, const Arch& a) {
    return {{a.pedicle_x - 1.0, a.pedicle_y, a.half_depth - 4.0},
            {a.pedicle_x, a.pedicle_y, a.root_z + 1.0},
            Vec3::UnitX(),
            {r.pedicle_width / 2, r.pedicle_height / 2}};
  }
  // The lamina follows the dorsal wall of the canal from the pedicle to the midline.
  static FlatTube<PlateCapsule> makeLamina(const VertebraRow& r, const Arch& a) {
    const double centre_z = a.half_depth + r.canal_depth / 2 - kCanalLift;
    std::vector<FlatRing> rings;
    for (const double degrees : {82.0, 60.0, 38.0, 18.0, 0.0}) {
      const double angle = radians(degrees);
      const double y = mix(-0.12 * r.height, a.pedicle_y - 0.18 * r.height, degrees / 82.0);
      rings.push_back({{(a.half_canal + kLaminaOverhang) * elementary::sin(angle), y,
                        centre_z + (r.canal_depth / 2 + kLaminaOverhang) * elementary::cos(angle)},
                       Vec3::UnitY(),
                       {0.42 * r.height, 3.0}});
    }
    return {rings, 1};
  }
  // Upper and lower facets are set apart (thoracic front to back, lumbar sideways), or neighbours collide.
  static PlateCapsule makeUpperFacet(const VertebraRow& r, const Arch& a) {
    const double c = a.half_canal;
    if (r.thoracic()) {
      return {{c + 1.2, a.pedicle_y, a.root_z + 0.5},
              {c + 1.0, r.height / 2 + 3.0, a.root_z - 0.8},
              Vec3::UnitX(),
              {3.9, 2.1}};
    }
    return {{c + 4.0, a.pedicle_y, a.root_z + 1.0},
            {c + 6.6, r.height / 2 + 4.0, a.root_z + 3.0},
            Vec3::UnitZ(),
            {4.1, 2.5}};
  }
  static PlateCapsule makeLowerFacet(const VertebraRow& r, const Arch& a) {
    const double c = a.half_canal;
    if (r.thoracic()) {
      return {{c + 1.0, a.pedicle_y, a.root_z + 2.0},
              {c + 0.2, -0.56 * r.height, a.root_z + 6.6},
              Vec3::UnitX(),
              {3.9, 2.1}};
    }
    return {
        {c + 2.5, a.pedicle_y, a.root_z + 3.0}, {c - 1.6, -0.62 * r.height, a.root_z + 5.5}, Vec3::UnitZ(), {4.1, 2.5}};
  }
  static Capsule makeTransverse(const VertebraRow& r) {
    return {transverseRoot(r), transverseTip(r), std::max(1.15 * r.transverse_radius, kMinTransverseRoot),
            r.transverse_radius};
  }
  static PlateCapsule makeSpinousRoot(const VertebraRow& r) {
    return {spinousRoot(r),
            0.5 * (spinousRoot(r) + spinousEnd(r)),
            Vec3::UnitY(),
            {0.62 * r.spinous_height, 3.6},
            {0.48 * r.spinous_height, 2.6}};
  }
  static PlateCapsule makeSpinousTip(const VertebraRow& r) {
    return {0.5 * (spinousRoot(r) + spinousEnd(r)),
            spinousEnd(r),
            Vec3::UnitY(),
            {0.48 * r.spinous_height, 2.6},
            {spinousTipHalfHeight(r), r.spinous_thickness / 2}};
  }

  double bodyDistance(const Vec3& p) const {
    const double behind = p.z() - arch.half_depth;
    if (behind > kOutOfReach) return behind;  // a lower bound is enough where nothing blends with the body
    const double height = std::min(std::abs(2.0 * p.y() / row.height), 1.0);
    const double waist = 1.0 - (row.thoracic() ? 0.08 : 0.10) * (1.0 - height * height);
    const double front = row.thoracic() ? std::clamp(-p.z() / arch.half_depth, 0.0, 1.0) : 0.0;
    const double exponent = row.thoracic() ? 2.1 : 2.4;
    const double side = superellipseDistance(p.x(), p.z(), arch.half_width * waist * (1.0 - 0.12 * front),
                                             arch.half_depth * waist, exponent);
    return roundedIntersection(side, std::abs(p.y()) - row.height / 2, kEndplateEdge);
  }

  double archDistance(const Vec3& p) const {
    const double before = arch.half_depth - 4.0 - row.pedicle_height / 2 - p.z();
    if (before > kOutOfReach) return before;
    double d = smoothUnion(pedicle.distance(p), lamina.distance(p), 2.5);
    d = smoothUnion(d, upper_facet.distance(p), 2.0);
    d = smoothUnion(d, lower_facet.distance(p), 2.0);
    return smoothUnion(d, transverse.distance(p), 3.0);
  }

  double canalDistance(const Vec3& p) const {
    const double z = p.z() - (arch.half_depth + row.canal_depth / 2 - kCanalLift);
    return ellipseDistance(p.x(), z, arch.half_canal, row.canal_depth / 2);
  }

  double distance(const Vec3& p) const {
    double d = smoothUnion(bodyDistance(p), archDistance(p), 3.0);
    d = smoothDifference(d, canalDistance(p), 3.0);
    return smoothUnion(d, std::min(spinous_root.distance(p), spinous_tip.distance(p)), 2.5);
  }

  // A box around all parts, a little generous.
  MesherSettings box(double cell_mm) const {
    const Vec3 tip = spinousTip(row);
    const double reach = transverseTip(row).x() + row.transverse_radius + 4.0;
    return {.low = {0.0, std::min(-0.62 * row.height - 8.0, tip.y() - 10.0), -arch.half_depth - 4.0},
            .high = {std::max(reach, arch.half_width + 4.0), row.height / 2 + 10.0, tip.z() + 6.0},
            .cell_mm = cell_mm};
  }
};

}  // namespace

Vec3 transverseTip(const VertebraRow& row) {
  const Vec3 root = transverseRoot(row);
  const double x = row.transverse_span / 2 - row.transverse_radius - 1.5;
  const double back = 0.55 * elementary::tan(radians(row.transverse_back_deg)) * (x - root.x());
  const bool first = row.name[0] == 'T' && row.name[1] == '1' && row.name[2] == '\0';
  return {x, root.y() + (first ? 3.0 : 0.0), root.z() + back};
}

Vec3 spinousTip(const VertebraRow& row) {
  const double cap = std::min(spinousTipHalfHeight(row), row.spinous_thickness / 2);
  return spinousEnd(row) + cap * spinousDirection(row);
}

mesh::TriangleMesh makeVertebraHalf(const VertebraRow& row, double cell_mm) {
  const VertebraParts parts(row);
  return relaxedSurface(parts, parts.box(cell_mm), kVertebraRelaxRounds);
}

}  // namespace palpate::body
