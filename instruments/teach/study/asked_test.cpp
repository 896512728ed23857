#include "teach/study/asked_test.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "palpate/base/background.h"
#include "palpate/base/random.h"
#include "palpate/training/block.h"
#include "palpate/training/staircase.h"

namespace palpate::study {

using training::adaptiveLevels;
using training::Answer;
using training::Block;
using training::BlockSettings;
using training::ChangeMeaning;
using training::kVhbLevels;
using training::Mastery;
using training::Posterior;
using training::Psychometric;
using training::Staircase;
using training::StaircaseRule;

namespace {

/// Below this an answer is as good as impossible, and its logarithm is left out.
constexpr double kNoProbability = 1e-12;

int choiceCount(const Psychometric& trainee) { return static_cast<int>(std::lround(1.0 / trainee.guess)); }

std::vector<double> vhbRising() { return {kVhbLevels.rbegin(), kVhbLevels.rend()}; }

/// Chooses the most informative level about threshold, slope and lapse rate together, as QUEST+ does.
class JointPsi {
 public:
  JointPsi(std::vector<double> levels, const Posterior& like) : levels_(std::move(levels)) {
    for (const double level : levels_) {
      for (const double ln_t : like.lnThresholds()) {
        for (const double slope : like.slopes()) {
          for (const double lapse : like.lapses()) {
            const double right =
                training::probabilityCorrect({std::exp(ln_t), slope, lapse, 1.0 / like.choices()}, level);
            right_.push_back(right);
            left_.push_back(entropy(right));
          }
        }
      }
    }
  }
  double best(const Posterior& posterior) const {
    const std::size_t cells = posterior.weights().size();
    std::size_t best = 0;
    double most = -1.0;
    for (std::size_t level = 0; level < levels_.size(); ++level) {
      double right = 0.0;
      double left = 0.0;
      for (std::size_t i = 0; i < cells; ++i) {
        right += posterior.weights()[i] * right_[level * cells + i];
        left += posterior.weights()[i] * left_[level * cells + i];
      }
      if (entropy(right) - left > most + kNoProbability) {
        most = entropy(right) - left;
        best = level;
      }
    }
    return levels_[best];
  }

 private:
  static double entropy(double p) {
    const double q = 1.0 - p;
    return (p > kNoProbability ? -p * std::log(p) : 0.0) + (q > kNoProbability ? -q * std::log(q) : 0.0);
  }
  std::vector<double> levels_;
  std::vector<double> right_;
  std::vector<double> left_;
};

/// A trainee answers.
class Answering {
 public:
  Answering(const Psychometric& trainee, std::uint64_t seed) : trainee_(trainee), random_(seed ^ 0x5bd1e995u) {}
  Answer answer(double change) {
    return {change, random_.uniform() < training::probabilityCorrect(trainee_, change), choiceCount(trainee_)};
  }

 private:
  Psychometric trainee_;
  Random random_;
};

AskedTest askedByBlock(const BlockSettings& settings, Answering& trainee, std::uint64_t seed) {
  AskedTest test;
  Block block(settings, seed);
  while (!block.finished()) {
    test.answers.push_back(trainee.answer(block.next().change));
    block.answer({.answer = 1, .correct = test.answers.back().correct, .visited = settings.choices});
  }
  return test;
}

AskedTest askedByStaircase(const StaircaseRule& rule, Answering& trainee, int trials) {
  AskedTest test;
  Staircase staircase(adaptiveLevels(ChangeMeaning::compliance), BlockSettings{}.start, rule);
  for (int i = 0; i < trials; ++i) {
    test.answers.push_back(trainee.answer(staircase.change()));
    staircase.answer(test.answers.back().correct);
  }
  test.reversals = staircase.reversals();
  return test;
}

AskedTest askedByMastery(Answering& trainee, int trials) {
  AskedTest test;
  Mastery mastery(vhbRising(), BlockSettings{}.start);
  double before = 0.0;
  bool failed = false;
  for (int i = 0; i < trials; ++i) {
    const int settled = mastery.settled();
    test.answers.push_back(trainee.answer(mastery.change()));
    mastery.answer(test.answers.back().correct);
    const double now = mastery.mastered().value_or(0.0);
    if (!failed && mastery.settled() > settled && now == before) {
      failed = true;
      test.first_failed = now;
    }
    before = now;
  }
  test.level = before;
  if (!failed) test.first_failed = before;
  return test;
}

/// Tests at `place` of the posterior.
template <class Place>
AskedTest askedByPosterior(const Place& place, Answering& trainee, int trials, int choices) {
  AskedTest test;
  Posterior posterior(choices);
  for (int i = 0; i < trials; ++i) {
    test.answers.push_back(trainee.answer(place(posterior)));
    posterior.add(test.answers.back());
  }
  return test;
}

}  // namespace

std::string nameOf(AskedBy method) {
  switch (method) {
    case AskedBy::marginal_psi:
      return "marginal psi";
    case AskedBy::marginal_psi_vhb:
      return "marginal psi, seven levels";
    case AskedBy::quest:
      return "QUEST (posterior mean)";
    case AskedBy::joint_psi:
      return "psi, all parameters";
    case AskedBy::two_down:
      return "2-down-1-up + posterior";
    case AskedBy::three_down:
      return "3-down-1-up + posterior";
    case AskedBy::weighted:
      return "weighted 75 % + posterior";
    case AskedBy::constant:
      return "constant levels + posterior";
    case AskedBy::mastery:
      return "mastery + posterior";
  }
  return {};
}

AskedTest askedTest(AskedBy method, const Psychometric& trainee, int trials, std::uint64_t seed) {
  Answering answering(trainee, seed);
  const int choices = choiceCount(trainee);
  BlockSettings settings{.choices = choices, .stop = {trials, trials}};
  const std::vector<double> levels = adaptiveLevels(ChangeMeaning::compliance);
  switch (method) {
    case AskedBy::marginal_psi:
      return askedByBlock(settings, answering, seed);
    case AskedBy::marginal_psi_vhb:
      settings.levels = vhbRising();
      return askedByBlock(settings, answering, seed);
    case AskedBy::constant:
      settings.method = training::Method::constant_levels;
      return askedByBlock(settings, answering, seed);
    case AskedBy::two_down:
      return askedByStaircase(training::twoDownOneUp(levels), answering, trials);
    case AskedBy::three_down:
      return askedByStaircase({.right_for_harder = 3, .harder_steps = 2, .easier_steps = 2}, answering, trials);
    case AskedBy::weighted:
      return askedByStaircase({.right_for_harder = 1, .harder_steps = 1, .easier_steps = 3}, answering, trials);
    case AskedBy::mastery:
      return askedByMastery(answering, trials);
    case AskedBy::quest:
      return askedByPosterior(
          [&](const Posterior& posterior) {
            return levels[training::nearestLevel(levels, std::exp(posterior.summary().mean_ln))];
          },
          answering, trials, choices);
    case AskedBy::joint_psi:
      break;
  }
  const Posterior before(choices);
  const JointPsi psi(levels, before);
  return askedByPosterior([&](const Posterior& posterior) { return psi.best(posterior); }, answering, trials, choices);
}

Psychometric usualTrainee(double threshold, int choices) {
  return {.threshold = threshold, .slope = choices == 2 ? 1.24 : 1.8, .lapse = 0.02, .guess = 1.0 / choices};
}

Posterior posteriorAfter(const std::vector<Answer>& answers, int choices) {
  Posterior posterior(choices);
  for (const Answer& answer : answers) posterior.add(answer);
  return posterior;
}

void parallelFor(std::size_t count, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  const auto run_pieces = [&] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  if (processors() < 2) return run_pieces();
  Background beside(run_pieces);
  try {
    run_pieces();
  } catch (...) {
    next = count;  // the other ends after its piece
    throw;
  }
  beside.join();
}

std::uint64_t runSeed(std::uint64_t seed, std::uint64_t cell, std::size_t i) {
  Random mixed(seed * 0x2545f4914f6cdd1dull + cell * 0x9e3779b1ull + i);
  mixed.bits();
  return mixed.bits();
}

}  // namespace palpate::study
