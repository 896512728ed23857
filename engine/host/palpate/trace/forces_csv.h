// forces.csv: every finger in every tick, as a table that spreadsheets and scripts read (forces_rows.h says what is in
// it).
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "palpate/base/output_file.h"
#include "palpate/trace/forces_rows.h"

namespace palpate::trace {

/// Columns behind those of every such table. One that has any is for spreadsheets and scripts: it cannot be played
/// back.
struct MoreColumns {
  std::string header = {};                                                   ///< ",name" each; empty: there are none
  std::function<void(const Sample& sample, std::string& text)> append = {};  ///< ",value" each
};

/// Writes a file block by block; it appears under its name when it is complete. One thread. Throws Error when the file
/// cannot be created or written.
class ForcesCsvWriter {
 public:
  /// `unfinished`: what happens to the rows without a commit.
  ForcesCsvWriter(const std::filesystem::path& file, ForcesCsvSettings settings,
                  OutputFile::Unfinished unfinished = OutputFile::Unfinished::remove, MoreColumns more = {});
  void add(const Sample& sample);
  /// Writes what is left and gives the file its name.
  void commit();
  /// Where the rows are until then.
  const std::filesystem::path& partial() const { return file_.partial(); }

 private:
  void flush();

  ForcesCsvSettings settings_;
  MoreColumns more_;
  OutputFile file_;
  std::string block_;
};

}  // namespace palpate::trace
