// forces.csv: every finger in every tick, as a table that spreadsheets and scripts read.
//
// Numbers are the shortest decimals that read back to the same bits, so two files are equal exactly when two runs were.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/output_file.h"
#include "palpate/trace/sample.h"

namespace palpate::trace {

/// The header, without a line end. `triangle` is -1 in free air; `state` is free, stick or slip; `device_*` is the
/// force after the safety limits; the status columns hold the bits of contact and servo.
std::string_view forcesCsvHeader();

struct ForcesCsvSettings {
  std::vector<std::string> finger_names;
  double start_s = 0.0;         ///< time of tick 0
  double ticks_per_s = 1000.0;  ///< time of tick k is start_s + k / ticks_per_s: dividing keeps 0.009 printed as 0.009
};

/// Appends one row with its line end.
void appendForcesRow(std::string& text, const ForcesCsvSettings& settings, const Sample& sample);

/// Writes a file block by block; it appears under its name when it is complete. One thread. Throws Error when the file
/// cannot be created or written.
class ForcesCsvWriter {
 public:
  /// `unfinished`: what becomes of the rows when there is no commit.
  ForcesCsvWriter(const std::filesystem::path& file, ForcesCsvSettings settings,
                  OutputFile::Unfinished unfinished = OutputFile::Unfinished::remove);
  void add(const Sample& sample);
  /// Writes what is left and gives the file its name.
  void commit();
  /// Where the rows are until then.
  const std::filesystem::path& partial() const { return file_.partial(); }

 private:
  void flush();

  ForcesCsvSettings settings_;
  OutputFile file_;
  std::string block_;
};

}  // namespace palpate::trace
