#include "palpate/training/records/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "palpate/base/error.h"
#include "palpate/training/records/recording_files.h"
#include "palpate/training/records/schema.h"
#include "palpate/training/sha256.h"

namespace palpate::training {

namespace {

/// A result that was computed by another compiler may differ in its last digits.
constexpr double kSameResult = 1e-9;

std::optional<Protocol> protocolOfRow(const ProtocolRow& row) {
  try {
    return parseProtocol(row.text, row.id);
  } catch (const Error&) {
    return std::nullopt;
  }
}

bool sameResult(const BlockResult& result, const BlockRow& row) {
  const auto same = [](double a, double b) { return std::abs(a - b) <= kSameResult; };
  return result.trials == row.trials && result.verdict == row.verdict && result.level == row.mastered_change &&
         same(result.threshold.median, row.threshold) && same(result.threshold.low, row.threshold_low) &&
         same(result.threshold.high, row.threshold_high);
}

class RecordsCheck {
 public:
  explicit RecordsCheck(Store& store) : store_(store), files_(store) {}

  Verified done() {
    checkDatabase();
    if (!found_.ok()) return std::move(found_);  // a damaged database is not checked any further
    checkProtocols();
    found_.trainees = store_.trainees().size();
    for (const SessionRow& session : store_.sessions()) checkSession(session);
    if (store_.holdsCopies()) {
      note("recordings are at the stations and were not looked at");
    } else {
      checkStrayFiles();
    }
    return std::move(found_);
  }

 private:
  template <class... Parts>
  void fault(fmt::format_string<Parts...> format, Parts&&... parts) {
    found_.faults.push_back(fmt::format(format, std::forward<Parts>(parts)...));
  }
  template <class... Parts>
  void note(fmt::format_string<Parts...> format, Parts&&... parts) {
    found_.notes.push_back(fmt::format(format, std::forward<Parts>(parts)...));
  }

  void checkDatabase() {
    Sql& sql = store_.rows().sql();
    for (const SqlValues& row : sql.ask("PRAGMA integrity_check(20)")) {
      const auto* words = std::get_if<std::string>(&row.front());
      if (words != nullptr && *words != "ok") fault("the file is damaged: {}", *words);
    }
    for (const SqlValues& row : sql.ask("PRAGMA foreign_key_check")) {
      fault("a row of '{}' belongs to one of '{}' that is not there", std::get<std::string>(row[0]),
            std::get<std::string>(row[2]));
    }
    for (const TableInfo& table : tables()) {
      for (const ColumnInfo& column : table.columns) {
        const std::int64_t there = sql.number("SELECT count(*) FROM pragma_table_info($1) WHERE name = $2",
                                              {std::string(table.name), std::string(column.name)});
        if (there == 0) fault("the column {}.{} is missing", table.name, column.name);
      }
    }
  }

  void checkProtocols() {
    for (const ProtocolRow& row : store_.protocols()) {
      const auto protocol = protocolOfRow(row);
      if (!protocol) {
        note("protocol {} version {} cannot be read by this palpate; results of its blocks are not computed again",
             row.id, row.version);
      } else if (protocolSha256(*protocol) != row.sha256) {
        fault("protocol {} version {} was changed after it was used", row.id, row.version);
      }
    }
  }

  void checkSession(const SessionRow& session) {
    ++found_.sessions;
    if (session.end_ms == 0) note("session {} has no end: it is still running, or was cut off", session.id);
    if (session.end_ms != 0 && session.end_ms < session.start_ms) fault("session {} ends before it begins", session.id);
    checkFile(session);
    int number = 0;
    for (const BlockRow& block : store_.blocks(session.id)) {
      if (block.number <= number) fault("session {} has two blocks with the number {}", session.id, block.number);
      number = block.number;
      checkBlock(block, session.kind);
    }
  }

  void checkFile(const SessionRow& session) {
    if (session.file.empty() || store_.holdsCopies()) return;
    const std::filesystem::path file = files_.pathOf(session.file);
    std::error_code error;
    if (session.file_sha256.empty()) {
      if (files_.sessionFiles(session.id).empty()) fault("the recording of session {} is missing", session.id);
      note("the recording of session {} is not locked yet", session.id);
      return;
    }
    if (!std::filesystem::exists(file, error)) {
      fault("the recording {} is missing", session.file);
      return;
    }
    ++found_.recording_files;
    if (sha256OfFile(file) != session.file_sha256) fault("the recording {} was changed", session.file);
    const auto ref = lockedWith(file);
    if (ref && !files_.vault().find(*ref)) fault("the key of the recording {} is missing", session.file);
  }

  void checkBlock(const BlockRow& block, SessionKind kind) {
    ++found_.blocks;
    const std::vector<TrialRow> trials = store_.trials(block.id);
    found_.trials += trials.size();
    int number = 0;
    for (const TrialRow& trial : trials) {
      if (trial.number != ++number) {
        fault("block {}: trial {} is missing", block.id, number);
        number = trial.number;
      }
      if (!hidesLumps(kind) && trial.correct != (trial.site_answer != 0 && trial.site_answer == trial.site_true)) {
        fault("trial {}: its verdict does not match its sites", trial.id);
      }
      if (trial.end_ms < trial.start_ms) fault("trial {} ends before it begins", trial.id);
    }
    hidesLumps(kind) ? checkLumps(block, trials) : checkResult(block, kind, trials.size());
  }

  /// Checks the bodies of a session with lumps: rows must hold those that the block's result is computed from.
  void checkLumps(const BlockRow& block, const std::vector<TrialRow>& trials) {
    for (const ProtocolRow& row : store_.protocols()) {
      if (row.id != block.protocol_id || row.version != block.protocol_version) continue;
      const auto protocol = protocolOfRow(row);
      if (!protocol || !protocol->lump || block.state_json.empty()) return;
      try {
        const lumps::LumpState state = lumps::parseLumpState(block.state_json);
        checkBodies(block, state, trials, *protocol->lump);
      } catch (const Error& error) {
        fault("block {}: {}", block.id, error.what());
      }
    }
  }

  void checkBodies(const BlockRow& block, const lumps::LumpState& state, const std::vector<TrialRow>& trials,
                   const lumps::LumpTask& task) {
    std::vector<lumps::LumpTrial> done = state.trials;
    std::erase_if(done, [](const lumps::LumpTrial& trial) { return !trial.over; });
    bool same = done.size() == trials.size();
    for (std::size_t i = 0; same && i < done.size(); ++i) {
      same = lumps::parseLumpTrial(trials[i].lumps) == done[i] && trials[i].correct == lumps::isRight(done[i], task);
    }
    if (!same) fault("block {}: its bodies are not those of its trials", block.id);
    const lumps::LumpCounts counts = lumps::countLumps(state.trials, task);
    if (counts.bodies == block.trials && std::abs(counts.threshold.median - block.threshold) <= kSameResult) {
      ++found_.recomputed;
    } else {
      fault("block {}: its result does not match its answers", block.id);
    }
  }

  void checkResult(const BlockRow& block, SessionKind kind, std::size_t trials) {
    for (const ProtocolRow& row : store_.protocols()) {
      if (row.id != block.protocol_id || row.version != block.protocol_version) continue;
      const auto protocol = protocolOfRow(row);
      if (!protocol || block.state_json.empty()) return;
      try {
        const Block again = Block::resumed(settingsOf(*protocol, kind).block, block.state_json);
        if (static_cast<std::size_t>(again.answered()) != trials) {
          fault("block {} has {} answers and {} trials", block.id, again.answered(), trials);
        }
        if (sameResult(again.result(), block)) {
          ++found_.recomputed;
        } else {
          fault("block {}: its result does not match its answers", block.id);
        }
      } catch (const Error& error) {
        fault("block {}: {}", block.id, error.what());
      }
    }
  }

  /// Finds recordings that no row names.
  void checkStrayFiles() {
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(files_.folder(), error)) {
      const std::string name = entry.path().filename().string();
      if (!store_.rows().session(name.substr(0, 36))) fault("the file sessions/{} belongs to no session", name);
    }
  }

  Store& store_;
  RecordingFiles files_;
  Verified found_;
};

}  // namespace

Verified verifyRecords(Store& store) { return RecordsCheck(store).done(); }

std::optional<lumps::LumpCounts> recomputedLumps(RowTables& rows, const BlockRow& block) {
  for (const ProtocolRow& row : rows.protocols()) {
    if (row.id != block.protocol_id || row.version != block.protocol_version) continue;
    const auto protocol = protocolOfRow(row);
    if (!protocol || !protocol->lump) return std::nullopt;
    try {
      return lumps::countLumps(lumps::parseLumpState(block.state_json).trials, *protocol->lump);
    } catch (const Error&) {
      return std::nullopt;
    }
  }
  return std::nullopt;
}

std::optional<BlockResult> recomputed(RowTables& rows, const BlockRow& block, SessionKind kind) {
  for (const ProtocolRow& row : rows.protocols()) {
    if (row.id != block.protocol_id || row.version != block.protocol_version) continue;
    const auto protocol = protocolOfRow(row);
    if (!protocol || block.state_json.empty()) return std::nullopt;
    try {
      return Block::resumed(settingsOf(*protocol, kind).block, block.state_json).result();
    } catch (const Error&) {
      return std::nullopt;
    }
  }
  return std::nullopt;
}

}  // namespace palpate::training
