#include "palpate/tissue/profile_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "palpate/base/error.h"
#include "palpate/tissue/profile.h"
#include "palpate/tissue/profile_forms.h"
#include "support/golden.h"

namespace palpate::tissue {

using test::goldenRows;

ProfileSettings ofKind(ProfileKind kind, ProfileRim rim = ProfileRim::lowered) {
  ProfileSettings settings;
  settings.kind = kind;
  settings.rim = rim;
  settings.lookup = TableLookup::linear;
  settings.knots = {{0.0, 1.0}, {0.2, 0.7}, {0.5, -0.1}, {0.7, -0.05}, {1.0, 0.0}};
  return settings;
}

const ProfileKind kAllKinds[] = {ProfileKind::half_gaussian, ProfileKind::table,     ProfileKind::sharp,
                                 ProfileKind::cosine,        ProfileKind::logarithm, ProfileKind::two_gaussians,
                                 ProfileKind::power,         ProfileKind::user};

TEST(ProfileCurve, DefaultIsTheProfileOfTheFastPath) {
  const ProfileCurve curve;
  for (double q = 0.0; q < 1.2; q += 0.001) {
    EXPECT_NEAR(curve.at(q).value, profile(q), 1e-15);
    const double slope = q < 1.0 ? -2.0 * kGaussianRate * q * (profile(q) + kProfileOffset) : 0.0;
    EXPECT_NEAR(curve.at(q).slope, slope, 1e-13);
  }
}

TEST(ProfileCurve, TakenLiterallyIsTheStoredTable) {
  const ProfileCurve literal(withFidelity({}, literalFidelity()));
  for (const auto& c : goldenRows("gaussian_table", "lookup")) {
    EXPECT_NEAR(literal.at(c["q"]).value, c["literal"], 1e-12) << c;
  }
}

TEST(ProfileCurve, WithItsStepIsTheContinuousReference) {
  const ProfileCurve step(ofKind(ProfileKind::half_gaussian, ProfileRim::step));
  for (const auto& c : goldenRows("gaussian_table", "lookup")) {
    EXPECT_NEAR(step.at(c["q"]).value, c["continuous"], 1e-12) << c;
  }
}

double worstError(const ProfileCurve& table) {
  const ProfileCurve exact(ofKind(ProfileKind::half_gaussian, ProfileRim::step));
  double worst = 0.0;
  for (int i = 0; i < 100000; ++i) {
    const double q = i / 100000.0;
    worst = std::max(worst, std::abs(table.at(q).value - exact.at(q).value));
  }
  return worst;
}

TEST(ProfileTable, NearestEntriesAreAsFarOffAsInTheReference) {
  const auto errors = test::golden("gaussian_table")["max_abs_error_nearest_vs_continuous"];
  for (const auto& [entries, error] : errors.items()) {
    ProfileSettings settings = withFidelity({}, literalFidelity());
    settings.table_entries = std::stoul(entries);
    EXPECT_NEAR(worstError(ProfileCurve(settings)), error, 1e-5) << entries;
  }
}

TEST(ProfileTable, HundredAndThirtyInterpolatedBeatSevenHundredNearest) {
  ProfileSettings settings = ofKind(ProfileKind::table, ProfileRim::step);
  settings.table_entries = 130;
  EXPECT_LT(worstError(ProfileCurve(settings)), 1e-4);
}

TEST(ProfileCurve, EveryKindRunsFromOneToZero) {
  for (const ProfileKind kind : kAllKinds) {
    const ProfileCurve curve(ofKind(kind));
    EXPECT_NEAR(curve.at(0.0).value, 1.0, 1e-15) << static_cast<int>(kind);
    EXPECT_NEAR(curve.at(1.0 - 1e-9).value, 0.0, 1e-8) << static_cast<int>(kind);
    for (const double q : std::initializer_list<double>{1.0, 1.5, INFINITY, NAN}) {
      EXPECT_EQ(curve.at(q).value, 0.0);
      EXPECT_EQ(curve.at(q).slope, 0.0);
    }
  }
}

TEST(ProfileCurve, SlopeIsTheDerivativeOfEveryKindAndRim) {
  constexpr double kStep = 1e-6;
  for (const ProfileKind kind : kAllKinds) {
    for (const ProfileRim rim : {ProfileRim::lowered, ProfileRim::step, ProfileRim::smooth}) {
      const ProfileCurve curve(ofKind(kind, rim));
      for (double q = 0.03137; q < 0.99; q += 0.0531) {
        const double expected = (curve.at(q + kStep).value - curve.at(q - kStep).value) / (2 * kStep);
        EXPECT_NEAR(curve.at(q).slope, expected, 1e-5 * (1.0 + std::abs(expected)))
            << static_cast<int>(kind) << " " << q;
      }
    }
  }
}

TEST(ProfileCurve, SmoothRimEndsLevel) {
  const ProfileCurve curve(ofKind(ProfileKind::half_gaussian, ProfileRim::smooth));
  EXPECT_NEAR(curve.at(1.0 - 1e-7).slope, 0.0, 1e-6);
  const ProfileCurve plain(ofKind(ProfileKind::half_gaussian, ProfileRim::step));
  EXPECT_EQ(curve.at(0.79).value, plain.at(0.79).value);
}

// Table 4.2: first derivatives at both ends, as far as a curve from 1 to 0 can have them.
TEST(ProfileCurve, HasTheEndsOfTable42) {
  const auto slope = [](ProfileKind kind, double q) { return ProfileCurve(ofKind(kind)).at(q).slope; };
  EXPECT_EQ(slope(ProfileKind::half_gaussian, 0.0), 0.0);
  EXPECT_NEAR(slope(ProfileKind::half_gaussian, 0.999999), 0.0, 0.03);
  EXPECT_EQ(slope(ProfileKind::cosine, 0.0), 0.0);
  EXPECT_NEAR(slope(ProfileKind::cosine, 0.999999), 0.0, 1e-5);
  EXPECT_LT(slope(ProfileKind::logarithm, 0.0), -20.0);
  EXPECT_NEAR(slope(ProfileKind::logarithm, 0.999999), 0.0, 0.25);
}

// Half a cosine is symmetric about its middle, half a Gaussian is not (Table 4.2, "non-symmetry").
TEST(ProfileCurve, OnlyTheCosineIsSymmetric) {
  const auto asymmetry = [](ProfileKind kind) {
    const ProfileCurve curve(ofKind(kind));
    return std::abs(curve.at(0.25).value + curve.at(0.75).value - 1.0);
  };
  EXPECT_LT(asymmetry(ProfileKind::cosine), 1e-12);
  EXPECT_GT(asymmetry(ProfileKind::half_gaussian), 0.2);
  EXPECT_GT(asymmetry(ProfileKind::logarithm), 0.2);
}

// Figure 4.4: what is left of the Gaussian beyond its inflection point, joined in the middle.
TEST(SharpProfile, IsTheGaussianBeyondItsInflectionPoint) {
  const ProfileCurve sharp(ofKind(ProfileKind::sharp, ProfileRim::step));
  const double sigma = 1.0 / std::sqrt(2.0 * std::numbers::pi);
  for (double x = sigma; x < 1.4; x += 0.01) {
    const double q = (x - sigma) / (1.4 - sigma);
    EXPECT_NEAR(sharp.at(q).value, halfGaussian(x / 1.4) / halfGaussian(sigma / 1.4), 1e-12);
  }
}

// "the first order ... from the contact point should be monotonic decreasing": the wall is steepest under the tip.
TEST(SharpProfile, GetsFlatterAllTheWayOut) {
  const ProfileCurve sharp(ofKind(ProfileKind::sharp));
  for (double q = 0.0; q < 0.98; q += 0.01) EXPECT_LT(sharp.at(q).slope, sharp.at(q + 0.01).slope);
  const ProfileCurve round;
  EXPECT_GT(round.at(0.0).slope, round.at(0.2).slope) << "under a round finger it is not";
}

TEST(TwoGaussians, NegativeWeightMakesABulgeAroundTheFinger) {
  const ProfileCurve curve(ofKind(ProfileKind::two_gaussians));
  double lowest = 0.0;
  for (double q = 0.0; q < 1.0; q += 0.001) lowest = std::min(lowest, curve.at(q).value);
  EXPECT_LT(lowest, -0.03) << "1 to 7 % of the depth";
  EXPECT_GT(lowest, -0.08);
}

// The heavy tail: a tenth of the drag where the half Gaussian has it, far more of it beyond.
TEST(PowerProfile, HasAHeavierTailThanTheGaussian) {
  const ProfileCurve power(ofKind(ProfileKind::power));
  const ProfileCurve gauss;
  EXPECT_NEAR(power.at(0.6115).value, 0.1, 0.005);
  EXPECT_GT(power.at(0.78).value, 2.0 * gauss.at(0.78).value);
  EXPECT_LT(power.at(0.2).value, gauss.at(0.2).value);
}

TEST(ProfileCurve, RefusesWhatIsNoCurve) {
  const auto fails = [](auto&& change) {
    ProfileSettings settings;
    change(settings);
    EXPECT_THROW(ProfileCurve{settings}, Error);
  };
  fails([](ProfileSettings& s) { s.table_entries = 1; });
  fails([](ProfileSettings& s) { s.two_gaussians.narrow = 0.0; });
  fails([](ProfileSettings& s) { s.power.exponent = NAN; });
  fails([](ProfileSettings& s) { s.kind = ProfileKind::user; });
}

TEST(RadialTerm, IsLargestAtItsWidthAndZeroAtBothEnds) {
  const RadialTerm term{0.08, 0.4};
  EXPECT_EQ(radialPull(term, 0.0).value, 0.0);
  EXPECT_NEAR(radialPull(term, 0.4).value, 0.08, 1e-15);
  EXPECT_NEAR(radialPull(term, 0.4).slope, 0.0, 1e-15);
  EXPECT_NEAR(radialPull(term, 1.0 - 1e-9).value, 0.0, 1e-9);
  EXPECT_EQ(radialPull(term, 1.0).value, 0.0);
  constexpr double kStep = 1e-6;
  for (double q = 0.05; q < 0.99; q += 0.043) {
    const double expected = (radialPull(term, q + kStep).value - radialPull(term, q - kStep).value) / (2 * kStep);
    EXPECT_NEAR(radialPull(term, q).slope, expected, 1e-8);
  }
}

}  // namespace palpate::tissue
