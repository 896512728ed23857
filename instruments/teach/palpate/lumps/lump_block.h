// Bodies with and without lumps, one after the other, and the answers about each: drawn from a seed, so that a block
// that was interrupted continues where it stopped.
//
//   settings, seed ─► hidden() ─ felt ─► question() ─ answer ─► ... ─► result(), state()
//
// Practice hides one lump or none and walks along the cue: C (lump_observer.h) falls after two lumps in a row that were
// found and rises after one that was not. An examination hides 18 lumps in six bodies. One thread.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/base/words.h"
#include "palpate/lumps/lump_task.h"

namespace palpate::lumps {

/// Grades count from 0: the smallest, the least deep, the softest of LumpTask.
struct HiddenLump {
  Vec2 place_mm = Vec2::Zero();  ///< position of the skin over it, on the map plane (x right, y up)
  int size = 0;
  int depth = 0;
  int hardness = 0;
  bool mobile = false;
  double cue = 0.0;  ///< C of a firm press right over it
  friend bool operator==(const HiddenLump&, const HiddenLump&) = default;
};

/// A trainee's statement about a lump: where, and which kind.
struct LumpFinding {
  static constexpr int kUnsaid = -1;
  std::optional<Vec2> place_mm = {};
  int size = kUnsaid;
  int depth = kUnsaid;
  int hardness = kUnsaid;
  int mobile = kUnsaid;  ///< 0 fixed, 1 mobile
  friend bool operator==(const LumpFinding&, const LumpFinding&) = default;
};

/// One body and all answers about it.
struct LumpTrial {
  std::vector<HiddenLump> hidden;
  std::vector<LumpFinding> findings;
  bool over = false;
  bool timed_out = false;
  friend bool operator==(const LumpTrial&, const LumpTrial&) = default;
};

/// A finding with the number of its lump in LumpTrial::hidden, and the distance between them.
struct MatchedFinding {
  std::optional<std::size_t> lump = {};
  std::optional<double> error_mm = {};  ///< to the nearest lump; nothing without lumps
};
/// Each lump belongs to the nearest finding within LumpTask::hitMm that belongs to no nearer lump.
std::vector<MatchedFinding> matchFindings(const LumpTrial& trial, const LumpTask& task);
/// Everything there was found, and nothing else.
bool isRight(const LumpTrial& trial, const LumpTask& task);

enum class LumpQuestion : std::uint8_t {
  there,     ///< is there a lump? yes 1, no 0
  place,     ///< where? In an examination also "no more"
  size,      ///< 0, 1, 2
  depth,     ///< 0, 1, 2
  hardness,  ///< 0, 1, 2
  mobile,    ///< fixed 0, mobile 1
  none,      ///< the body is done
};

/// C that is found half the time, and the middle 95 % of the posterior.
struct CueThreshold {
  double median = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// Counts of a block; of practice and examinations alike.
struct LumpCounts {
  int bodies = 0;          ///< finished
  int with = 0;            ///< finished bodies that hide something
  int without = 0;         ///< finished bodies without lumps
  int said_with = 0;       ///< hits: answered "there is one" where there is
  int said_without = 0;    ///< false alarms: answered "there is one" where there is none
  int lumps = 0;           ///< hidden in finished bodies
  int found = 0;           ///< lumps found
  int false_places = 0;    ///< places named without a lump
  bool passed = false;     ///< an examination's marks are met
  CueThreshold threshold;  ///< over the lumps so far; zeros without any
};
LumpCounts countLumps(const std::vector<LumpTrial>& trials, const LumpTask& task);

/// Limits the places named in one body: naming every place is not finding.
inline constexpr std::size_t kMaxFindings = 12;

struct LumpBlockSettings {
  LumpTask task;
  bool exam = false;
  std::vector<Vec2> places = {};                         ///< where a lump may be
  std::function<double(const HiddenLump&)> cue_of = {};  ///< C; asked once for each lump, and once for each kind
};

class LumpBlock {
 public:
  /// Throws Error if the lumps of an examination do not fit.
  LumpBlock(LumpBlockSettings settings, std::uint64_t seed);
  /// Continues from `state()`, with the body that was felt then. Throws Error if `state` cannot be read.
  static LumpBlock resumed(LumpBlockSettings settings, std::string_view state);

  bool finished() const;
  int number() const { return static_cast<int>(trials_.size()); }  ///< number of the current body, from 1
  int bodies() const { return settings_.exam ? kExamBodies : settings_.task.bodies; }
  const LumpTrial& trial() const { return trials_.back(); }  ///< the current one, or the last
  LumpQuestion question() const;
  /// False: the question takes another answer.
  bool answer(int choice);
  bool answer(const Vec2& place_mm);
  bool noMore();  ///< ends the current body of an examination
  /// After a body that is done, unless that was the last.
  void next();

  const std::vector<LumpTrial>& trials() const { return trials_; }
  const LumpBlockSettings& settings() const { return settings_; }
  LumpCounts counts() const { return countLumps(trials_, settings_.task); }
  std::string state() const;

 private:
  LumpBlock() = default;
  void draw();
  void drawPractice(LumpTrial& trial, std::uint64_t number);
  void drawExam(LumpTrial& trial);
  double aimedLnCue() const;
  const std::vector<double>& logCuesByKind();

  LumpBlockSettings settings_;
  std::uint64_t seed_ = 1;
  std::vector<LumpTrial> trials_;
  std::vector<double> ln_cue_of_kinds_;  ///< filled on first use
};

// Text form, for records.

/// Seed, hidden lumps and answers.
struct LumpState {
  std::uint64_t seed = 0;
  bool exam = false;
  std::vector<LumpTrial> trials;
};
/// Throws Error.
LumpState parseLumpState(std::string_view text);
std::string lumpStateText(const LumpState& state);
/// Reads one body, which has a column of its own in the records. Throws Error.
LumpTrial parseLumpTrial(std::string_view text);
std::string lumpTrialText(const LumpTrial& trial);

}  // namespace palpate::lumps

template <>
struct palpate::WordsOf<palpate::lumps::LumpQuestion> {
  using V = palpate::lumps::LumpQuestion;
  static constexpr std::array kAll = {Word{"there", V::there}, Word{"place", V::place},       Word{"size", V::size},
                                      Word{"depth", V::depth}, Word{"hardness", V::hardness}, Word{"mobile", V::mobile},
                                      Word{"none", V::none}};
};
