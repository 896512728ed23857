// `palpate class serve DIR`: collects a class's rows, and with --broker runs the broker too.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>

#include "apps/palpate/common/commands.h"
#include "apps/palpate/common/interruption.h"
#include "apps/palpate/common/number_option.h"
#include "apps/palpate/common/progress_line.h"
#include "apps/palpate/train/class_commands.h"
#include "palpate/base/error.h"
#include "palpate/base/stopwatch.h"
#include "palpate/base/text.h"
#include "palpate/classroom/broker_process.h"
#include "palpate/classroom/certificates.h"
#include "palpate/classroom/class_folder.h"
#include "palpate/classroom/collector.h"

namespace palpate::app {

namespace {

struct ClassServeArguments {
  std::string folder;
  std::string records;
  std::string database;
  bool broker = false;
  double seconds = 0.0;
  bool json = false;
};

std::unique_ptr<classroom::RowSink> sinkFor(const ClassServeArguments& arguments,
                                            const classroom::ClassFolder& folder) {
  // The class itself; its stations say themselves what they are.
  const training::ClassRow of{folder.class_id, folder.label, folder.retention.days, folder.retention.samples_days};
  if (!arguments.database.empty()) return classroom::databaseSink(arguments.database, of);
  if (!arguments.records.empty()) return classroom::fileSink(arguments.records, of);
  return classroom::fileSink(folder.folder / "class.results", of);
}

void tryDatabase(classroom::RowSink& sink) {
  try {
    sink.keep({});
  } catch (const Error& error) {
    say(fmt::format("palpate: the database does not answer yet: {}\n", error.what()));
  }
}

nlohmann::ordered_json jsonOf(const classroom::CollectorReport& report, bool broker) {
  return {{"connected", report.connected}, {"database", report.database}, {"broker_runs", broker},
          {"stations", report.stations},   {"rows", report.rows},         {"trials", report.trials},
          {"commits", report.commits},     {"refused", report.refused},   {"dropped", report.dropped},
          {"inbox", report.inbox},         {"trouble", report.trouble}};
}

std::string textOf(const classroom::CollectorReport& report) {
  std::string text = fmt::format("{} stations, {} rows, {} trials", report.stations, report.rows, report.trials);
  if (!report.connected) text += "; no broker";
  if (!report.database) text += "; no database";
  if (!report.trouble.empty()) text += fmt::format(" ({})", report.trouble);
  return text;
}

/// When a station was last removed; nothing: never.
std::optional<std::filesystem::file_time_type> lastRemoval(const classroom::ClassFolder& folder) {
  std::error_code none;
  const auto time = std::filesystem::last_write_time(folder.revocationList(), none);
  return none ? std::nullopt : std::optional(time);
}

/// Starts a broker again that died, or that must read whom it lets in no longer; a port that is still taken is tried
/// until it is free.
class BrokerKeeper {
 public:
  explicit BrokerKeeper(const classroom::ClassFolder& folder)
      : folder_(folder), broker_(folder, folder.broker() / "broker.log"), removal_(lastRemoval(folder)) {}

  bool running() { return broker_.running(); }
  void attend() {
    const auto removal = lastRemoval(folder_);
    const bool removed = removal != removal_;
    if (!removed && broker_.running()) return;
    try {
      if (removed) classroom::writeBrokerConfiguration(folder_);
      broker_.restart();
      removal_ = removal;
      say(removed ? "palpate: a station was removed; the broker was started again\n"
                  : "palpate: the broker had ended and was started again\n");
    } catch (const Error& error) {
      say(fmt::format("palpate: {}\n", error.what()));
    }
  }

 private:
  const classroom::ClassFolder& folder_;
  classroom::BrokerProcess broker_;
  std::optional<std::filesystem::file_time_type> removal_;
};

void runClassServe(const ClassServeArguments& arguments) {
  const classroom::ClassFolder folder = classroom::readClassFolder(arguments.folder);
  classroom::Member member = classroom::readMember(folder.ingest());
  const FinishesInOrder in_order;
  std::optional<BrokerKeeper> broker;
  if (arguments.broker) {
    broker.emplace(folder);
    member.host = "localhost";
  }
  auto sink = sinkFor(arguments, folder);
  tryDatabase(*sink);
  const classroom::Collector collector(member, std::move(sink));
  ProgressLine progress;
  const auto started = Clock::now();
  auto next = started;
  std::string said;
  while (endAskedBy() == 0 && (arguments.seconds <= 0.0 || secondsSince(started) < arguments.seconds)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    if (Clock::now() < next) continue;
    next += std::chrono::seconds(1);
    if (broker) broker->attend();
    const classroom::CollectorReport report = collector.report();
    if (arguments.json) {
      fmt::print("{}\n", jsonOf(report, broker && broker->running()).dump());
      std::fflush(stdout);
    } else if (const std::string text = textOf(report); text != said) {
      progress.show(text, 0.0);
      said = text;
    }
  }
  progress.clear();
  if (!arguments.json) fmt::print("{}\n", textOf(collector.report()));
}

}  // namespace

void addClassServeCommand(CLI::App& parent) {
  const auto arguments = std::make_shared<ClassServeArguments>();
  CLI::App& command = *parent.add_subcommand("serve", "Collect what the stations of a class record");
  command.add_option("DIR", arguments->folder, "Folder of the class")->required();
  CLI::Option* records = command.add_option("--records", arguments->records,
                                            "Into this SQLite file; without it and --database DIR/class.results");
  command
      .add_option("--database", arguments->database,
                  "Into PostgreSQL: \"host=/run/postgresql dbname=class\" or postgresql://...")
      ->excludes(records);
  command.add_flag("--broker", arguments->broker, "Run mosquitto too, with the class's configuration");
  addNumber(command, "--seconds", arguments->seconds, between(0.0, 1e6, "s"), "End by itself after so long; 0: never");
  command.add_flag("--json", arguments->json, "Print a JSON object each second");
  command.callback([arguments] { runClassServe(*arguments); });
}

}  // namespace palpate::app
