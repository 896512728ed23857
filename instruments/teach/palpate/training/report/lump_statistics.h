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

#include "palpate/lumps/lump_block.h"
#include "palpate/training/report/threshold_points.h"

namespace palpate::training {

struct LumpRate {
  int part = 0;
  int whole = 0;
  double share() const { return whole > 0 ? static_cast<double>(part) / whole : 0.0; }
  ShareInterval interval() const { return whole > 0 ? wilsonInterval(part, whole) : ShareInterval{}; }
};

struct DPrime {
  double value = 0.0;
  double low = 0.0;  ///< 95 %
  double high = 0.0;
};
/// Sensitivity, from the shares of "there is one" with and without a lump.
DPrime dPrime(const LumpRate& hits, const LumpRate& false_alarms);

/// Counts by [true grade][answered grade].
using SaidGrades = std::array<std::array<int, lumps::kGrades>, lumps::kGrades>;

struct LumpStatistics {
  lumps::LumpCounts counts;
  LumpRate found;               ///< lumps, of those hidden: sensitivity
  LumpRate known_with;          ///< bodies with a lump in which one was named
  LumpRate known_without;       ///< bodies without in which none was: specificity
  std::optional<DPrime> prime;  ///< where there were bodies of both kinds
  std::array<LumpRate, lumps::kGrades> by_size, by_depth, by_hardness;  ///< found, of each grade
  LumpRate fixed, mobile;                                               ///< found
  SaidGrades size{}, depth{}, hardness{};                               ///< lumps found and described
  LumpRate mobility_right;                                              ///< among these
  Spread error_mm;                                                      ///< over lumps that were found
};
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
