// Statistics of sessions with lumps: how many were found, of each size, depth and hardness, how many false alarms there
// were, and how well bodies with a lump were distinguished from those without.
//
//   TraineeRecord ... ─ lumpGroups ─► LumpGroup: kind of session, protocol, rates with intervals, d', the cue's
//   threshold
//
// Sessions of another kind or protocol are never counted together: their lumps differ.
// Based on: Wilson's intervals (trial_statistics.h); d' by Gourevitch and Galanter, Psychometrika 32:25, 1967, with
// half an answer added to each count (Hautus, Behav. Res. Methods 27:46, 1995), so that it is finite.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "palpate/base/language.h"
#include "palpate/lumps/lump_block.h"
#include "palpate/training/report/threshold_points.h"

namespace palpate::training {

struct DPrime {
  double value = 0.0;
  double low = 0.0;  ///< 95 %
  double high = 0.0;
};
/// Sensitivity, from the shares of "there is one" with and without a lump.
DPrime dPrime(const Rate& hits, const Rate& false_alarms);

/// By the grade of a trait.
struct GradedLumps {
  std::array<Rate, lumps::kGrades> found;
  /// Lumps found and described, by [true grade][answered grade].
  std::array<std::array<int, lumps::kGrades>, lumps::kGrades> said{};
};

struct LumpStatistics {
  lumps::LumpCounts counts;
  Rate found;                   ///< lumps, of those hidden: sensitivity
  Rate known_with;              ///< bodies with a lump in which one was named
  Rate known_without;           ///< bodies without in which none was: specificity
  std::optional<DPrime> prime;  ///< where there were bodies of both kinds
  GradedLumps size, depth, hardness;
  Rate fixed, mobile;   ///< found
  Rate mobility_right;  ///< among these
  Spread error_mm;      ///< over lumps that were found
};

/// A trait in which lumps differ, described once.
struct LumpTrait {
  const char* name;   ///< in JSON
  const char* words;  ///< for a grade, in English, for tr()
  lumps::Grades lumps::LumpTask::*grades;
  int lumps::HiddenLump::*truth;
  int lumps::LumpFinding::*answer;
  GradedLumps LumpStatistics::*counted;
};
inline constexpr std::array kLumpTraits = {
    LumpTrait{"size", toTranslate("{:g} mm large"), &lumps::LumpTask::diameters_mm, &lumps::HiddenLump::size,
              &lumps::LumpFinding::size, &LumpStatistics::size},
    LumpTrait{"depth", toTranslate("{:g} mm deep"), &lumps::LumpTask::depths_mm, &lumps::HiddenLump::depth,
              &lumps::LumpFinding::depth, &LumpStatistics::depth},
    LumpTrait{"hardness", toTranslate("{:g} times as stiff"), &lumps::LumpTask::ratios, &lumps::HiddenLump::hardness,
              &lumps::LumpFinding::hardness, &LumpStatistics::hardness}};

LumpStatistics lumpStatistics(const std::vector<lumps::LumpTrial>& trials, const lumps::LumpTask& task);

/// One block of such a session.
struct LumpSessionResult {
  Uuid trainee;
  BlockRow block;
  SessionKind kind = SessionKind::lump;
  std::int64_t start_ms = 0;
  std::string device;
  std::vector<lumps::LumpTrial> trials;
  LumpStatistics statistics;
};

struct LumpGroup {
  SessionKind kind = SessionKind::lump;
  std::string protocol_id;
  int protocol_version = 1;
  lumps::LumpTask task;
  std::vector<LumpSessionResult> sittings;  ///< oldest first
  LumpStatistics all;
};

/// Groups of these trainees; practice before examinations. Leaves out blocks whose protocol the record has lost.
std::vector<LumpGroup> lumpGroups(const TrainingRecord& record);

}  // namespace palpate::training
