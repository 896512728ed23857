// `palpate class load DIR`, which the help does not list: a class of simulated stations (class_load.h), and the
// servo loop alongside one station's link. tools/check-class runs it.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "class/commands/class_commands.h"
#include "class/commands/class_load.h"
#include "cli/kit/interruption.h"
#include "cli/kit/json.h"
#include "cli/kit/number_option.h"
#include "cli/kit/progress_line.h"
#include "cli/simulate/realtime_run.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/order_statistics.h"
#include "palpate/classroom/class_store.h"
#include "palpate/classroom/station_link.h"
#include "palpate/scene/presets.h"
#include "palpate/scene/scene_file.h"
#include "palpate/training/records/store.h"
#include "palpate/training/records/trainee_code.h"

namespace palpate::app {

namespace {

struct ClassLoadArguments {
  std::string folder;
  ClassLoadSettings settings;
  std::string records_folder;
  std::string database;
  double servo_s = 0.0;
  int servo_pairs = 7;
};

/// Trials of the whole class. Waits up to a minute for a database that was just killed.
std::multiset<training::Uuid> waitForTrials(const std::string& database) {
  constexpr int kAttempts = 120;
  for (int attempt = 1;; ++attempt) {
    try {
      classroom::ClassStore store(database);
      std::multiset<training::Uuid> there;
      for (const training::AnyRow& row : store.rows().all()) {
        if (const auto* trial = std::get_if<training::TrialRow>(&row)) there.insert(trial->id);
      }
      return there;
    } catch (const classroom::DatabaseAway&) {
      if (attempt == kAttempts) throw;
      std::this_thread::sleep_for(std::chrono::milliseconds(500));
    }
  }
}

/// Against what stations have kept: how many are not there, and how many are there more than once.
Json comparedWith(const std::string& database, const std::set<training::Uuid>& trials) {
  const std::multiset<training::Uuid> there = waitForTrials(database);
  std::size_t lost = 0;
  std::size_t duplicates = 0;
  for (const training::Uuid& id : trials) {
    lost += there.contains(id) ? 0U : 1U;
    duplicates += there.count(id) > 1 ? there.count(id) - 1 : 0;
  }
  return {{"trials_kept", trials.size()}, {"trials_lost", lost}, {"trials_duplicate", duplicates}};
}

void runLoad(const ClassLoadArguments& arguments) {
  const classroom::ClassFolder folder = classroom::readClassFolder(arguments.folder);
  ClassLoadSettings settings = arguments.settings;
  settings.folder = arguments.records_folder;
  const FinishesInOrder in_order;
  ProgressLine progress;
  const ClassLoadReport report = runClassLoad(folder, settings, [&](double done_s) {
    progress.show("class", done_s / settings.seconds);
    return endingSignal() == 0;
  });
  progress.clear();
  const double lost =
      report.live_sent == 0 ? 0.0 : 1.0 - static_cast<double>(report.live_seen) / static_cast<double>(report.live_sent);
  Json json = {{"stations", report.stations},
               {"seconds", settings.seconds},
               {"live_sent", report.live_sent},
               {"live_seen", report.live_seen},
               {"live_lost_percent", 100.0 * lost},
               {"delay_ms", {{"p50", report.delay_p50_ms}, {"p99", report.delay_p99_ms}, {"max", report.delay_max_ms}}},
               {"rows_sent", report.rows_sent},
               {"rows_repeated", report.repeats},
               {"rows_waiting", report.waiting},
               {"caught_up_s", report.caught_up_s},
               {"longest_keep_ms", report.longest_keep_ms}};
  if (!arguments.database.empty()) json.update(comparedWith(arguments.database, report.trials));
  fmt::print("{}\n", jsonDump(json, 2));
}

/// One station's link as the window feeds it: live at sixty pictures a second, an answer every two seconds.
class LinkBesideServo {
 public:
  LinkBesideServo(const classroom::Member& member, const std::filesystem::path& records)
      : store_(records, training::Store::Open::create_too),
        link_(member, store_, {"palpate load", "none"}),
        thread_([this] { run(); }) {}
  ~LinkBesideServo() {
    ending_ = true;
    thread_.join();
  }
  LinkBesideServo(const LinkBesideServo&) = delete;
  LinkBesideServo& operator=(const LinkBesideServo&) = delete;
  bool connected() const { return link_.connected(); }

 private:
  void run() {
    for (int picture = 0; !ending_; ++picture) {
      link_.publishLive({});
      constexpr int kAnswerEvery = 120;
      if (picture % kAnswerEvery == 0) {
        training::TraineeRow row;
        row.id = training::makeUuidV7(training::utcMs(), training::systemRandom());
        store_.save(row);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(16));
    }
  }
  training::Store store_;
  classroom::StationLink link_;
  std::atomic<bool> ending_ = false;
  std::thread thread_;
};

double periodP99Us(const scene::World& world, double seconds, ProgressLine& progress) {
  constexpr double kPeriodUs = 1000.0;
  return kPeriodUs + measureServo(world, seconds, progress.display()).loop.lateness.p99_us;
}

/// In turns, and each of the two first in every other pair, so that whatever else the machine does falls on both.
void runServoBeside(const ClassLoadArguments& arguments) {
  const classroom::ClassFolder folder = classroom::readClassFolder(arguments.folder);
  const classroom::Member member = classroom::readMember(folder.station(folder.stations.front()));
  const auto world = scene::build(scene::standardScene());
  ProgressLine progress;
  std::vector<double> without;
  std::vector<double> with;
  std::vector<double> ratios;
  const auto measure_alone = [&] { without.push_back(periodP99Us(*world, arguments.servo_s, progress)); };
  const auto measure_beside = [&](int pair) {
    const LinkBesideServo link(member,
                               std::filesystem::path(arguments.records_folder) / fmt::format("servo{}.results", pair));
    while (!link.connected()) {
      throwIfInterrupted();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    with.push_back(periodP99Us(*world, arguments.servo_s, progress));
  };
  for (int pair = 0; pair < arguments.servo_pairs; ++pair) {
    const bool alone_first = pair % 2 == 0;
    if (alone_first) measure_alone();
    measure_beside(pair);
    if (!alone_first) measure_alone();
    throwIfInterrupted();
    ratios.push_back(with.back() / without.back());
  }
  progress.clear();
  const Json json = {{"seconds", arguments.servo_s},
                     {"period_p99_us_without", without},
                     {"period_p99_us_with", with},
                     {"ratio_median", upperMedianOf(ratios)}};
  fmt::print("{}\n", jsonDump(json, 2));
}

}  // namespace

void addClassLoadCommand(Command& parent) {
  const auto [command, arguments] = addCommand<ClassLoadArguments>(
      parent, "load", "A class of simulated stations, to measure with",
      [](const ClassLoadArguments& a) { a.servo_s > 0.0 ? runServoBeside(a) : runLoad(a); });
  command.group("");  // for tools/check-class
  command.add_option("DIR", arguments.folder, "Folder of the class")->required();
  command.add_option("--records-folder", arguments.records_folder, "Folder of the stations' records")->required();
  addNumber(command, "--stations", arguments.settings.stations, between(1, 100), "Number of stations");
  addNumber(command, "--first", arguments.settings.first, between(1, 999), "Number of the first station");
  addNumber(command, "--seconds", arguments.settings.seconds, between(1.0, 86400.0, "s"), "Duration");
  addNumber(command, "--trial-every", arguments.settings.trial_every_s, between(0.1, 3600.0, "s"),
            "Mean time between the trials of a station");
  command.add_option("--database", arguments.database, "Compare this PostgreSQL with what was recorded");
  addNumber(command, "--servo", arguments.servo_s, between(0.0, 600.0, "s"),
            "Time the servo loop instead, this long without and with one station's link");
}

}  // namespace palpate::app
