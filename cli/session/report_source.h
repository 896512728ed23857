// Files of another product that `palpate report` reports on as it does on recordings: the product offers itself, so
// that the command includes none of it.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "palpate/base/progress.h"

namespace palpate::app {

struct ReportRequest {
  std::filesystem::path file;
  std::string trainee;       ///< a code, or a pseudonym or its beginning; empty: the class
  std::string only_class;    ///< its word; empty: all
  bool whole_class = false;  ///< also where there is but one trainee
  bool wants_page = false;   ///< pictures are drawn only then
};

struct FinishedReport {
  std::filesystem::path file;          ///< as it is named to people
  std::string page;                    ///< HTML; empty unless it was wanted
  nlohmann::ordered_json numbers;      ///< all of them
  std::vector<std::string> sentences;  ///< main results
};

struct ReportSource {
  /// Whether the file, or the address in its place, is one of its own.
  bool (*owns)(const std::filesystem::path& file) = nullptr;
  /// Name of the page where none is given; empty: the file's own with .html.
  std::string (*page_name)(const std::filesystem::path& file) = nullptr;
  /// Throws Error.
  FinishedReport (*report)(const ReportRequest& request, const Progress& progress) = nullptr;
};

/// At most one. Call it before the command line is read.
void offerReportSource(const ReportSource& source);

}  // namespace palpate::app
