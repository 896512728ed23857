// Posteriors against tools/check_posterior.py, which shares nothing with them, and what must hold for any.
#include "palpate/training/posterior.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "palpate/training/marginal_psi.h"
#include "palpate/training/psychometric.h"
#include "support/places.h"

namespace palpate::training {

namespace {

/// What an independent computation must agree to.
constexpr double kAgreement = 1e-9;

const nlohmann::json& computedElsewhere() {
  static const nlohmann::json read = [] {
    std::ifstream file(support::testData() / "training/posterior.json");
    return nlohmann::json::parse(file);
  }();
  return read;
}

Posterior posteriorFromJson(const nlohmann::json& sequence) {
  Posterior posterior(sequence["choices"].get<int>());
  for (const nlohmann::json& answer : sequence["answers"]) {
    posterior.add({.change = answer["change"].get<double>(),
                   .correct = answer["correct"].get<bool>(),
                   .choices = answer["choices"].get<int>()});
  }
  posterior.diffuse(sequence["diffusion"].get<double>());
  return posterior;
}

}  // namespace

TEST(Posterior, EqualsAnIndependentComputation) {
  ASSERT_GE(computedElsewhere()["sequences"].size(), 8u);
  for (const nlohmann::json& sequence : computedElsewhere()["sequences"]) {
    SCOPED_TRACE(sequence["name"].get<std::string>());
    const Posterior posterior = posteriorFromJson(sequence);
    const auto thresholds = sequence["threshold_weights"].get<std::vector<double>>();
    ASSERT_EQ(posterior.thresholdWeights().size(), thresholds.size());
    for (std::size_t i = 0; i < thresholds.size(); ++i) {
      EXPECT_NEAR(posterior.thresholdWeights()[i], thresholds[i], kAgreement);
    }
    const auto cells = sequence["every_37th_weight"].get<std::vector<double>>();
    ASSERT_EQ(posterior.weights().size(), 61u * 7u * 4u);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      EXPECT_NEAR(posterior.weights()[37 * i], cells[i], kAgreement);
    }
    const nlohmann::json& said = sequence["summary"];
    const ThresholdSummary summary = posterior.summary();
    EXPECT_NEAR(summary.low, said["low"].get<double>(), kAgreement);
    EXPECT_NEAR(summary.median, said["median"].get<double>(), kAgreement);
    EXPECT_NEAR(summary.high, said["high"].get<double>(), kAgreement);
    EXPECT_NEAR(summary.mean_ln, said["mean_ln"].get<double>(), kAgreement);
    EXPECT_NEAR(summary.sd_ln, said["sd_ln"].get<double>(), kAgreement);
    EXPECT_NEAR(posterior.probabilityBelow(sequence["mark"].get<double>()), said["below_mark"].get<double>(),
                kAgreement);
  }
}

TEST(Posterior, TellsWhatALevelIsWorthAsTheDefinitionDoes) {
  for (const nlohmann::json& sequence : computedElsewhere()["sequences"]) {
    SCOPED_TRACE(sequence["name"].get<std::string>());
    const Posterior posterior = posteriorFromJson(sequence);
    const auto levels = sequence["levels"].get<std::vector<double>>();
    const std::vector<double> told = MarginalPsi(levels, posterior).information(posterior);
    for (std::size_t i = 0; i < levels.size(); ++i) {
      EXPECT_NEAR(told[i], sequence["information"][i].get<double>(), kAgreement) << levels[i];
    }
  }
}

TEST(Posterior, KnowsTheIdealObserverAsAnIndependentComputationDoes) {
  for (const nlohmann::json& observer : computedElsewhere()["ideal_observers"]) {
    const int choices = observer["choices"].get<int>();
    EXPECT_NEAR(idealSlope(choices), observer["slope"].get<double>(), kAgreement) << choices;
    const double twelve = computedElsewhere()["ideal_observers"][4]["d_prime"].get<double>();
    EXPECT_NEAR(thresholdFactor(choices, 12), observer["d_prime"].get<double>() / twelve, kAgreement) << choices;
  }
}

TEST(Posterior, BelievesThePriorBeforeTheFirstAnswer) {
  const ThresholdSummary summary = Posterior().summary();
  EXPECT_NEAR(summary.median, 0.22, 1e-6);
  EXPECT_NEAR(summary.sd_ln, 0.8, 0.02);  // cut at three sd
  EXPECT_NEAR(Posterior().probabilityBelow(0.22), 0.5, 1e-6);
}

TEST(Posterior, DoesNotDependOnTheOrderOfAnswers) {
  const std::vector<Answer> answers = {{0.5, true, 12}, {0.2, false, 12}, {0.3, true, 9}, {0.1, false, 12}};
  Posterior forward;
  Posterior backward;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    forward.add(answers[i]);
    backward.add(answers[answers.size() - 1 - i]);
  }
  EXPECT_NEAR(forward.summary().median, backward.summary().median, 1e-12);
}

TEST(Posterior, LearnsNothingFromAnAnswerAmongOnePlace) {
  Posterior posterior;
  const std::vector<double> before = posterior.weights();
  posterior.add({.change = 0.1, .correct = true, .choices = 1});
  EXPECT_EQ(posterior.weights(), before);
}

TEST(Posterior, GrowsLessSureOvernightButNotElsewhere) {
  Posterior posterior;
  for (int i = 0; i < 40; ++i) posterior.add({.change = 0.2, .correct = i % 5 < 3, .choices = 12});
  const ThresholdSummary before = posterior.summary();
  posterior.diffuse(0.2);
  const ThresholdSummary after = posterior.summary();
  EXPECT_NEAR(after.sd_ln, std::hypot(before.sd_ln, 0.2), 0.01);
  EXPECT_NEAR(after.mean_ln, before.mean_ln, 1e-3);
  EXPECT_NEAR(std::accumulate(posterior.weights().begin(), posterior.weights().end(), 0.0), 1.0, 1e-12);
}

}  // namespace palpate::training
