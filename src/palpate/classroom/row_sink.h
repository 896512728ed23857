// Where a class's rows are kept: PostgreSQL (class_store.h), or for a small class one SQLite file.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "palpate/training/records/row_json.h"

namespace palpate::classroom {

/// One thread. Rows that are there already stay, or become newer; a deletion removes its trainee's rows and holds for
/// what comes late.
class RowSink {
 public:
  struct Kept {
    std::vector<training::Uuid> keys;  ///< outbox keys: durable now, to be acknowledged
    std::size_t refused = 0;           ///< what they belong to has not come yet, or they contradict what is there
    std::string why;                   ///< the last of those was refused; empty: none
  };
  virtual ~RowSink() = default;
  /// One transaction. Throws Error when the database is away: nothing was kept then, and the next call connects again.
  virtual Kept keep(std::span<const training::AnyRow> rows) = 0;

 protected:
  RowSink() = default;
  RowSink(const RowSink&) = default;
  RowSink& operator=(const RowSink&) = default;
};

// `of`: the class whose rows these are, kept as its folder says; what stations say of it changes nothing.

/// An SQLite file, made where there is none. Throws Error.
std::unique_ptr<RowSink> fileSink(const std::filesystem::path& file,
                                  const std::optional<training::ClassRow>& of = std::nullopt);
/// PostgreSQL, as libpq has it: "host=/run/postgresql dbname=class". A server that does not answer yet is waited for.
std::unique_ptr<RowSink> databaseSink(const std::string& connection,
                                      const std::optional<training::ClassRow>& of = std::nullopt);

}  // namespace palpate::classroom
