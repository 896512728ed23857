// Whether the records are whole: the database's own check, and whether rows, recordings and blocks agree with each
// other. Changes nothing.
#pragma once

#include <string>
#include <vector>

#include "palpate/lumps/lump_block.h"
#include "palpate/training/records/store.h"

namespace palpate::training {

struct Verified {
  std::vector<std::string> faults;  ///< each a sentence; none: all is well
  std::vector<std::string> notes;   ///< parts that could not be checked, or are valid but unusual
  std::size_t trainees = 0;
  std::size_t sessions = 0;
  std::size_t blocks = 0;
  std::size_t trials = 0;
  std::size_t recording_files = 0;
  std::size_t recomputed = 0;  ///< blocks whose result came out again
  bool ok() const { return faults.empty(); }
};

/// Throws Error for a file that cannot be read at all.
Verified verifyRecords(Store& store);

/// The result recomputed from the block's protocol and state; nothing where this version cannot read them.
std::optional<BlockResult> recomputed(RowTables& rows, const BlockRow& block, SessionKind kind);
/// The same for a session with lumps.
std::optional<lumps::LumpCounts> recomputedLumps(RowTables& rows, const BlockRow& block);

}  // namespace palpate::training
