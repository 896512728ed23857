#include "palpate/training/staircase.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpate::training {

namespace {

/// The intended step of practice, as a ratio of changes.
constexpr double kWantedStep = 1.2;

}  // namespace

std::size_t nearestLevel(const std::vector<double>& levels, double change) {
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < levels.size(); ++i) {
    if (std::abs(std::log(levels[i] / change)) < std::abs(std::log(levels[nearest] / change))) nearest = i;
  }
  return nearest;
}

StaircaseRule twoDownOneUp(const std::vector<double>& levels) {
  if (levels.size() < 2) return {};
  const double ln_place = std::log(levels.back() / levels.front()) / static_cast<double>(levels.size() - 1);
  const auto steps = static_cast<std::size_t>(std::max(1.0, std::round(std::log(kWantedStep) / ln_place)));
  return {.harder_steps = steps, .easier_steps = steps};
}

Staircase::Staircase(std::vector<double> levels, double start, const StaircaseRule& rule)
    : levels_(std::move(levels)), rule_(rule), at_(nearestLevel(levels_, start)) {}

void Staircase::answer(bool right) {
  if (!right) {
    right_in_row_ = 0;
    move(Heading::easier, rule_.easier_steps);
  } else if (++right_in_row_ == rule_.right_for_harder) {
    right_in_row_ = 0;
    move(Heading::harder, rule_.harder_steps);
  }
}

void Staircase::move(Heading heading, std::size_t steps) {
  if (heading_ != Heading::none && heading != heading_) reversals_.push_back(change());
  heading_ = heading;
  if (std::cmp_less(reversals_.size(), rule_.double_until)) steps *= 2;
  at_ = heading == Heading::easier ? std::min(at_ + steps, levels_.size() - 1) : at_ - std::min(at_, steps);
}

Mastery::Mastery(std::vector<double> levels, double start)
    : levels_(std::move(levels)), at_(nearestLevel(levels_, start)) {}

void Mastery::answer(bool right) {
  ++(right ? right_ : wrong_);
  const bool passed = right_ == kRightToMaster;
  const bool failed = wrong_ > kTrialsAtMost - kRightToMaster;
  if (!passed && !failed) return;
  if (passed) {
    mastered_ = std::min(change(), mastered_.value_or(change()));
    at_ -= std::min<std::size_t>(at_, 1);
  } else {
    at_ = std::min(at_ + 1, levels_.size() - 1);
  }
  right_ = wrong_ = 0;
  ++settled_;
}

}  // namespace palpate::training
