#include "report/recording/report_delivery.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "cli/kit/json.h"
#include "cli/kit/readable_text.h"
#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "report/recording/recording_report.h"

namespace palpate::app {

namespace {

/// Whether an existing file of this name is not a report of ours, and would be lost although the user did not name it.
bool isForeignFile(const std::filesystem::path& page) {
  std::error_code error;
  if (!std::filesystem::exists(page, error)) return false;
  std::string begin(512, '\0');
  std::ifstream stream(page, std::ios::binary);
  stream.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return begin.find(kReportMark) == std::string::npos;
}

}  // namespace

std::filesystem::path standardPage(const std::filesystem::path& file) {
  std::string name = file.filename().string();
  const std::size_t end = std::min(name.find(".session"), name.find(".results"));
  if (end != std::string::npos && end > 0) name.resize(end);
  return name + ".html";
}

std::filesystem::path resolvePagePath(const ReportRequest& request, const std::filesystem::path& standard_page) {
  if (!request.wantsPage()) return {};
  std::error_code error;
  const std::filesystem::path page = request.out.empty() ? standard_page : request.out;
  if (std::filesystem::equivalent(page, request.file, error)) {
    throw Error::inFile(page.string(), "is the file to report on; name another page with --out");
  }
  if (request.out.empty() && isForeignFile(page)) {
    throw Error::inFile(page.string(), "exists already and is not a report; name another page with --out");
  }
  return page;
}

void deliver(const FinishedReport& report, const ReportRequest& request, const std::filesystem::path& page) {
  if (request.wantsPage()) writeFile(page, report.page);
  if (request.json) {  // invalid text in it is replaced
    fmt::print("{}", jsonText(report.numbers));
    return;
  }
  for (const std::string& sentence : report.sentences) fmt::print("{}\n", readableLine(sentence));
  fmt::print("{} -> {}\n", report.file.string(), page.string());
}

}  // namespace palpate::app
