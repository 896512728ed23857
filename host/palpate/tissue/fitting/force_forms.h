// The forms that a measured force law may have, each with its numbers and the range they are looked for in.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "palpate/tissue/fitting/bounded_fit.h"
#include "palpate/tissue/force_law.h"

namespace palpate::tissue {

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

  /// As the engine has it; a table without rows for the cubic form.
  const ForceLaw& law() const { return law_; }

 private:
  ForceForm form_;
  ForceLaw law_;
  double cubic_share_ = 0.0;
};

}  // namespace palpate::tissue
