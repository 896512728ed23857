// From how deep and how stiff to how strong: the normal force of a point on the skin.
//
// The seam between the finger (`contact`) and the tissue: the finger knows a local stiffness and a depth and asks here.
// Every law is F = k h(d): the map's stiffness k (N/mm, interpolated in the triangle, E3) times an *effective depth* h
// that depends on the depth alone. So a map keeps its meaning under every law, and a place that is twice as stiff
// pushes twice as hard. A law is plain data without pointers, so that it travels inside an immutable surface and two
// runs can be compared bit by bit. docs/force-laws.md says which law is for what.
// Based on: Ji, dissertation 2008, (2.1) for Hooke's law and 6.2 for stiffness that follows a Gaussian curve.
#pragma once

#include <array>
#include <cstdint>

namespace palpate::tissue {

/// A measured law: effective depth by depth, straight between the rows and with its last slope beyond them. Read from a
/// file by force_table.h. Before the first row it is straight from the origin.
struct ForceTable {
  /// A measured curve has some ten rows; 64 keep a law within a kilobyte and a look-up within six comparisons.
  static constexpr std::uint32_t kMostRows = 64;
  std::uint32_t rows = 0;
  std::array<double, kMostRows> depth_mm{};      ///< > 0, increasing
  std::array<double, kMostRows> effective_mm{};  ///< >= 0, not decreasing: the force in N where the map says 1 N/mm
};

struct ForceLaw {
  enum class Kind : std::uint8_t {
    linear,      ///< h = d, Hooke's law
    power,       ///< h = d_ref (d / d_ref)^p
    stiffening,  ///< dh/dd goes from 1 to the ratio along a half Gaussian
    table,
  };
  Kind kind = Kind::linear;

  /// Power: p in [1, 3]. Layered tissue has 1.5 to 1.8 (finite elements, docs/force-laws.md).
  double exponent = 1.6;
  /// Power: where the law agrees with Hooke's, mm. The single Hooke stiffness that fits presses of 2 to 10 mm best is
  /// right at about 8 mm, so a map measured with one number per place means this depth.
  double reference_depth_mm = 8.0;
  /// Stiffening: k1 / k0, k0 being the map's stiffness: how a light touch feels. In (0, 100]; 4 to 7 in layered tissue.
  double stiffening_ratio = 5.0;
  /// Stiffening: the depth at which k1 is reached, mm; 11 to 16 in layered tissue.
  double stiffening_depth_mm = 12.0;
  ForceTable table;
};

/// What the skin answers to one depth.
struct Response {
  double force_n = 0.0;          ///< normal force, >= 0
  double secant_n_per_mm = 0.0;  ///< F / d: the stiffness of the spring that pushes as hard at this depth
};

/// Throws Error naming the first parameter of the law's kind that makes no sense.
void check(const ForceLaw& law);

namespace detail {
/// h(d) / d for a depth > 0, of a law that is not linear.
double secantFactor(const ForceLaw& law, double depth_mm) noexcept;
}  // namespace detail

/// For a depth in mm under the undeformed skin and the local stiffness in N/mm. A depth or a stiffness that is not
/// positive (NaN included) gives no force, and the secant is the stiffness then. Continuous and, to rounding, not
/// decreasing in both.
/// Linear costs one comparison more than a product, the others up to 50 ns. Any thread.
inline Response respond(const ForceLaw& law, double stiffness_n_per_mm, double depth_mm) noexcept {
  if (!(depth_mm > 0.0) || !(stiffness_n_per_mm > 0.0)) return {0.0, stiffness_n_per_mm};
  const double secant = law.kind == ForceLaw::Kind::linear ? stiffness_n_per_mm
                                                           : stiffness_n_per_mm * detail::secantFactor(law, depth_mm);
  return {secant * depth_mm, secant};
}

/// The force alone, N.
inline double normalForce(const ForceLaw& law, double stiffness_n_per_mm, double depth_mm) noexcept {
  return respond(law, stiffness_n_per_mm, depth_mm).force_n;
}

/// dF/dd in N/mm at a depth >= 0: what a small change of depth feels like. At a row of a table the slope that follows.
double tangentStiffness(const ForceLaw& law, double stiffness_n_per_mm, double depth_mm) noexcept;

/// The largest tangent stiffness down to a depth, as a factor on the map's stiffness; 1 for the linear law. A limit on
/// how fast a force may change has to allow for it.
double steepestFactor(const ForceLaw& law, double depth_mm) noexcept;

}  // namespace palpate::tissue
