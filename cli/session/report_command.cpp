// `palpate report`: what a recorded session was, or how training went, as one page that needs nothing else, or as
// numbers.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/kit/commands.h"
#include "cli/kit/interruption.h"
#include "cli/kit/json.h"
#include "cli/kit/progress_line.h"
#include "cli/kit/readable_text.h"
#include "cli/session/report_source.h"
#include "cli/session/session_report.h"
#include "cli/session/session_text.h"
#include "palpate/base/error.h"
#include "palpate/base/text.h"

namespace palpate::app {

namespace {

/// What reports on training, where it is built.
ReportSource& otherSource() {
  static ReportSource source;
  return source;
}

bool isOthers(const std::filesystem::path& file) { return otherSource().owns != nullptr && otherSource().owns(file); }

struct ReportArguments {
  std::filesystem::path file;
  std::filesystem::path out;
  std::filesystem::path folder;
  TimeSpan span;
  bool json = false;
  // Of training.
  std::string trainee;
  std::string only_class;
  bool whole_class = false;
};

/// run.session -> run.html, also of run.session.partial, and of class.results; in the working folder.
std::filesystem::path pageOf(const std::filesystem::path& file) {
  if (otherSource().page_name != nullptr) {
    const std::string given = otherSource().page_name(file);
    if (!given.empty()) return given;
  }
  std::string name = file.filename().string();
  const std::size_t end = std::min(name.find(".session"), name.find(".results"));
  if (end != std::string::npos && end > 0) name.resize(end);
  return name + ".html";
}

/// Whether a file of this name is no report of ours, and would be lost without anybody having named it.
bool isAnothers(const std::filesystem::path& page) {
  std::error_code error;
  if (!std::filesystem::exists(page, error)) return false;
  std::string begin(512, '\0');
  std::ifstream stream(page, std::ios::binary);
  stream.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return begin.find(kReportMark) == std::string::npos;
}

/// Where the page goes. Throws Error where something would be lost.
std::filesystem::path targetOf(const ReportArguments& arguments) {
  std::error_code error;
  const std::filesystem::path page = arguments.out.empty() ? pageOf(arguments.file) : arguments.out;
  if (std::filesystem::equivalent(page, arguments.file, error)) {
    throw Error::inFile(page.string(), "is the file itself that is reported on");
  }
  if (arguments.out.empty() && isAnothers(page)) {
    throw Error::inFile(page.string(), "is there already and is no report; name the page with --out");
  }
  return page;
}

trace::TickSpan reportSpan(const ReportArguments& arguments, const trace::SessionFacts& facts) {
  const trace::TickSpan span = ticksOf(arguments.span, facts.header.ticks_per_s);
  if (facts.samples > 0 && span.from > facts.last_tick) {
    throw Error::inFile(
        arguments.file.string(),
        fmt::format("ends at {} s, before --from", static_cast<double>(facts.last_tick) / facts.header.ticks_per_s));
  }
  return span;
}

/// JSON on the standard output; what is no text in it is replaced.
void printNumbers(const nlohmann::ordered_json& json) { fmt::print("{}", jsonText(json)); }

void printSentences(const std::vector<std::string>& sentences, const std::filesystem::path& file,
                    const std::filesystem::path& page) {
  for (const std::string& sentence : sentences) fmt::print("{}\n", readableLine(sentence));
  fmt::print("{} -> {}\n", file.string(), page.string());
}

void runOtherReport(const ReportArguments& arguments) {
  ProgressLine progress;
  const bool wants_page = !arguments.json || !arguments.out.empty();
  const std::filesystem::path page = wants_page ? targetOf(arguments) : std::filesystem::path();
  const FinishedReport report =
      otherSource().report({arguments.file, arguments.trainee, arguments.only_class, arguments.whole_class, wants_page},
                           progress.callback());
  if (wants_page) writeFile(page, report.page);
  progress.clear();
  if (arguments.json) return printNumbers(report.numbers);
  printSentences(report.sentences, report.file, page);
}

void runSessionReport(const ReportArguments& arguments) {
  ProgressLine progress;
  trace::SessionReader session(arguments.file);
  const bool wants_page = !arguments.json || !arguments.out.empty();
  const std::filesystem::path page = wants_page ? targetOf(arguments) : std::filesystem::path();
  const ReportSettings settings{arguments.file, arguments.folder, reportSpan(arguments, session.facts())};
  const FinishesInOrder in_order;  // files that the session carries lie in a folder that must go again
  const trace::ReadingWatch watch(endIfAsked);
  const SessionReport report = sessionReport(session, settings, progress.callback());
  if (wants_page) writeFile(page, reportPage(report, progress.callback()));
  progress.clear();
  if (arguments.json) return printNumbers(reportJson(report));
  printSentences(reportSentences(report), arguments.file, page);
}

void runReport(const ReportArguments& arguments) {
  if (isOthers(arguments.file)) return runOtherReport(arguments);
  if (!arguments.trainee.empty() || !arguments.only_class.empty() || arguments.whole_class) {
    throw Error::inFile(arguments.file.string(),
                        "is no record of training (.results); --trainee and --class ask for one");
  }
  runSessionReport(arguments);
}

}  // namespace

void offerReportSource(const ReportSource& source) { otherSource() = source; }

void addReportCommand(CLI::App& app) {
  const auto arguments = std::make_shared<ReportArguments>();
  ReportArguments& a = *arguments;
  CLI::App& command = *app.add_subcommand(
      "report",
      "Tell what a recorded session was (forces, contacts, phases, maps of the body), or how training went (learning "
      "curve, accuracy, what was felt; of a trainee or a class), as one HTML page");
  command
      .add_option("FILE", a.file,
                  "Session file, or record of training (.results, or a class's PostgreSQL: postgresql://...)")
      ->required();
  command.add_option("-o,--out", a.out,
                     "Page to write; left out: the file's name with .html (of a database class.html), in this folder");
  addTimeSpan(command, a.span);
  command.add_option("--folder", a.folder,
                     "Where the files that the scene names lie now; left out: in the session, else where they lay");
  CLI::Option& trainee = *command.add_option(
      "--trainee", a.trainee, "Of a record of training: one trainee, by code or by the first letters of the pseudonym");
  command.add_flag("--class", a.whole_class, "Of a record of training: all trainees, also where there is but one")
      ->excludes(&trainee);
  command.add_option("--class-word", a.only_class, "The same, of one class where the record has several")
      ->excludes(&trainee);
  command.add_flag("--json", a.json, "Print all numbers as one JSON object; a page is written then only with --out");
  command.callback([=] { runReport(*arguments); });
}

}  // namespace palpate::app
