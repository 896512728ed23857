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
  TrainingRecord record{.classes = store.classes(), .protocols = store.protocols(), .settings = {}, .trainees = {}};
  readProtocols(record);
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

void readProtocols(TrainingRecord& record) {
  for (const ProtocolRow& row : record.protocols) {
    try {
      record.settings.insert_or_assign({row.id, row.version}, parseProtocol(row.text, row.id));
    } catch (const Error&) {
      record.settings.erase({row.id, row.version});  // of another version
    }
  }
}

const Protocol* protocolOf(const TrainingRecord& record, const std::string& id, int version) {
  const auto at = record.settings.find({id, version});
  return at == record.settings.end() ? nullptr : &at->second;
}

}  // namespace palpate::training
