// From how deep and how stiff to how strong: the normal force of a point on the skin.
//
// The seam between the finger (`contact`) and the tissue: the finger knows a local stiffness and a depth and asks here.
// Every law is F = k h(d): the map's stiffness k (N/mm, interpolated in the triangle, E3) times an *effective depth* h
// that depends on the depth and, in layered tissue, on how thick the tissue over the bone is there. The map means one
// thing under every law: the secant stiffness at the reference depth, h(d_ref) = d_ref. So a place that is twice as
// stiff pushes twice as hard. A law is plain data without pointers, so that it travels inside an immutable surface and
// two runs can be compared bit by bit. docs/explanation/force-laws.md says which law is for what. Based on: Ji,
// dissertation 2008, (2.1) for Hooke's law and 6.2 for stiffness that follows a Gaussian curve.
#pragma once

#include <array>
#include <cstdint>

namespace palpate::tissue {

/// A stiffness map holds the force at this depth over the depth, mm. The single Hooke stiffness that fits presses of 2
/// to 10 mm best is right at about 8 mm, so a map measured with one number per place means this depth.
inline constexpr double kReferenceDepthMm = 8.0;

/// Radius of the fingertip that a stiffness map means, mm: of the rigid sphere that layered tissue was solved for.
inline constexpr double kFingertipMm = 8.0;

/// N/mm, of slopes: stiffer than this a fingertip's own pad gives way first, and a hand at 1 kHz would not be held
/// stably (docs/explanation/safety.md). Bounds what is extrapolated, and a body's own tissue (softenedTo).
inline constexpr double kStiffestTissue = 1.9;

/// Secants of layered tissue by the finger's radius, thickness and depth, over those of a fingertip at the reference
/// depth. Thickness and depth are evenly spaced, the thickness as 1 / mm, in which stiffness is nearly straight: a
/// look-up is a division and no search. Between two radii the force is straight.
struct LayeredForce {
  static constexpr std::uint32_t kRadii = 7;
  static constexpr std::array<double, kRadii> kRadiiMm = {1.0, 2.0, 4.0, kFingertipMm, 12.0, 16.0, 24.0};
  static constexpr std::uint32_t kFingertip = 3;
  static constexpr std::uint32_t kRows = 16;
  static constexpr std::uint32_t kDepths = 33;
  static constexpr double kDepthStepMm = 0.5;
  std::uint32_t rows = 0;                  ///< 0 (without layered tissue: the law is Hooke's), 1 or kRows
  double thinnest_mm = 0.0;                ///< of the tissue over the bone, in the first row
  double inverse_step = 0.0;               ///< what 1 / thickness falls by from row to row, 1/mm
  std::array<double, kRows> tangential{};  ///< k_t / k_n
  /// By depth from 0 mm, where it is 0.
  using Rows = std::array<std::array<double, kDepths>, kRows>;
  std::array<Rows, kRadii> factor{};  ///< one per radius of kRadiiMm
  bool knows_radius = false;          ///< false: every finger counts as a fingertip, factor[kFingertip]
  double point_mm = kFingertipMm;     ///< the radius that a finger without one is felt with
  double thicknessOf(std::uint32_t row) const noexcept { return 1.0 / (1.0 / thinnest_mm - inverse_step * row); }
};

/// A measured law: effective depth by depth, straight between the rows and with its last slope beyond them. Read from a
/// file by user_profile.h. Before the first row it is straight from the origin. Its unit does not matter: the law is
/// scaled so that it agrees with the map at the reference depth.
struct ForceTable {
  /// A measured curve has some ten rows; 64 keep a law within a kilobyte and a look-up within six comparisons.
  static constexpr std::uint32_t kMaxRows = 64;
  std::uint32_t rows = 0;
  std::array<double, kMaxRows> depth_mm{};      ///< > 0, increasing
  std::array<double, kMaxRows> effective_mm{};  ///< >= 0, not decreasing: the force, in any unit
};

struct ForceLaw {
  enum class Kind : std::uint8_t {
    linear,      ///< h = d, Hooke's law
    power,       ///< h = d_ref (d / d_ref)^p
    stiffening,  ///< dh/dd goes from 1 to the ratio along a half Gaussian
    table,
    layered,  ///< by the thickness of the tissue at the place
  };
  Kind kind = Kind::linear;

  /// Power: p in [1, 3]. Layered tissue has 1.5 to 1.8 (finite elements, docs/explanation/force-laws.md).
  double exponent = 1.6;
  /// Where the law agrees with Hooke's, mm; of every kind but layered, whose tissue means kReferenceDepthMm.
  double reference_depth_mm = kReferenceDepthMm;
  /// Stiffening: k1 / k0, k0 being how a light touch feels. In (0, 100]; 4 to 7 in layered tissue.
  double stiffening_ratio = 5.0;
  /// Stiffening: the depth at which k1 is reached, mm; 11 to 16 in layered tissue.
  double stiffening_depth_mm = 12.0;
  ForceTable table = {};
  LayeredForce layers = {};
};

/// The skin's response to one depth.
struct Response {
  double force_n = 0.0;          ///< normal force, >= 0
  double secant_n_per_mm = 0.0;  ///< F / d: the stiffness of the spring that pushes as hard at this depth
  double tangential = 1.0;       ///< what the skin's own layers make of k_t / k_n; 1 without them
};

/// Used by the layered law only. Beyond its rows and radii the first or last counts.
struct PressedPlace {
  double tissue_mm = 0.0;  ///< thickness over the bone
  double finger_mm = 0.0;  ///< radius of the finger; 0: a point
};

/// Throws Error naming the first parameter of the law's kind that makes no sense.
void check(const ForceLaw& law);

namespace detail {
/// h(d) / d for a depth > 0, of a law that is not linear.
double secantFactor(const ForceLaw& law, double depth_mm, const PressedPlace& place) noexcept;
double tangentialRatio(const ForceLaw& law, double tissue_mm) noexcept;
}  // namespace detail

/// For a depth in mm under the undeformed skin and the local stiffness in N/mm. A depth or a stiffness that is
/// not positive (NaN included) gives no force, and the secant is the stiffness then. Continuous and, to rounding, not
/// decreasing in both.
/// Linear costs one comparison more than a product, the others up to 50 ns. Any thread.
inline Response respond(const ForceLaw& law, double stiffness_n_per_mm, double depth_mm,
                        const PressedPlace& place) noexcept {
  if (!(depth_mm > 0.0) || !(stiffness_n_per_mm > 0.0)) return {0.0, stiffness_n_per_mm};
  if (law.kind == ForceLaw::Kind::linear) return {stiffness_n_per_mm * depth_mm, stiffness_n_per_mm};
  const double secant = stiffness_n_per_mm * detail::secantFactor(law, depth_mm, place);
  return {secant * depth_mm, secant, detail::tangentialRatio(law, place.tissue_mm)};
}

/// The response to a point.
inline Response respond(const ForceLaw& law, double stiffness_n_per_mm, double depth_mm,
                        double tissue_mm = 0.0) noexcept {
  return respond(law, stiffness_n_per_mm, depth_mm, PressedPlace{.tissue_mm = tissue_mm});
}

/// The force alone, N.
inline double normalForce(const ForceLaw& law, double stiffness_n_per_mm, double depth_mm,
                          const PressedPlace& place) noexcept {
  return respond(law, stiffness_n_per_mm, depth_mm, place).force_n;
}
inline double normalForce(const ForceLaw& law, double stiffness_n_per_mm, double depth_mm,
                          double tissue_mm = 0.0) noexcept {
  return respond(law, stiffness_n_per_mm, depth_mm, tissue_mm).force_n;
}

/// dF/dd in N/mm at a depth >= 0: what a small change of depth feels like. At a row of a table the slope that follows.
double tangentStiffness(const ForceLaw& law, double stiffness_n_per_mm, double depth_mm,
                        const PressedPlace& place) noexcept;
inline double tangentStiffness(const ForceLaw& law, double stiffness_n_per_mm, double depth_mm,
                               double tissue_mm = 0.0) noexcept {
  return tangentStiffness(law, stiffness_n_per_mm, depth_mm, PressedPlace{.tissue_mm = tissue_mm});
}

/// The force of layered tissue with its slope held below a cap, N: the integral of min(dF/dd, cap) from the surface.
/// Nowhere steeper than `cap_n_per_mm`, nowhere more than the law's own force, and that force where no smaller depth is
/// steeper. 0.15 us. No allocation.
double cappedForce(const LayeredForce& layers, double stiffness_n_per_mm, double depth_mm, const PressedPlace& place,
                   double cap_n_per_mm) noexcept;

/// The largest tangent stiffness that a finger of this radius (0: a point) meets down to a depth, as a factor on the
/// map's stiffness, wherever on the skin; 1 for the linear law. A limit on how fast a force may change has to allow for
/// it.
double steepestFactor(const ForceLaw& law, double depth_mm, double finger_mm = 0.0) noexcept;

/// From how strong back to how deep: a force law read the other way. The finger never asks for it; the display does,
/// once a finger and frame, to show skin that pushes back with no more than it has left (contact/relaxation.h).
///
/// The least depth at which the law's effective depth reaches this, mm: h(result) = effective_mm to rounding. 0 for
/// what is not positive; no deeper than 1 m. Any thread.
double depthOf(const ForceLaw& law, double effective_mm, const PressedPlace& place) noexcept;
inline double depthOf(const ForceLaw& law, double effective_mm, double tissue_mm = 0.0) noexcept {
  return depthOf(law, effective_mm, PressedPlace{.tissue_mm = tissue_mm});
}

}  // namespace palpate::tissue
