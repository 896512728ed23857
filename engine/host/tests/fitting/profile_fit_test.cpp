// Shapes are judged by skin whose form is known, made here, and by solved layers.
#include "palpate/tissue/fitting/profile_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "palpate/tissue/user_profile.h"
#include "support/error_message.h"

namespace palpate::tissue {
namespace {

using Shape = std::function<double(double)>;

struct MadeSkin {
  double depth_mm = 6.0;
  double from_mm = 0.0;
  double step_mm = 0.5;
  double noise_mm = 0.0;
  unsigned seed = 1;

  SkinProfile like(const Shape& down, const Shape& outward = {}) const {
    std::mt19937 engine(seed);
    std::normal_distribution<double> normal;
    SkinProfile profile;
    profile.depth_mm = depth_mm;
    for (double r = from_mm; r <= 60.0; r += step_mm) {
      profile.radius_mm.push_back(r);
      profile.down_mm.push_back(depth_mm * down(r) + noise_mm * normal(engine));
      if (outward) profile.outward_mm.push_back(outward(r));
    }
    return profile;
  }
};

double halfGaussianOf(double r, double radius) {
  return std::exp(-3.14159265358979 * 1.96 * r * r / (radius * radius));
}

double bulging(double r) { return 1.2 * std::exp(-r * r / 64.0) - 0.2 * std::exp(-r * r / 400.0); }

TEST(ProfileFit, FindsTheNumbersThatMadeTheSkin) {
  const ProfileFit half =
      fitProfile(MadeSkin{}.like([](double r) { return halfGaussianOf(r, 21.0); }), ProfileForm::half_gaussian);
  EXPECT_NEAR(half.numbers.at(0).value, 21.0, 1e-4);
  EXPECT_NEAR(half.surface_mm, 6.0, 1e-4);
  EXPECT_LT(half.rms, 1e-6);
  const ProfileFit tail =
      fitProfile(MadeSkin{}.like([](double r) { return std::pow(1.0 + r * r / 81.0, -0.8); }), ProfileForm::power_tail);
  EXPECT_NEAR(tail.numbers.at(0).value, 9.0, 1e-3);
  EXPECT_NEAR(tail.numbers.at(1).value, 0.8, 1e-4);
  const ProfileFit two = fitProfile(MadeSkin{}.like(bulging), ProfileForm::two_gaussians);
  EXPECT_NEAR(two.numbers.at(0).value, 8.0, 0.01);
  EXPECT_NEAR(two.numbers.at(1).value, 20.0, 0.02);
  EXPECT_NEAR(two.numbers.at(2).value, -0.2, 1e-3);
  EXPECT_LT(two.rms, 1e-5);
}

TEST(ProfileFit, FindsThemUnderNoise) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const MadeSkin skin{.noise_mm = 0.15, .seed = seed};
    const ProfileFit fit =
        fitProfile(skin.like([](double r) { return halfGaussianOf(r, 21.0); }), ProfileForm::half_gaussian);
    EXPECT_NEAR(fit.numbers.at(0).value, 21.0, 0.7);
    EXPECT_NEAR(fit.numbers.at(0).value, 21.0, 4.0 * fit.numbers.at(0).standard_error);
    EXPECT_NEAR(fit.rms, 0.15 / 6.0, 0.008);
  }
}

TEST(ProfileFit, TellsAFormThatCannotFollow) {
  const ProfileFit half = fitProfile(MadeSkin{}.like(bulging), ProfileForm::half_gaussian);
  EXPECT_GT(half.rms, 0.02);
  EXPECT_GT(half.largest_miss, half.rms);
}

TEST(ProfileFit, SkinHiddenUnderTheIndenterTouchesIt) {
  const SkinProfile hidden = MadeSkin{.from_mm = 9.0}.like(bulging);
  const ProfileFit fit = fitProfile(hidden, ProfileForm::two_gaussians);
  EXPECT_FALSE(fit.surface_measured);
  EXPECT_EQ(fit.surface_mm, 6.0);
  EXPECT_NEAR(downShare(fit, 4.0), bulging(4.0), 0.02) << "foretold";
  EXPECT_TRUE(fitProfile(MadeSkin{.from_mm = 1.5}.like(bulging), ProfileForm::two_gaussians).surface_measured);
}

TEST(ProfileFit, FollowsSidewaysMotion) {
  const auto outward = [](double r) {
    return 0.4 * r / 4.0 * std::exp(-r * r / 32.0) - 0.5 * r / 12.0 * std::exp(-r * r / 288.0);
  };
  for (const ProfileForm form : {ProfileForm::two_gaussians, ProfileForm::measured}) {
    const ProfileFit fit = fitProfile(MadeSkin{}.like(bulging, outward), form);
    ASSERT_TRUE(fit.vector_rms.has_value());
    EXPECT_LT(*fit.vector_rms, 2e-3) << nameOf(form);
    for (const double r : {0.0, 3.0, 7.0, 20.0}) {
      EXPECT_NEAR(fit.surface_mm * outwardShare(fit, r), outward(r), 0.02) << nameOf(form) << " " << r;
    }
  }
  EXPECT_FALSE(fitProfile(MadeSkin{}.like(bulging), ProfileForm::measured).vector_rms.has_value());
}

TEST(ProfileFit, ChoosesByPlacesThatItHasNotSeen) {
  const auto chosen = [](const SkinProfile& profile) {
    std::vector<std::vector<ProfileFit>> fits(1);
    for (const ProfileForm form : kProfileForms) fits[0].push_back(fitProfile(profile, form));
    return bestForm(fits);
  };
  const auto half = [](double r) { return halfGaussianOf(r, 21.0); };
  EXPECT_EQ(chosen(MadeSkin{.noise_mm = 0.1}.like(half)), ProfileForm::half_gaussian);
  EXPECT_EQ(chosen(MadeSkin{.noise_mm = 0.05}.like(bulging)), ProfileForm::two_gaussians);
  const auto waves = [](double r) { return std::cos(0.3 * r) * std::exp(-0.03 * r); };
  EXPECT_EQ(chosen(MadeSkin{}.like(waves)), ProfileForm::measured);
}

TEST(ProfileFit, MakesShapesThatATableTakes) {
  LayeredTable table;
  table.radii_mm = tableRadii(60.0);
  for (const double depth : {2.0, 6.0}) {
    const SkinProfile profile = MadeSkin{.depth_mm = depth}.like(bulging, [](double r) { return 0.01 * r; });
    table.shapes.push_back(shapeOf(fitProfile(profile, ProfileForm::measured), table.radii_mm));
  }
  EXPECT_EQ(support::thrownMessage([&] { check(table); }), "no error");
  EXPECT_EQ(table.radii_mm.front(), 0.0);
  EXPECT_EQ(table.radii_mm.back(), 60.0);
  for (std::size_t i = 0; i < table.radii_mm.size(); ++i) {
    EXPECT_NEAR(table.shapes[1].down[i], bulging(table.radii_mm[i]), 1e-3);
  }
}

TEST(ProfileFit, OneCurveServesSkinThatOnlyGrowsWider) {
  LayeredTable table;
  table.radii_mm = tableRadii(100.0);
  for (const double depth : {2.0, 5.0, 10.0}) {
    PressedShape shape{.depth_mm = depth, .surface_mm = depth, .down = {}, .outward = {}};
    for (const double r : table.radii_mm) shape.down.push_back(halfGaussianOf(r, 12.0 + 1.5 * depth));
    table.shapes.push_back(shape);
  }
  const SharedProfile shared = sharedProfile(table.radii_mm, table.shapes);
  EXPECT_LT(shared.rms, 0.01);
  EXPECT_NEAR(shared.radius_mm, 2.0 * 12.0, 2.0);
  EXPECT_NEAR(shared.radius_per_depth, 2.0 * 1.5, 0.3);
  EXPECT_EQ(support::thrownMessage([&] { checkProfileKnots(shared.knots); }), "no error");
}

TEST(ProfileFit, RefusesPlacesThatTellNothing) {
  const auto fault = [](const SkinProfile& profile) {
    return support::thrownMessage([&] { fitProfile(profile, ProfileForm::half_gaussian); });
  };
  EXPECT_EQ(fault({2.5, {0, 0, 1, 2, 3, 4}, {1, 1, 1, 1, 1, 1}, {}}),
            "depth 2.5 mm: 5 different radii; at least 6 are required");
  EXPECT_EQ(fault({2.5, {0, 1, 2, 3, 4, 5}, {0, 0, -1, 0, 0, 0}, {}}),
            "depth 2.5 mm: the skin is not pressed down at any radius");
  EXPECT_EQ(fault({2.5, {0, 1, 2, 3, 4, 5}, {-1, 0, 1, 0, 0, 0}, {}}),
            "depth 2.5 mm: the skin is not pressed down at the centre");
}

TEST(SkinProfiles, AreReadByDepthAndRadius) {
  const auto profiles =
      parseSkinProfiles("r_mm,depth_mm,who,down_mm,outward_mm\n4,5,x,1,-0.1\n0,5,x,5,0\n2,2,x,1.5,0.05\n", "p.csv");
  ASSERT_EQ(profiles.size(), 2u);
  EXPECT_EQ(profiles[0].depth_mm, 2.0);
  EXPECT_EQ(profiles[1].radius_mm, (std::vector<double>{0, 4}));
  EXPECT_EQ(profiles[1].down_mm, (std::vector<double>{5, 1}));
  EXPECT_EQ(profiles[1].outward_mm, (std::vector<double>{0, -0.1}));
  EXPECT_TRUE(parseSkinProfiles("depth_mm,r_mm,down_mm\n1,0,1\n", "p.csv")[0].outward_mm.empty());
}

TEST(SkinProfiles, NameTheLineThatIsWrong) {
  const auto fault = [](const std::string& text) {
    return support::thrownMessage([&] { parseSkinProfiles(text, "p.csv"); });
  };
  EXPECT_EQ(fault("1,2,3\n"), "p.csv:1: the header has no column depth_mm");
  EXPECT_EQ(fault("depth_mm,r_mm,down_mm\n1,0,1\n1,-2,1\n"), "p.csv:3: r_mm = -2 is out of range: 0 to 10,000");
  EXPECT_EQ(fault("depth_mm,r_mm,down_mm\n1,0\n"), "p.csv:2: found 2 fields; expected 3");
  EXPECT_EQ(fault("depth_mm,r_mm,down_mm\n"), "p.csv: has no rows; expected depth_mm,r_mm,down_mm");
}

}  // namespace
}  // namespace palpate::tissue
