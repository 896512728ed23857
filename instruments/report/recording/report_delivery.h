// Destination of a report: a page that overwrites nothing by chance, or numbers on the standard output.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "palpate/base/json.h"

namespace palpate::app {

struct ReportRequest {
  std::filesystem::path file;  ///< the reported recording
  std::filesystem::path out;   ///< empty: `standard_page`
  bool json = false;
  /// Pictures are drawn only then.
  bool wantsPage() const { return !json || !out.empty(); }
};

struct FinishedReport {
  std::filesystem::path file;          ///< its name for people
  std::string page;                    ///< HTML; empty unless it was wanted
  Json numbers;                        ///< all of them
  std::vector<std::string> sentences;  ///< main results
};

/// run.session -> run.html, also of run.session.partial, and of class.results; in the working folder.
std::filesystem::path standardPage(const std::filesystem::path& file);

/// The page's file; empty where none is wanted. Throws Error where something would be lost: call it before the work.
std::filesystem::path resolvePagePath(const ReportRequest& request, const std::filesystem::path& standard_page);

/// Writes the page and prints the sentences, or the numbers. Throws Error.
void deliver(const FinishedReport& report, const ReportRequest& request, const std::filesystem::path& page);

}  // namespace palpate::app
