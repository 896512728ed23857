// `palpate class serve DIR`: collects a class's rows, and with --broker runs the broker too.
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "class/commands/class_commands.h"
#include "cli/kit/choice_option.h"
#include "cli/kit/interruption.h"
#include "cli/kit/number_option.h"
#include "cli/kit/options.h"
#include "cli/kit/progress_line.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/language.h"
#include "palpate/base/stopwatch.h"
#include "palpate/base/text.h"
#include "palpate/classroom/broker_process.h"
#include "palpate/classroom/certificates.h"
#include "palpate/classroom/class_folder.h"
#include "palpate/classroom/collector.h"

namespace palpate::app {

namespace {

constexpr auto kWarnsAgain = std::chrono::hours(24);

struct ClassServeArguments {
  std::string folder;
  std::string records;
  std::string database;
  bool broker = false;
  double seconds = 0.0;
  bool json = false;
  std::string language = "en";
};

std::unique_ptr<classroom::RowSink> sinkFor(const ClassServeArguments& arguments,
                                            const classroom::ClassFolder& folder) {
  // The class itself; its stations describe themselves.
  const classroom::SinkRules of{
      training::ClassRow{folder.class_id, folder.label, folder.retention.days, folder.retention.samples_days},
      folder.station_megabytes << 20, folder.trainee_key};
  if (!arguments.database.empty()) return classroom::databaseSink(arguments.database, of);
  if (!arguments.records.empty()) return classroom::fileSink(arguments.records, of);
  return classroom::fileSink(folder.folder / "class.results", of);
}

void tryDatabase(classroom::RowSink& sink) {
  try {
    sink.save({});
  } catch (const Error& error) {
    say(fmt::format("palpate: the database does not answer yet: {}\n", error.what()));
  }
}

Json toJson(const classroom::CollectorReport& report, bool broker) {
  return {{"connected", report.connected}, {"database", report.database}, {"broker_runs", broker},
          {"stations", report.stations},   {"rows", report.rows},         {"trials", report.trials},
          {"commits", report.commits},     {"waited", report.waited},     {"refused", report.refused},
          {"dropped", report.dropped},     {"inbox", report.inbox},       {"inbox_bytes", report.inbox_bytes},
          {"trouble", report.trouble}};
}

std::string textOf(const classroom::CollectorReport& report) {
  std::string text = trnf("{} station, {} rows, {} trials", "{} stations, {} rows, {} trials", report.stations,
                          report.stations, report.rows, report.trials);
  if (report.refused > 0) text += trf(", {} refused", report.refused);
  if (!report.connected) text += tr("; no broker");
  if (!report.database) text += tr("; no database");
  if (!report.trouble.empty()) text += fmt::format(" ({})", report.trouble);
  return text;
}

/// When a station was last removed, and when the broker's certificate was made; the beginning of time: never.
using BrokerFiles = std::array<std::filesystem::file_time_type, 2>;
BrokerFiles brokerFiles(const classroom::ClassFolder& folder) {
  BrokerFiles times{};
  std::error_code none;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto time =
        std::filesystem::last_write_time(i == 0 ? folder.revocationList() : folder.broker() / "server.crt", none);
    if (!none) times.at(i) = time;
  }
  return times;
}

void warnAboutCertificates(const classroom::ClassFolder& folder) {
  for (const std::string& line : classroom::certificateWarnings(classroom::certificateLives(folder))) {
    say(fmt::format("palpate: {}\n", line));
  }
}

/// Starts a broker again that died, or that must read its revocations; a port that is still taken is tried until it is
/// free.
class BrokerKeeper {
 public:
  explicit BrokerKeeper(const classroom::ClassFolder& folder)
      : folder_(folder), broker_(folder, folder.broker() / "broker.log"), files_(brokerFiles(folder)) {}

  bool running() { return broker_.running(); }
  void supervise() {
    const BrokerFiles files = brokerFiles(folder_);
    const bool changed = files != files_;
    if (!changed && broker_.running()) return;
    try {
      if (changed) classroom::writeBrokerConfiguration(folder_);
      broker_.restart();
      const bool removed = files[0] != files_[0];
      files_ = files;
      say(removed   ? "palpate: a station was removed; the broker was started again\n"
          : changed ? "palpate: the broker has a new certificate and was started again\n"
                    : "palpate: the broker had ended and was started again\n");
    } catch (const Error& error) {
      say(fmt::format("palpate: {}\n", error.what()));
    }
  }

 private:
  const classroom::ClassFolder& folder_;
  classroom::BrokerProcess broker_;
  BrokerFiles files_;
};

void runClassServe(const ClassServeArguments& arguments) {
  useLanguage(arguments.language);
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
  classroom::Collector collector(member, std::move(sink));
  warnAboutCertificates(folder);
  auto warns_next = Clock::now() + kWarnsAgain;
  ProgressLine progress;
  const auto started = Clock::now();
  auto next = started;
  std::string said;
  while (endingSignal() == 0 && (arguments.seconds <= 0.0 || secondsSince(started) < arguments.seconds)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    if (Clock::now() < next) continue;
    next += std::chrono::seconds(1);
    if (broker) broker->supervise();
    if (Clock::now() >= warns_next) {
      warnAboutCertificates(folder);
      warns_next += kWarnsAgain;
    }
    const classroom::CollectorReport report = collector.report();
    const std::vector<std::string> lines = collector.drainReports();
    if (!arguments.json) {
      for (const std::string& line : lines) say(fmt::format("palpate: {}\n", line));
    }
    if (arguments.json) {
      Json json = toJson(report, broker && broker->running());
      json["said"] = lines;
      fmt::print("{}\n", jsonDump(json));
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

void addClassServeCommand(Command& parent) {
  const auto [command, arguments] =
      addCommand(parent, "serve", "Collect the records of a class's stations", runClassServe);
  command.add_option("DIR", arguments.folder, "Folder of the class")->required();
  Option* records = command.add_option("--records", arguments.records,
                                       "SQLite file to store records in (default: DIR/class.results)");
  command
      .add_option("--database", arguments.database,
                  "PostgreSQL to store records in: \"host=/run/postgresql dbname=class\" or postgresql://...")
      ->excludes(records);
  command.add_flag("--broker", arguments.broker, "Also run mosquitto, with the class's configuration");
  addNumber(command, "--seconds", arguments.seconds, between(0.0, 1e6, "s"), "Stop after this time; 0: never");
  command.add_flag("--json", arguments.json, "Print one JSON object per second");
  addLanguage(command, arguments.language);
}

}  // namespace palpate::app
