// A block of trials: which change and which site come next, when it is over, its result. The one thing that differs
// between practice, test and examination is its settings.
//
//   BlockSettings, seed ─► Block ─ next ─► PlannedTrial ─ (an answer) ─► TrialOutcome ─ answer ─► Block ...
//   result
//
// Deterministic: the same settings, seed and outcomes give the same trials, also when the block was left and
// resumed (`state`, `resumed`). Knows no clock, no window and no body.
// Based on: marginal psi (marginal_psi.h); Levitt 1971 and Garcia-Perez 1998 (staircase.h); the mastery rule of the
// Virtual Haptic Back.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/words.h"
#include "palpate/training/posterior.h"
#include "palpate/training/stimulus.h"

namespace palpate::training {

enum class Method : std::uint8_t {
  marginal_psi,     ///< the most informative level about T
  two_down_one_up,  ///< practice: harder after two right answers, easier after a wrong one
  mastery,          ///< VHB: three of four at a level, then the next; a request is a level, never a threshold
  constant_levels,  ///< every level equally often, in drawn order
};

enum class SiteDraw : std::uint8_t {
  independent,  ///< each trial by itself: guessing stays exactly one in N
  balanced,     ///< shuffled rounds in which every site comes once
};

enum class TrialKind : std::uint8_t { warm_up, measured, easy };

struct StopRule {
  int least = 40;
  int most = 40;
  /// After `least`: enough when half the 95 % interval of ln T is narrower; 0: only the numbers count.
  double half_width = 0.0;
  /// An examination's pass mark: a change; 0: none. After `least`: enough when P(T < mark) is beyond `sure`. With
  /// `least` below `most`, marginal psi then asks for the most informative level about T < mark, instead of about T.
  double mark = 0.0;
  double sure = 0.95;
};

struct BlockSettings {
  Method method = Method::marginal_psi;
  ChangeMeaning meaning = ChangeMeaning::compliance;
  std::vector<double> levels = {};  ///< rising; empty: the method's own (adaptiveLevels, kVhbLevels)
  double start = 0.5;               ///< first level of the methods that walk
  int choices = 12;
  SiteDraw draw = SiteDraw::independent;
  int warm_up = 0;          ///< at first, at the top level; not counted
  int easy = 0;             ///< number of counted ones at the top level, spread out: they show lapses
  double easy_share = 0.0;  ///< instead of a number, of a walking method
  StopRule stop = {};       ///< counts measured trials, warm-up left out
  Prior prior = {};
};

struct PlannedTrial {
  int number = 0;  ///< from 1, warm-up included
  TrialKind kind = TrialKind::measured;
  double change = 0.0;
  int site = 0;  ///< site that hides it
};

struct TrialOutcome {
  int answer = 0;  ///< a site; 0: none came in time
  bool correct = false;
  int visited = 12;            ///< sites felt
  bool target_visited = true;  ///< else the trial is not counted: an untouched target cannot be found
};

enum class Verdict : std::uint8_t { none, pass, not_yet, repeat };

struct BlockResult {
  int trials = 0;                   ///< counted
  int correct = 0;                  ///< counted trials that were right
  int excluded = 0;                 ///< not counted: target never felt
  ThresholdSummary threshold;       ///< from all that counts, whatever the method
  std::optional<double> level;      ///< mastery: the smallest change that was mastered; none yet
  Verdict verdict = Verdict::none;  ///< with a pass mark, at the end
  double probability_below_mark = 0.0;
};

class Block {
 public:
  /// Throws Error for settings that make no sense, in words.
  Block(const BlockSettings& settings, std::uint64_t seed);
  ~Block();
  Block(Block&&) noexcept;
  Block& operator=(Block&&) noexcept;

  bool finished() const;
  /// The current trial; the same until it is answered. Not when it is finished.
  const PlannedTrial& next() const;
  void answer(const TrialOutcome& outcome);
  BlockResult result() const;
  const Posterior& posterior() const;
  const BlockSettings& settings() const;
  int answered() const;

  /// JSON: seed and outcomes so far. Settings are the protocol's.
  std::string state() const;
  /// Continues from `state`. Throws Error for text that cannot be read or does not fit the settings.
  static Block resumed(const BlockSettings& settings, std::string_view state);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate::training

template <>
struct palpate::WordsOf<palpate::training::Method> {
  using V = palpate::training::Method;
  static constexpr std::array kAll = {Word{"marginal_psi", V::marginal_psi},
                                      Word{"two_down_one_up", V::two_down_one_up}, Word{"mastery", V::mastery},
                                      Word{"constant_levels", V::constant_levels}};
};
template <>
struct palpate::WordsOf<palpate::training::SiteDraw> {
  using V = palpate::training::SiteDraw;
  static constexpr std::array kAll = {Word{"independent", V::independent}, Word{"balanced", V::balanced}};
};
template <>
struct palpate::WordsOf<palpate::training::TrialKind> {
  using V = palpate::training::TrialKind;
  static constexpr std::array kAll = {Word{"warm_up", V::warm_up}, Word{"measured", V::measured},
                                      Word{"easy", V::easy}};
};
template <>
struct palpate::WordsOf<palpate::training::Verdict> {
  using V = palpate::training::Verdict;
  static constexpr std::array kAll = {Word{"none", V::none}, Word{"pass", V::pass}, Word{"not_yet", V::not_yet},
                                      Word{"repeat", V::repeat}};
};
