// The data of a report: the rows of some trainees, put together as they belong.
//
//   Store ─ trainingRecord ─► TrainingRecord ─ training_statistics.h ─► numbers ─► page, JSON
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "palpate/training/protocol.h"
#include "palpate/training/records/rows.h"
#include "palpate/training/records/store.h"

namespace palpate::training {

struct BlockRecord {
  BlockRow row;
  std::vector<TrialRow> trials;  ///< by number, whatever session they were felt in
};

struct SessionRecord {
  SessionRow row;
  std::vector<BlockRecord> blocks;  ///< begun in it
  std::vector<EventRow> events;
};

struct TraineeRecord {
  TraineeRow row;
  std::vector<SessionRecord> sessions;  ///< oldest first
};

struct TrainingRecord {
  std::vector<ClassRow> classes;
  std::vector<ProtocolRow> protocols;
  std::map<std::pair<std::string, int>, Protocol> settings;  ///< protocols by id and version (readProtocols)
  std::vector<TraineeRecord> trainees;                       ///< in the order of their pseudonyms: of no meaning
};

using TraineeRequest = std::function<bool(const TraineeRow&)>;

/// Reads the requested trainees. Throws Error for a file that cannot be read.
TrainingRecord trainingRecord(Store& store, const TraineeRequest& wanted);

/// Fills in `settings`; what this version cannot read stays out: the rows can still be counted.
void readProtocols(TrainingRecord& record);
/// Null if the record lacks the protocol.
const Protocol* findProtocol(const TrainingRecord& record, const std::string& id, int version);

}  // namespace palpate::training
