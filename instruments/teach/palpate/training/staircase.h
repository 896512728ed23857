// Walks along a list of levels, as practice and the Virtual Haptic Back do instead of choosing the most informative
// level.
//
//   levels, start ─► Staircase, Mastery ─ change ─► trial ─ right or wrong ─► answer ─► change ...
//
// A staircase's levels hover where this number of right answers in a row is as likely as not: 70.7 % right for two,
// 79.4 % for three. That is not a threshold T (psychometric.h): among twelve places two in a row aim at 1.35 T, among
// two at 0.85 T. A block reports the posterior of its answers, whichever way its levels were walked.
// Levitt, J. Acoust. Soc. Am. 49:467, 1971; Kaernbach, Perception & Psychophysics 49:227, 1991 (unequal steps); the
// mastery rule of the Virtual Haptic Back (Howell et al. 2008).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace palpate::training {

/// The place in the list (rising, not empty) that is nearest to `change`, by ratio.
std::size_t nearestLevel(const std::vector<double>& levels, double change);

/// How a staircase walks. Steps are places in the list of levels.
struct StaircaseRule {
  int right_for_harder = 2;  ///< right answers in a row for a harder level
  std::size_t harder_steps = 1;
  std::size_t easier_steps = 1;
  int double_until = 2;  ///< steps are doubled before this many reversals
};

/// 2-down-1-up whose step is about 20 %: one place of the seven levels, two of the adaptive ones.
StaircaseRule twoDownOneUp(const std::vector<double>& levels);

class Staircase {
 public:
  /// `levels` rising.
  Staircase(std::vector<double> levels, double start, const StaircaseRule& rule);

  double change() const { return levels_[at_]; }
  void answer(bool right);
  /// The changes at which it turned.
  const std::vector<double>& reversals() const { return reversals_; }

 private:
  enum class Heading { none, harder, easier };
  void move(Heading heading, std::size_t steps);

  std::vector<double> levels_;
  StaircaseRule rule_;
  std::size_t at_;
  int right_in_row_ = 0;
  Heading heading_ = Heading::none;
  std::vector<double> reversals_;
};

/// Three of four at a level are mastery of it, and the next smaller change follows; after the second wrong one the next
/// larger. A level ends as soon as that is settled.
class Mastery {
 public:
  static constexpr int kRightToMaster = 3;
  static constexpr int kTrialsAtMost = 4;

  /// `levels` rising.
  Mastery(std::vector<double> levels, double start);

  double change() const { return levels_[at_]; }
  void answer(bool right);
  /// The smallest change that was mastered.
  std::optional<double> mastered() const { return mastered_; }
  /// There is nothing smaller to master.
  bool masteredAll() const { return mastered_ == levels_.front(); }
  /// Number of levels that were mastered or not since the beginning.
  int settled() const { return settled_; }

 private:
  std::vector<double> levels_;
  std::size_t at_;
  int right_ = 0;
  int wrong_ = 0;
  int settled_ = 0;
  std::optional<double> mastered_;
};

}  // namespace palpate::training
