// What a report is made of: the rows of some trainees, put together as they belong.
//
//   Store ─ trainingRecord ─► TrainingRecord ─ training_statistics.h ─► numbers ─► page, JSON
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
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
  std::vector<TraineeRecord> trainees;  ///< in the order of their pseudonyms: of no meaning
};

using TraineeWish = std::function<bool(const TraineeRow&)>;

/// Of the trainees that are wanted. Throws Error for a file that cannot be read.
TrainingRecord trainingRecord(Store& store, const TraineeWish& wanted);

/// The settings of a protocol that the record holds; nothing where it is missing or cannot be read by this version.
std::optional<Protocol> protocolOf(const TrainingRecord& record, const std::string& id, int version);

}  // namespace palpate::training
