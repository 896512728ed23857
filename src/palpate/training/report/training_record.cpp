#include "palpate/training/report/training_record.h"

#include <algorithm>

#include "palpate/base/error.h"

namespace palpate::training {

namespace {

SittingRecord sittingRecord(Store& store, const SittingRow& row) {
  SittingRecord sitting{.row = row, .blocks = {}, .events = store.events(row.id)};
  for (BlockRow& block : store.blocks(row.id)) {
    std::vector<TrialRow> trials = store.trials(block.id);
    std::ranges::stable_sort(trials, {}, &TrialRow::number);
    sitting.blocks.push_back({std::move(block), std::move(trials)});
  }
  return sitting;
}

}  // namespace

TrainingRecord trainingRecord(Store& store, const TraineeWish& wanted) {
  TrainingRecord record{.classes = store.classes(), .protocols = store.protocols(), .trainees = {}};
  for (TraineeRow& row : store.trainees()) {
    if (!wanted(row)) continue;
    TraineeRecord trainee{.row = std::move(row), .sittings = {}};
    std::vector<SittingRow> sittings = store.sittings(trainee.row.id);
    std::ranges::stable_sort(sittings, {}, &SittingRow::start_ms);
    for (const SittingRow& sitting : sittings) trainee.sittings.push_back(sittingRecord(store, sitting));
    record.trainees.push_back(std::move(trainee));
  }
  std::ranges::sort(record.trainees, {}, [](const TraineeRecord& trainee) { return trainee.row.id; });
  return record;
}

std::optional<Protocol> protocolOf(const TrainingRecord& record, const std::string& id, int version) {
  for (const ProtocolRow& row : record.protocols) {
    if (row.id != id || row.version != version) continue;
    try {
      return parseProtocol(row.text, id);
    } catch (const Error&) {
      return std::nullopt;  // of another version: the rows can still be counted
    }
  }
  return std::nullopt;
}

}  // namespace palpate::training
