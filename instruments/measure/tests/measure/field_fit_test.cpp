#include "palpate/measure/field/field_fit.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <span>

#include "measure/tests/measure/drawn_dots.h"
#include "palpate/elements/drag_solver.h"
#include "palpate/measure/field/field_form.h"
#include "palpate/measure/field_report.h"
#include "palpate/measure/synthesis/true_field.h"
#include "palpate/tissue/solved_drag.h"

namespace palpate::measure {
namespace {

/// Dots of a sheet, moved by a field and a shift of the body.
std::vector<FieldDatum> dataOf(const std::function<Vec2(const Vec2&)>& motion, const Vec2& shift_mm = Vec2::Zero(),
                               double noise_mm = 0.0) {
  Random random(11);
  std::vector<FieldDatum> data;
  const DrawnSheet sheet;
  for (int row = 0; row < sheet.rows; ++row) {
    for (int column = 0; column < sheet.columns; ++column) {
      const Vec2 place = placeOf(sheet, column, row);
      const Vec2 noise = noise_mm * random.normal2();
      // The picture's y is down.
      const Mat2 flip = Vec2(1.0, -1.0).asDiagonal();
      data.push_back({place, motion(place) + flip * shift_mm + noise, flip * place, flip});
    }
  }
  return data;
}

TEST(FieldFit, FindsAHalfGaussianAgain) {
  const FittedField fitted = fitField(dataOf(drag(15.0, 90.0, 65.0, 30.0, {7.0, -11.0})), makeDriftPrior(0.4));
  const SkinField field = toSkinField(fitted.numbers);
  EXPECT_LT((field.contact_mm - Vec2(7.0, -11.0)).norm(), 0.3);
  EXPECT_LT((field.peak_mm - Vec2(0.0, 15.0)).norm(), 0.3);
  const LevelEllipse two = levelEllipse(field, 2.0);
  EXPECT_NEAR(two.half_major_mm, 90.0, 0.9);
  EXPECT_NEAR(two.half_minor_mm, 65.0, 0.7);
  EXPECT_NEAR(two.direction_rad * kDegPerRad, 30.0, 0.5);
}

TEST(FieldFit, FindsALongTailAgain) {
  const auto motion = [](const Vec2& p) { return Vec2(12.0 * std::pow(1.0 + p.squaredNorm() / 900.0, -0.7), 0.0); };
  const FittedField fitted = fitField(dataOf(motion), makeDriftPrior(0.4));
  // 12 (1 + r^2 / 900)^-0.7 = 2 mm
  const double expected = 30.0 * std::sqrt(std::pow(6.0, 1.0 / 0.7) - 1.0);
  const LevelEllipse two = levelEllipse(toSkinField(fitted.numbers), 2.0);
  EXPECT_NEAR(two.half_major_mm, expected, 0.04 * expected);
  EXPECT_NEAR(two.half_minor_mm, expected, 0.04 * expected);
}

TEST(FieldFit, TellsTheBodysShiftFromTheSkins) {
  const Vec2 shift(0.4, -0.3);  // right and down in the picture
  const FittedField fitted = fitField(dataOf(drag(15.0, 80.0, 60.0, 90.0), shift), makeDriftPrior(0.4));
  EXPECT_LT((fitted.numbers.segment<2>(kFirstDrift) - shift).norm(), 0.03);
  EXPECT_NEAR(levelEllipse(toSkinField(fitted.numbers), 2.0).half_major_mm, 80.0, 1.0);
}

TEST(FieldFit, HardlyMindsDotsThatAreWrong) {
  std::vector<FieldDatum> data = dataOf(drag(15.0, 80.0, 60.0, 0.0), Vec2::Zero(), 0.05);
  for (const std::size_t wrong : {43u, 53u, 63u, 73u}) data[wrong].moved_mm += Vec2(7.0, -4.0);  // beside the contact
  const SkinField field = toSkinField(fitField(data, makeDriftPrior(0.4)).numbers);
  EXPECT_LT(field.contact_mm.norm(), 1.5);
  EXPECT_LT((field.peak_mm - Vec2(0.0, 15.0)).norm(), 1.0);
  EXPECT_NEAR(levelEllipse(field, 2.0).half_major_mm, 80.0, 2.5);
}

TEST(FieldFit, ItsUncertaintyGrowsWithTheNoise) {
  const auto sd = [](double noise_mm) {
    const FittedField fitted =
        fitField(dataOf(drag(12.0, 80.0, 60.0, 20.0), Vec2::Zero(), noise_mm), makeDriftPrior(0.4));
    const WeighedField alone{fitted};
    return reportField(std::span(&alone, 1), Mat2::Identity(), makeDriftPrior(0.4)).at_2_mm.half_major_mm.sd;
  };
  EXPECT_GT(sd(0.8), 2.0 * sd(0.1));
  EXPECT_GT(sd(0.1), 0.1);
}

TEST(FieldFit, OfNothingThatMovesIsFiniteAndSmall) {
  const FittedField fitted = fitField(dataOf([](const Vec2&) { return Vec2(0.0, 0.0); }), makeDriftPrior(0.4));
  EXPECT_TRUE(fitted.numbers.allFinite());
  EXPECT_LT(toSkinField(fitted.numbers).peak_mm.norm(), 1.0);
}

TEST(FieldFit, FindsTheDriftAloneWhereNothingIsPressed) {
  const Vec2 shift(0.7, 0.2);
  const Eigen::Vector4d drift =
      fitDrift(dataOf([](const Vec2&) { return Vec2(0.0, 0.0); }, shift), makeDriftPrior(20.0));
  EXPECT_LT((drift.head<2>() - shift).norm(), 1e-3);
  EXPECT_LT(drift.tail<2>().norm(), 1e-3);
}

TEST(FieldForm, TheDerivativesOfEveryFormAreItsOwn) {
  for (const FieldForm form : {FieldForm::smooth, FieldForm::pointed, FieldForm::deep, FieldForm::solved}) {
    for (const double rho2 : {0.3, 2.2, 9.0, 70.0}) {
      SCOPED_TRACE(fmt::format("{} at {}", nameOf(form), rho2));
      const double step = 1e-5;
      const FormValue at = formAt(form, rho2, 0.71, 0.2);
      const auto slope = [&](const FormValue& more, const FormValue& less, double FormValue::*of) {
        return (more.*of - less.*of) / (2.0 * step);
      };
      const FormValue farther = formAt(form, rho2 + step, 0.71, 0.2);
      const FormValue nearer = formAt(form, rho2 - step, 0.71, 0.2);
      EXPECT_NEAR(slope(farther, nearer, &FormValue::round), at.round_by_rho2, 1e-6);
      EXPECT_NEAR(slope(farther, nearer, &FormValue::radial), at.radial_by_rho2, 1e-6);
      const FormValue longer = formAt(form, rho2, 0.71 + step, 0.2);
      const FormValue shorter = formAt(form, rho2, 0.71 - step, 0.2);
      EXPECT_NEAR(slope(longer, shorter, &FormValue::round), at.round_by_tail, 1e-6);
      EXPECT_NEAR(slope(longer, shorter, &FormValue::radial), at.radial_by_tail, 1e-6);
      const FormValue more = formAt(form, rho2, 0.71, 0.2 + step);
      const FormValue less = formAt(form, rho2, 0.71, 0.2 - step);
      EXPECT_NEAR(slope(more, less, &FormValue::round), at.round_by_sideways, 1e-6);
      EXPECT_NEAR(slope(more, less, &FormValue::radial), at.radial_by_sideways, 1e-6);
    }
  }
}

/// Layers that the solved form was not made of, dragged along x by 15 mm; the contact lies between four dots.
std::vector<FieldDatum> layeredData(const elements::DragField& field, const Vec2& contact) {
  return dataOf([&](const Vec2& p) { return Vec2(15.0 * field.movedAt(p - contact)); }, Vec2::Zero(), 0.05);
}

const elements::DragField& layeredField() {
  static const elements::DragField field =
      elements::solveDragField({.layers = {{"skin", 1.8, 200.0}, {"fat", 7.0, 12.0}, {"muscle", 25.0, 30.0}}}, {});
  return field;
}

TEST(FieldForms, OfLayersTheSolvedFormIsLikeliestAndItsSdHolds) {
  const Vec2 contact(0.0, 0.0);
  const std::vector<FieldDatum> data = layeredData(layeredField(), contact);
  const std::vector<WeighedField> forms = fitForms(data, makeDriftPrior(0.4));
  ASSERT_EQ(forms.front().fitted.form, FieldForm::solved);
  EXPECT_GT(forms.front().share, 0.9);
  FieldFit fit = reportField(forms, Mat2::Identity(), makeDriftPrior(0.4));
  const double unseen_sd = fit.at_4_mm.half_minor_mm.sd;
  widenByDots(data, forms.front().fitted.numbers, fit);
  EXPECT_FALSE(fit.peak_mm) << "no dot is in the core";
  EXPECT_GT(fit.at_4_mm.half_minor_mm.sd, unseen_sd) << "few dots lie within 4 mm";
  const TrueField truth(
      {.family = TailFamily::given, .contact_mm = contact, .peak_mm = 15.0, .given = [](const Vec2& p) {
         return Vec2(15.0 * layeredField().movedAt(p));
       }});
  const KeyEllipse& two = fit.at_2_mm;
  const KeyEllipse known = truth.ellipseAt(2.0);
  EXPECT_LT(std::abs(two.half_major_mm.value - known.half_major_mm.value), 2.0 * two.half_major_mm.sd);
  EXPECT_LT(std::abs(two.half_minor_mm.value - known.half_minor_mm.value), 2.0 * two.half_minor_mm.sd);
  EXPECT_LT(two.half_major_mm.sd, 0.08 * two.half_major_mm.value);
}

TEST(FieldForms, TheTableOfTheSolvedFormIsWhatTheSolverSaysOfItsStack) {
  constexpr std::size_t kStack = 1;
  const tissue::SolvedStack& stack = tissue::kSolvedStacks[kStack];
  const elements::DragField field = elements::solveDragField(
      {.layers = {{"skin", 2.0, stack.skin_kpa}, {"fat", stack.fat_mm, 10.0}, {"muscle", stack.muscle_mm, 27.0}}},
      {.patch_radius_mm = tissue::kSolvedPatchMm});
  const double tail = tissue::kSolvedLongestTail * kStack / (tissue::kSolvedStacks.size() - 1.0);
  for (std::size_t i = 0; i + 2 < tissue::kSolvedKnots; ++i) {
    const double r = tissue::solvedKnotMm(i);
    SCOPED_TRACE(r);
    const tissue::SolvedDrag drag =
        tissue::solvedDragAt(r * r / (tissue::kSolvedPatchMm * tissue::kSolvedPatchMm), tail);
    EXPECT_NEAR(drag.along, field.movedAt(Vec2(r, 0.0)).x(), 1e-4);
    EXPECT_NEAR(drag.across, field.movedAt(Vec2(0.0, r)).x(), 1e-4);
  }
}

TEST(FieldForms, OfAHalfSpaceTheDeepFormIsLikeliestAndItsSdHolds) {
  for (const double drag_deg : {10.0, 70.0, 130.0}) {
    SCOPED_TRACE(drag_deg);
    const TrueField truth({.family = TailFamily::half_space,
                           .contact_mm = {4.0, -6.0},
                           .peak_mm = 14.0,
                           .drag_rad = drag_deg / kDegPerRad,
                           .half_major_mm = 90.0});
    const std::vector<FieldDatum> data =
        dataOf([&](const Vec2& p) { return truth.displacementAt(p); }, Vec2(0.2, -0.2), 0.05);
    const std::vector<WeighedField> forms = fitForms(data, makeDriftPrior(0.4));
    EXPECT_EQ(forms.front().fitted.form, FieldForm::deep);
    FieldFit fit = reportField(forms, Mat2::Identity(), makeDriftPrior(0.4));
    widenByDots(data, forms.front().fitted.numbers, fit);
    const KeyEllipse known = truth.ellipseAt(2.0);
    EXPECT_LT(std::abs(fit.at_2_mm.half_major_mm.value - known.half_major_mm.value),
              2.0 * fit.at_2_mm.half_major_mm.sd);
    EXPECT_LT(std::abs(fit.at_2_mm.half_minor_mm.value - known.half_minor_mm.value),
              2.0 * fit.at_2_mm.half_minor_mm.sd);
    EXPECT_NEAR(fit.at_2_mm.half_major_mm.value, known.half_major_mm.value, 0.08 * known.half_major_mm.value);
  }
}

TEST(SkinField, AStickThatPressesMovesTheSkinOutwardsAllAround) {
  const double log_weight = -2.0 * std::log(20.0);
  const SkinField dragged{.log_shape = {log_weight, 0.0, log_weight}, .peak_mm = {0.0, 10.0}, .form = FieldForm::deep};
  SkinField both = dragged;
  both.pressed = {0.1, 0.3};
  for (const Vec2& place : {Vec2(20.0, 0.0), Vec2(0.0, 20.0), Vec2(-14.0, -14.0)}) {
    const Vec2 outwards = displacementAt(both, place) - displacementAt(dragged, place);
    EXPECT_NEAR(outwards.dot(place.normalized()), outwards.norm(), 1e-9);
  }
  // At one radius: 10 mm (0.1 / 2 + 0.3 / 2^1.5).
  EXPECT_NEAR((displacementAt(both, {20.0, 0.0}) - displacementAt(dragged, {20.0, 0.0})).x(), 0.5 + 3.0 / 2.8284271,
              1e-6);
}

TEST(FieldForms, AHalfGaussianIsNoneOfTheOthersAndItsPeakIsSeen) {
  const std::vector<FieldDatum> data = dataOf(drag(15.0, 80.0, 60.0, 30.0), Vec2::Zero(), 0.05);
  const std::vector<WeighedField> forms = fitForms(data, makeDriftPrior(0.4));
  ASSERT_EQ(forms.front().fitted.form, FieldForm::smooth);
  EXPECT_GT(forms.front().share, 0.99);
  FieldFit fit = reportField(forms, Mat2::Identity(), makeDriftPrior(0.4));
  widenByDots(data, forms.front().fitted.numbers, fit);
  ASSERT_TRUE(fit.peak_mm);
  EXPECT_NEAR(fit.peak_mm->value, 15.0, 0.3);
}

TEST(FieldForms, WhatTheyDifferByIsInTheSd) {
  const FittedField one = fitField(dataOf(drag(15.0, 80.0, 60.0, 30.0), Vec2::Zero(), 0.05), makeDriftPrior(0.4));
  FittedField wider = one;
  wider.numbers[2] -= 0.2;  // mean of ln W: every radius a tenth larger
  const std::vector<WeighedField> forms = {{one, 0.5}, {wider, 0.5}};
  const FieldFit alone = reportField(std::vector<WeighedField>{{one, 1.0}}, Mat2::Identity(), makeDriftPrior(0.4));
  const FieldFit both = reportField(forms, Mat2::Identity(), makeDriftPrior(0.4));
  const double before = alone.at_2_mm.half_major_mm.value;
  EXPECT_NEAR(both.at_2_mm.half_major_mm.value, 1.05 * before, 0.005 * before) << "their mean";
  EXPECT_GT(both.at_2_mm.half_major_mm.sd, 0.04 * before);
  EXPECT_LT(alone.at_2_mm.half_major_mm.sd, 0.02 * before);
}

TEST(LevelEllipse, OfAHalfGaussianIsItsClosedForm) {
  const double log_weight = -2.0 * std::log(50.0);
  const SkinField field{.log_shape = {log_weight, 0.0, log_weight}, .peak_mm = {0.0, 20.0}};
  EXPECT_NEAR(levelEllipse(field, 2.0).half_major_mm, 50.0 * std::sqrt(std::log(10.0)), 1e-9);
  EXPECT_EQ(levelEllipse(field, 25.0).half_major_mm, 0.0) << "nothing moves as far";
}

TEST(LevelEllipse, WithSidewaysMotionLiesWhereTheFieldHasItsLevel) {
  const double log_weight = -2.0 * std::log(40.0);
  const SkinField field{
      .log_shape = {log_weight, 0.0, log_weight}, .peak_mm = {0.0, 20.0}, .inverse_tail = 1.2, .sideways = 1.0};
  const LevelEllipse two = levelEllipse(field, 2.0);
  // The level line of a half space is no ellipse, but near one: round the ellipse the motion is the level on average.
  double sum = 0.0;
  for (int i = 0; i < 360; ++i) {
    const double angle = i * kRadPerDeg;
    const Vec2 place(two.half_minor_mm * std::cos(angle), two.half_major_mm * std::sin(angle));
    sum += displacementAt(field, place).norm() / 360.0;
    EXPECT_NEAR(displacementAt(field, place).norm(), 2.0, 0.25);
  }
  EXPECT_NEAR(sum, 2.0, 0.05);
  EXPECT_NEAR(std::abs(two.direction_rad * kDegPerRad), 90.0, 0.01) << "along the drag";
}

}  // namespace
}  // namespace palpate::measure
