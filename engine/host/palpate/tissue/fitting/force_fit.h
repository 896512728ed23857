// A force law for measured curves: which form, how stiff, how sure.
//
//   force_curves.h ─ curves ─► here: each form fitted, checked by rows it has not seen ─► scene keys, a force table
//
// Every form is k h(d) with h(d_ref) = d_ref, as the engine's laws are (force_law.h): k is the secant stiffness at the
// reference depth, as in the stiffness map. A row counts by how sure it is: a part of a force's noise grows with the
// force and a part does not, in the proportion that makes the curve most likely. Described in
// docs/explanation/tissue.md.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "palpate/tissue/fitting/bounded_fit.h"
#include "palpate/tissue/fitting/force_curves.h"
#include "palpate/tissue/force_law.h"

namespace palpate::tissue {

// The forms that a measured force law may have, each with its numbers and the range they are looked for in.

enum class ForceForm : std::uint8_t {
  linear,      ///< Hooke's
  power,       ///< exponent
  stiffening,  ///< stiffening_ratio, stiffening_depth_mm
  cubic,       ///< k1 d + k3 d^3: cubic_share is that of the force at the reference depth
  measured,    ///< the rows themselves, smoothed to a table that does not fall
};
inline constexpr std::array kForceForms = {ForceForm::linear, ForceForm::power, ForceForm::stiffening, ForceForm::cubic,
                                           ForceForm::measured};
std::string_view nameOf(ForceForm form);

/// A number of a form as the fit turns it: some by their logarithm.
struct FormNumber {
  std::string_view name;  ///< as a scene's key where there is one
  Bounds inner;
  bool logarithmic = false;
  double ForceLaw::*member = nullptr;  ///< none: no law of the engine's has it

  double innerOf(double value) const;
  double valueOf(double inner) const;
};

/// None of the linear and the measured form.
const std::vector<FormNumber>& numbersOf(ForceForm form);

/// Inner numbers where descents begin; at least one.
std::vector<Eigen::VectorXd> startsOf(ForceForm form);

/// h(d) of a form with its numbers: d_ref at the reference depth. Not of the measured form.
class FormShape {
 public:
  FormShape(ForceForm form, const Eigen::VectorXd& inner);

  /// 0 above the skin.
  double at(double depth_mm) const;
  Eigen::ArrayXd at(const Eigen::ArrayXd& depth_mm) const;

  /// The engine's law; a table without rows for the cubic form.
  const ForceLaw& law() const { return law_; }

 private:
  ForceForm form_;
  ForceLaw law_;
  double cubic_share_ = 0.0;
};

struct ForceFit {
  ForceForm form = ForceForm::linear;
  FittedNumber secant = {};                ///< k, N/mm
  std::vector<FittedNumber> numbers = {};  ///< numbers of the form
  FittedNumber offset = {};                ///< mm: where the skin is met, below the table's 0
  ForceLaw law = {};                       ///< with its numbers, where the engine has such a law; a table otherwise
  // Fractions: RMS of (fit - F) / max(F, 0.3 F_max).
  double rms = 0.0;
  double unseen_rms = 0.0;  ///< over rows left out of the fit, a fifth at a time
  /// The noise that does not depend on the force, over that in proportion to it, at the largest force: 0.02 to 3.
  double noise_floor = 0.0;
  std::size_t rows = 0;
  double deepest_mm = 0.0;  ///< from the contact; beyond it the law is a guess
};

struct ForceFitSettings {
  bool free_offset = false;  ///< else the table's 0 is the contact
  double most_offset_mm = 0.6;
};

/// N, at a depth as the curve counts it.
double forceOf(const ForceFit& fit, double depth_mm);

/// Throws Error for a curve that rowsOf (force_rows.h) refuses.
ForceFit fitForce(const ForceCurve& curve, ForceForm form, const ForceFitSettings& settings);

/// All forms, in the order of kForceForms.
std::vector<ForceFit> fitForces(const ForceCurve& curve, const ForceFitSettings& settings);

/// One shape for several places, each with a stiffness of its own: the form's numbers by all rows, every offset as the
/// curve's own fit has it, the secant the median of theirs. Both RMS are means over the curves; unseen: the shape is
/// that of other curves, a fifth of them left out at a time. Errors are not known (NaN).
ForceFit fitSharedForce(std::span<const ForceCurve> curves, ForceForm form, const ForceFitSettings& settings);

/// The form that predicts unseen rows best; of those that do so nearly as well (within a twentieth) the one with the
/// fewest numbers.
const ForceFit& bestOf(std::span<const ForceFit> fits);

/// The fit as rows that a scene reads (user_profile.h): N, from the contact as deep as was measured.
ForceTable tableOf(const ForceFit& fit);

}  // namespace palpate::tissue
