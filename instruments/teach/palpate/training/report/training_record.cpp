#include "palpate/training/report/training_record.h"

#include <algorithm>

#include "palpate/base/error.h"

namespace palpate::training {

namespace {

SessionRecord sessionRecord(Store& store, const SessionRow& row) {
  SessionRecord session{.row = row, .blocks = {}, .events = store.events(row.id)};
  for (BlockRow& block : store.blocks(row.id)) {
    std::vector<TrialRow> trials = store.trials(block.id);
    std::ranges::stable_sort(trials, {}, &TrialRow::number);
    session.blocks.push_back({std::move(block), std::move(trials)});
  }
  return session;
}

}  // namespace

TrainingRecord trainingRecord(Store& store, const TraineeRequest& wanted) {
  TrainingRecord record{.classes = store.classes(), .protocols = store.protocols(), .settings = {}, .trainees = {}};
  readProtocols(record);
  for (TraineeRow& row : store.trainees()) {
    if (!wanted(row)) continue;
    TraineeRecord trainee{.row = std::move(row), .sessions = {}};
    std::vector<SessionRow> sessions = store.sessions(trainee.row.id);
    std::ranges::stable_sort(sessions, {}, &SessionRow::start_ms);
    for (const SessionRow& session : sessions) trainee.sessions.push_back(sessionRecord(store, session));
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
      record.settings.erase({row.id, row.version});  // written by another version
    }
  }
}

const Protocol* findProtocol(const TrainingRecord& record, const std::string& id, int version) {
  const auto at = record.settings.find({id, version});
  return at == record.settings.end() ? nullptr : &at->second;
}

}  // namespace palpate::training
