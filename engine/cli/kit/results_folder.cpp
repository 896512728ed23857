// A run is known by its files: those in report.json, and the names that every run has.
#include "cli/kit/results_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/path_text.h"
#include "palpate/base/text.h"

namespace palpate::app {

namespace {

namespace fs = std::filesystem;

constexpr const char* kReport = "report.json";
constexpr const char* kDefaultFolder = "results";
constexpr std::size_t kMaxReportBytes = std::size_t{1} << 24;
/// Most names in a message.
constexpr std::size_t kMaxNames = 4;

/// In this folder alone: report.json may have been written by others.
bool isPlainName(const std::string& name) { return !name.empty() && pathOf(name).filename() == pathOf(name); }

std::vector<std::string> listedFiles(const fs::path& folder) {
  std::vector<std::string> names;
  try {
    const auto report = Json::parse(readFile(folder / kReport, kMaxReportBytes));
    for (const auto& file : report.at("files")) names.push_back(file.get<std::string>());
  } catch (const std::exception&) {
    // No report that lists files: the run is known by its usual names alone.
  }
  return names;
}

std::vector<std::string> filesOfRun(const fs::path& folder) {
  std::vector<std::string> names = listedFiles(folder);
  names.insert(names.end(), {"forces.csv", "pictures.png", kReport});
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  std::erase_if(names, [&](const std::string& name) {
    return !isPlainName(name) || !fs::is_regular_file(folder / pathOf(name));
  });
  return names;
}

bool isFree(const fs::path& folder) {
  std::error_code error;
  return !fs::exists(folder, error) || (fs::is_directory(folder, error) && fs::is_empty(folder, error));
}

}  // namespace

fs::path freshFolder(const fs::path& folder) {
  const fs::path plain = folder.has_filename() ? folder : folder.parent_path();  // "monday/" is "monday"
  fs::path fresh = plain;
  for (int i = 2; !isFree(fresh); ++i) fresh = withEnding(plain, fmt::format("-{}", i));
  return fresh;
}

ResultsFolder resultsFolder(const std::optional<std::string>& wanted, bool overwrite) {
  if (!wanted && !overwrite) return {freshFolder(kDefaultFolder), {}};
  ResultsFolder results;
  results.folder = pathOf(wanted.value_or(kDefaultFolder));
  results.earlier = filesOfRun(results.folder);
  if (overwrite || results.earlier.empty()) return results;
  std::vector<std::string> named = results.earlier;
  if (named.size() > kMaxNames) named.resize(kMaxNames);
  throw Error::inFile(
      results.folder.string(),
      fmt::format("contains another run ({}{}); replace it with --overwrite, or use --out {}", fmt::join(named, ", "),
                  named.size() < results.earlier.size() ? ", ..." : "", freshFolder(results.folder).string()));
}

void removeEarlier(const ResultsFolder& results, const std::vector<std::string>& written) {
  for (const std::string& name : results.earlier) {
    std::error_code ignored;  // files that stay are recognised by their date
    if (std::find(written.begin(), written.end(), name) == written.end())
      fs::remove(results.folder / pathOf(name), ignored);
  }
}

}  // namespace palpate::app
