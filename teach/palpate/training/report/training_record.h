// What a report is made of: the rows of some trainees, put together as they belong.
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
  std::vector<TrialRow> trials;  ///< by number, whatever sitting they were felt in
};

struct SittingRecord {
  SittingRow row;
  std::vector<BlockRecord> blocks;  ///< begun in it
  std::vector<EventRow> events;
};

struct TraineeRecord {
  TraineeRow row;
  std::vector<SittingRecord> sittings;  ///< oldest first
};

struct TrainingRecord {
  std::vector<ClassRow> classes;
  std::vector<ProtocolRow> protocols;
  std::map<std::pair<std::string, int>, Protocol> settings;  ///< of protocols by id and version (readProtocols)
  std::vector<TraineeRecord> trainees;                       ///< in the order of their pseudonyms: of no meaning
};

using TraineeWish = std::function<bool(const TraineeRow&)>;

/// Of the trainees that are wanted. Throws Error for a file that cannot be read.
TrainingRecord trainingRecord(Store& store, const TraineeWish& wanted);

/// Fills in `settings`; what this version cannot read stays out: the rows can still be counted.
void readProtocols(TrainingRecord& record);
/// Null where the record has no such protocol.
const Protocol* protocolOf(const TrainingRecord& record, const std::string& id, int version);

}  // namespace palpate::training
