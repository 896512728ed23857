// Where a class's rows are kept: PostgreSQL (class_store.h), or for a small class one SQLite file.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "palpate/classroom/row_keeper.h"
#include "palpate/training/records/row_json.h"

namespace palpate::classroom {

/// One thread. Rows that are there already stay, or become newer; a deletion removes its trainee's rows and holds for
/// what comes late (row_keeper.h).
class RowSink {
 public:
  virtual ~RowSink() = default;
  /// One transaction. Throws Error when the database is away: nothing was kept then, and the next call connects again.
  virtual KeptRows keep(std::span<const SentRow> rows) = 0;
  /// What the database would not do with rows that it has deleted, in words; empty: nothing.
  virtual std::string trouble() const { return {}; }

 protected:
  RowSink() = default;
  RowSink(const RowSink&) = default;
  RowSink& operator=(const RowSink&) = default;
};

/// The class whose rows these are.
struct SinkRules {
  std::optional<training::ClassRow> of = {};  ///< kept as its folder says; what stations say of it changes nothing
  std::int64_t station_bytes = kStationBytes;
  /// The class's secret, remembered in a file so that codes can be found there; never in a database, which others read.
  std::string trainee_key = {};
};

/// An SQLite file, made where there is none. Throws Error.
std::unique_ptr<RowSink> fileSink(const std::filesystem::path& file, const SinkRules& rules = {});
/// PostgreSQL, as libpq has it: "host=/run/postgresql dbname=class". A server that does not answer yet is waited for.
std::unique_ptr<RowSink> databaseSink(const std::string& connection, const SinkRules& rules = {});

}  // namespace palpate::classroom
