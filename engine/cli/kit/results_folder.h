// The folder of a run's results, so that two runs are never mixed by accident.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace palpate::app {

struct ResultsFolder {
  std::filesystem::path folder;
  std::vector<std::string> earlier;  ///< files of the replaced run, if any
};

/// The requested folder; by default `results`, or `results-2`, ... where an earlier run is. A folder with another run
/// is refused, with a name that is free, unless it may be overwritten. Throws Error.
ResultsFolder resultsFolder(const std::optional<std::string>& wanted, bool overwrite);

/// Removes files of the replaced run that the new one did not write again.
void removeEarlier(const ResultsFolder& results, const std::vector<std::string>& written);

/// "folder-2", "folder-3", ...: the first that is not there or empty.
std::filesystem::path freshFolder(const std::filesystem::path& folder);

}  // namespace palpate::app
