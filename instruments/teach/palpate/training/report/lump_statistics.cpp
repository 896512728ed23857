#include "palpate/training/report/lump_statistics.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "palpate/base/error.h"
#include "palpate/training/psychometric.h"

namespace palpate::training {

namespace {

constexpr double kTwoSided = 1.959964;

/// A share with half an answer on each side, its place on the normal scale, and that place's variance.
struct Scaled {
  double z = 0.0;
  double variance = 0.0;
};

Scaled scaled(const Rate& rate) {
  const double n = rate.whole + 1.0;
  const double share = (rate.part + 0.5) / n;
  const double z = standardNormalQuantile(share);
  const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
  return {z, share * (1.0 - share) / (n * density * density)};
}

void countLump(LumpStatistics& statistics, const lumps::HiddenLump& lump, const lumps::LumpFinding* finding) {
  const bool found = finding != nullptr;
  for (const LumpTrait& trait : kLumpTraits) {
    GradedLumps& graded = statistics.*trait.counted;
    const auto truth = static_cast<std::size_t>(lump.*trait.truth);
    graded.found[truth].count(found);
    const int answer = found ? finding->*trait.answer : lumps::LumpFinding::kUnsaid;
    if (answer != lumps::LumpFinding::kUnsaid) ++graded.said[truth][static_cast<std::size_t>(answer)];
  }
  (lump.mobile ? statistics.mobile : statistics.fixed).count(found);
  if (found && finding->mobile != lumps::LumpFinding::kUnsaid) {
    statistics.mobility_right.count((finding->mobile == 1) == lump.mobile);
  }
}

}  // namespace

DPrime dPrime(const Rate& hits, const Rate& false_alarms) {
  const Scaled hit = scaled(hits);
  const Scaled alarm = scaled(false_alarms);
  const double value = hit.z - alarm.z;
  const double half = kTwoSided * std::sqrt(hit.variance + alarm.variance);
  return {.value = value, .low = value - half, .high = value + half};
}

LumpStatistics lumpStatistics(const std::vector<lumps::LumpTrial>& trials, const lumps::LumpTask& task) {
  LumpStatistics statistics;
  statistics.counts = lumps::countLumps(trials, task);
  const lumps::LumpCounts& counts = statistics.counts;
  statistics.found = {counts.found, counts.lumps};
  statistics.known_with = {counts.said_with, counts.with};
  statistics.known_without = {counts.without - counts.said_without, counts.without};
  if (counts.with > 0 && counts.without > 0) {
    statistics.prime = dPrime(statistics.known_with, {counts.said_without, counts.without});
  }
  std::vector<double> errors;
  for (const lumps::LumpTrial& trial : trials) {
    if (!trial.over) continue;
    const std::vector<lumps::MatchedFinding> judged = lumps::matchFindings(trial, task);
    for (std::size_t i = 0; i < trial.hidden.size(); ++i) {
      const auto own = std::ranges::find(judged, std::optional(i), &lumps::MatchedFinding::lump);
      const bool found = own != judged.end();
      const auto number = static_cast<std::size_t>(own - judged.begin());
      countLump(statistics, trial.hidden[i], found ? &trial.findings[number] : nullptr);
      if (found) errors.push_back(*own->error_mm);
    }
  }
  if (!errors.empty()) statistics.error_mm = computeSpread(errors);
  return statistics;
}

namespace {

std::vector<lumps::LumpTrial> parseBodies(const BlockRecord& block) {
  std::vector<lumps::LumpTrial> bodies;
  for (const TrialRow& trial : block.trials) {
    try {
      bodies.push_back(lumps::parseLumpTrial(trial.lumps));
    } catch (const Error&) {
      continue;  // written by a newer version
    }
  }
  return bodies;
}

LumpGroup& findOrAddGroup(std::vector<LumpGroup>& groups, SessionKind kind, const BlockRow& block,
                          const lumps::LumpTask& task) {
  for (LumpGroup& group : groups) {
    if (group.kind == kind && group.protocol_id == block.protocol_id &&
        group.protocol_version == block.protocol_version) {
      return group;
    }
  }
  LumpGroup& group = groups.emplace_back();
  group.kind = kind;
  group.protocol_id = block.protocol_id;
  group.protocol_version = block.protocol_version;
  group.task = task;
  return group;
}

void addSitting(std::vector<LumpGroup>& groups, const TrainingRecord& record, const SessionRecord& session,
                const BlockRecord& block) {
  const Protocol* protocol = findProtocol(record, block.row.protocol_id, block.row.protocol_version);
  if (block.trials.empty() || protocol == nullptr || !protocol->lump) return;
  LumpGroup& group = findOrAddGroup(groups, session.row.kind, block.row, *protocol->lump);
  LumpSessionResult& sitting = group.sittings.emplace_back();
  sitting.trainee = session.row.trainee_id;
  sitting.block = block.row;
  sitting.kind = session.row.kind;
  sitting.start_ms = block.trials.front().start_ms;
  sitting.device = session.row.device;
  sitting.trials = parseBodies(block);
  sitting.statistics = lumpStatistics(sitting.trials, group.task);
}

}  // namespace

std::vector<LumpGroup> lumpGroups(const TrainingRecord& record) {
  std::vector<LumpGroup> groups;
  for (const TraineeRecord& trainee : record.trainees) {
    for (const SessionRecord& session : trainee.sessions) {
      if (!hidesLumps(session.row.kind)) continue;
      for (const BlockRecord& block : session.blocks) addSitting(groups, record, session, block);
    }
  }
  std::ranges::sort(groups, {}, [](const LumpGroup& group) {
    return std::tuple(group.kind, group.protocol_id, group.protocol_version);
  });
  for (LumpGroup& group : groups) {
    std::ranges::sort(group.sittings, {},
                      [](const LumpSessionResult& each) { return std::tuple(each.start_ms, each.block.id); });
    std::vector<lumps::LumpTrial> all;
    for (const LumpSessionResult& each : group.sittings) all.insert(all.end(), each.trials.begin(), each.trials.end());
    group.all = lumpStatistics(all, group.task);
  }
  return groups;
}

}  // namespace palpate::training
