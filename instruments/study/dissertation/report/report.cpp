#include "dissertation/report/report.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "palpate/base/stopwatch.h"
#include "palpate/base/text.h"
#include "report/page/report_html.h"
#include "report/page/study_page.h"

namespace palpate::study {

namespace {

// "3 of 11, 42 s: hdb: small boxes", its share that of the chapters done.
Progress stepProgress(const Progress& progress, std::size_t step, std::size_t steps, const std::string& name,
                      Clock::time_point start) {
  if (!progress) return {};
  return [=](std::string_view stage, double done) {
    const double share = (static_cast<double>(step) + done) / static_cast<double>(steps);
    progress(fmt::format("{} of {}, {:.0f} s: {}: {}", step + 1, steps, secondsSince(start), name, stage), share);
  };
}

ReportHead makeReportHead(const std::vector<StudyPage>& pages, std::size_t chapters, bool quick, double seconds) {
  ReportHead head;
  head.title = "The dissertation, studied";
  head.about =
      "W. Ji's dissertation \"Spatial Partitioning and Functional Shape Matched Deformation Algorithm for Interactive "
      "Haptic Modeling\" (Ohio University, 2008) asked how a haptic model can be divided, deformed and mapped. Each "
      "chapter here takes one of its questions, measures it again with Palpate and sets the printed answer beside "
      "ours. E1 to E34 are its checked errata (`docs/reference/dissertation.md`).";
  if (quick)
    head.about += " This was a quick run: small models and few repetitions, for a look and not for its numbers.";
  if (pages.size() < chapters)
    head.about += fmt::format(" This run was ended early: {} of {} chapters.", pages.size(), chapters);
  head.command = fmt::format("palpate study all{} --out DIR", quick ? " --quick" : "");
  head.machine = pages.empty() ? "" : pages.front().machine;
  head.seconds = seconds;
  return head;
}

/// Writes the page of a chapter and returns it, or nothing after a stop request: then work ends by what its progress
/// throws.
std::optional<StudyPage> writtenPage(const Study& chapter, const StudySettings& settings,
                                     const std::filesystem::path& folder, const std::function<bool()>& stop) {
  const auto stopped = [&] { return stop && stop(); };
  if (stopped()) return std::nullopt;
  try {
    StudyPage page = runStudy(chapter, settings);
    writePage(page, folder, settings.progress);
    return page;
  } catch (...) {
    if (stopped()) return std::nullopt;
    throw;
  }
}

}  // namespace

std::vector<StudyPage> writeReport(const std::vector<Study>& chapters, const StudySettings& settings,
                                   const std::filesystem::path& folder,
                                   const std::function<void(const ChapterDone&)>& done,
                                   const std::function<bool()>& stop) {
  makeFolder(folder);
  const auto start = Clock::now();
  std::vector<StudyPage> pages;
  for (std::size_t i = 0; i < chapters.size(); ++i) {
    const auto chapter_start = Clock::now();
    const Progress progress = stepProgress(settings.progress, i, chapters.size(), chapters[i].name, start);
    auto page = writtenPage(chapters[i], {.quick = settings.quick, .progress = progress}, folder, stop);
    if (!page) break;
    pages.push_back(std::move(*page));
    if (done) done({i + 1, chapters.size(), chapters[i].name, secondsSince(chapter_start)});
  }
  writeFile(folder / "report.html",
            reportHtml(makeReportHead(pages, chapters.size(), settings.quick, secondsSince(start)), pages, folder));
  return pages;
}

}  // namespace palpate::study
