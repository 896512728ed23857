// The numbers of a skin field, found from how the dots moved: thirteen wanted ones, and ten nuisance ones for how else
// the stick pressed and how the body bent between the pictures.
//
//   dots on the chart ─ fitField ─► FittedField ─ reportField (field_report.h) ─► ellipses, contact, peak with their sd
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/measure/field/skin_field.h"

namespace palpate::measure {

/// A dot as the fit sees it.
struct FieldDatum {
  Vec2 skin_mm = Vec2::Zero();
  Vec2 moved_mm = Vec2::Zero();
  /// From the middle of the dots, in the picture, in mm of the middle of the picture.
  Vec2 picture_mm = Vec2::Zero();
  /// Skin's mm for the picture's mm here: identity where the skin is seen square on.
  Mat2 to_skin = Mat2::Identity();
};

/// Order of the unknowns: contact x, y; mean logarithm of the shape and its two deviators; peak x, y; 1/P; kappa;
/// pressed, far and near; drift in the picture: right, down (mm), scale, turn (mm per 100 mm); then its bends: stretch
/// and shear (mm per 100 mm), and the squares x^2, xy, y^2 of motions to the right and down (mm per (100 mm)^2).
inline constexpr int kFieldUnknowns = 23;
inline constexpr int kFirstDrift = 11;
inline constexpr int kFirstBend = 15;
using FieldNumbers = Eigen::Matrix<double, kFieldUnknowns, 1>;
using FieldCovariance = Eigen::Matrix<double, kFieldUnknowns, kFieldUnknowns>;

SkinField toSkinField(const FieldNumbers& numbers, FieldForm form = FieldForm::smooth);
/// Motion of the skin by drift, mm, at a dot.
Vec2 driftAt(const FieldNumbers& numbers, const FieldDatum& datum);

struct DriftPrior {
  double shift_mm = 0.4;
  double scale = 0.08;  ///< mm per 100 mm
  double turn = 0.15;   ///< mm per 100 mm
};
/// Proportions of a held breath.
DriftPrior makeDriftPrior(double drift_mm);

struct FittedField {
  FieldForm form = FieldForm::smooth;
  FieldNumbers numbers = FieldNumbers::Zero();
  FieldCovariance covariance = FieldCovariance::Zero();
  std::vector<double> residuals_mm;  ///< one a datum: length of measured less fitted
};

/// Robust least squares from four starts, of the smooth form. Needs 12 data or more; allocates once. Never throws; what
/// it cannot fit has large residuals or a large covariance.
FittedField fitField(std::span<const FieldDatum> data, const DriftPrior& prior);

/// A form and how much it counts.
struct WeighedField {
  FittedField fitted;
  double share = 1.0;
};

/// Every form, likeliest first, shares that sum to 1; without those that explain the dots much worse. Takes four times
/// as long as fitField.
std::vector<WeighedField> fitForms(std::span<const FieldDatum> data, const DriftPrior& prior);

/// The drift alone, of pictures where nothing is pressed: right and down, mm; scale and turn, mm per 100 mm.
Eigen::Vector4d fitDrift(std::span<const FieldDatum> data, const DriftPrior& prior);

}  // namespace palpate::measure
