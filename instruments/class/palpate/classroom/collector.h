// Gathers a class's rows: rows of all stations come from the broker, go into the database in batches, and are
// acknowledged when they are there. It may be killed at any moment, and so may the broker and the database:
// unacknowledged rows come again.
//
//   broker ─ rows ─► inbox ─ batch ─► RowSink::save (commit) ─► ack to each station
//
// Based on: outbox and application acknowledgement; a broker's own acknowledgement is not delivery
// (docs/reference/class-protocol.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "palpate/classroom/class_settings.h"
#include "palpate/classroom/row_keeper.h"
#include "palpate/training/records/row_json.h"

namespace palpate::classroom {

// Where a class's rows are kept: PostgreSQL (class_store.h), or for a small class one SQLite file.

/// One thread. Rows that are there already stay, or become newer; a deletion removes its trainee's rows and holds for
/// what comes late (row_keeper.h).
class RowSink {
 public:
  virtual ~RowSink() = default;
  /// One transaction. Throws Error when the database is away: nothing was kept then, and the next call connects again.
  virtual KeptRows save(std::span<const SentRow> rows) = 0;
  /// Why the database could not handle rows that it has deleted; empty: no trouble.
  virtual std::string trouble() const { return {}; }

 protected:
  RowSink() = default;
  RowSink(const RowSink&) = default;
  RowSink& operator=(const RowSink&) = default;
};

/// The class whose rows these are.
struct SinkRules {
  std::optional<training::ClassRow> of = {};  ///< kept by its folder's settings; stations cannot change it
  std::int64_t station_bytes = kStationBytes;
  /// The class's secret, remembered in a file so that codes can be found there; never in a database, which others read.
  std::string trainee_key = {};
};

/// An SQLite file, created if missing. Throws Error.
std::unique_ptr<RowSink> fileSink(const std::filesystem::path& file, const SinkRules& rules = {});
/// PostgreSQL, in libpq's form: "host=/run/postgresql dbname=class". A server that does not answer yet is waited for.
std::unique_ptr<RowSink> databaseSink(const std::string& connection, const SinkRules& rules = {});

struct CollectorReport {
  bool connected = false;    ///< to the broker
  bool database = true;      ///< the newest batch was kept
  std::uint64_t rows = 0;    ///< kept and acknowledged, repeats among them
  std::uint64_t trials = 0;  ///< trials among them
  std::uint64_t commits = 0;
  std::uint64_t waited = 0;   ///< rows whose parents had not come yet; they come again
  std::uint64_t refused = 0;  ///< were no rows, or rows that their sender may not write (row_keeper.h)
  std::uint64_t dropped = 0;  ///< came faster than the database took them; they come again
  std::size_t inbox = 0;      ///< rows waiting now
  std::size_t inbox_bytes = 0;
  std::size_t stations = 0;  ///< heard of
  std::string trouble;       ///< the newest, in words; empty: none
};

class Collector {
 public:
  /// Begins at once; a broker or a database that is not there yet is waited for. Throws Error for certificates that
  /// cannot be used.
  Collector(const Member& member, std::unique_ptr<RowSink> sink);
  /// Finishes the current batch.
  ~Collector();
  Collector(const Collector&) = delete;
  Collector& operator=(const Collector&) = delete;

  CollectorReport report() const;
  /// Returns events that a teacher should know, one line each, since the last call: refused rows, and the remains of a
  /// deletion. At most one line per station and minute.
  std::vector<std::string> drainReports();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate::classroom
