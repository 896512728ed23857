// The forms are those of docs/explanation/force-laws.md and the cubic of docs/explanation/tissue.md.
#include "palpate/base/elementary.h"
#include "palpate/tissue/fitting/force_fit.h"

namespace palpate::tissue {

namespace {

/// Values of a form's numbers, where descents begin.
std::vector<std::vector<double>> startValues(ForceForm form) {
  switch (form) {
    case ForceForm::power:
      return {{1.2}, {2.0}, {3.5}};
    case ForceForm::stiffening:
      return {{5.0, 12.0}, {2.0, 5.0}, {20.0, 20.0}, {0.5, 8.0}};
    case ForceForm::cubic:
      return {{0.2}, {0.8}};
    case ForceForm::linear:
    case ForceForm::measured:
      break;
  }
  return {{}};
}

ForceLaw::Kind kindOf(ForceForm form) {
  if (form == ForceForm::power) return ForceLaw::Kind::power;
  if (form == ForceForm::stiffening) return ForceLaw::Kind::stiffening;
  return form == ForceForm::linear ? ForceLaw::Kind::linear : ForceLaw::Kind::table;
}

}  // namespace

std::string_view nameOf(ForceForm form) {
  constexpr std::array<std::string_view, kForceForms.size()> kNames = {"linear", "power", "stiffening", "cubic",
                                                                       "measured"};
  return kNames.at(static_cast<std::size_t>(form));
}

double FormNumber::innerOf(double value) const { return logarithmic ? elementary::log(value) : value; }
double FormNumber::valueOf(double number) const { return logarithmic ? elementary::exp(number) : number; }

const std::vector<FormNumber>& numbersOf(ForceForm form) {
  static const std::vector<FormNumber> none;
  static const std::vector<FormNumber> power = {{"exponent", {0.3, 6.0}, false, &ForceLaw::exponent}};
  static const std::vector<FormNumber> stiffening = {
      {"stiffening_ratio", {elementary::log(0.05), elementary::log(100.0)}, true, &ForceLaw::stiffening_ratio},
      {"stiffening_depth_mm", {elementary::log(1.0), elementary::log(60.0)}, true, &ForceLaw::stiffening_depth_mm}};
  static const std::vector<FormNumber> cubic = {{"cubic_share", {0.0, 1.0}, false, nullptr}};
  switch (form) {
    case ForceForm::power:
      return power;
    case ForceForm::stiffening:
      return stiffening;
    case ForceForm::cubic:
      return cubic;
    case ForceForm::linear:
    case ForceForm::measured:
      break;
  }
  return none;
}

std::vector<Eigen::VectorXd> startsOf(ForceForm form) {
  std::vector<Eigen::VectorXd> starts;
  for (const std::vector<double>& values : startValues(form)) {
    Eigen::VectorXd& start = starts.emplace_back(static_cast<Eigen::Index>(values.size()));
    for (std::size_t i = 0; i < values.size(); ++i) {
      start[static_cast<Eigen::Index>(i)] = numbersOf(form)[i].innerOf(values[i]);
    }
  }
  return starts;
}

FormShape::FormShape(ForceForm form, const Eigen::VectorXd& inner) : form_(form) {
  law_.kind = kindOf(form);
  const std::vector<FormNumber>& numbers = numbersOf(form);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double value = numbers[i].valueOf(inner[static_cast<Eigen::Index>(i)]);
    if (numbers[i].member != nullptr) law_.*numbers[i].member = value;
    if (form == ForceForm::cubic) cubic_share_ = value;
  }
}

double FormShape::at(double depth_mm) const {
  if (form_ != ForceForm::cubic) return normalForce(law_, 1.0, depth_mm);
  if (!(depth_mm > 0.0)) return 0.0;
  const double share = depth_mm / kReferenceDepthMm;
  return depth_mm * (1.0 - cubic_share_ + cubic_share_ * share * share);
}

Eigen::ArrayXd FormShape::at(const Eigen::ArrayXd& depth_mm) const {
  return depth_mm.unaryExpr([this](double depth) { return at(depth); });
}

}  // namespace palpate::tissue
