// Options -> records, body, trainees -> their sessions, one line each, and a report for machines.
#include "cli/kit/options.h"
#include "teach/commands/class_part.h"
#include "teach/commands/train_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <map>
#include <numeric>
#include <optional>
#include <thread>
#include <vector>

#include "cli/kit/interruption.h"
#include "cli/kit/number_option.h"
#include "cli/kit/output_place.h"
#include "cli/kit/progress_line.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/stopwatch.h"
#include "palpate/base/text.h"
#include "palpate/training/records/class_names.h"
#include "palpate/training/records/trainee_code.h"
#include "palpate/training/trainee/body_touch.h"
#include "palpate/training/trainee/imagined_touch.h"
#include "palpate/training/trainee/trainee_course.h"

namespace palpate::app {

namespace {

using training::SessionKind;
using training::SessionOutcome;
/// "2026-01-05T09:00:00Z" or "2026-01-05".
std::int64_t startMs(const std::string& words) {
  std::tm time{};
  const char* rest = ::strptime(words.c_str(), "%Y-%m-%d", &time);
  if (rest != nullptr && *rest != '\0') rest = ::strptime(rest, "T%H:%M:%SZ", &time);
  if (rest == nullptr || *rest != '\0') {
    throw Error(fmt::format("--start '{}' is not a time like 2026-01-05T09:00:00Z", words));
  }
  return std::int64_t{1000} * ::timegm(&time);
}

std::string formatPercentNumber(double share) { return fmt::format("{:.3g}", 100.0 * share); }

int countFlaggedTrials(const SessionOutcome& sat, int sites) {
  return static_cast<int>(
      std::ranges::count_if(sat.trials, [&](const training::TrialRow& trial) { return trial.sites_felt < sites; }));
}

int countCorrectTrials(const SessionOutcome& sat) {
  return static_cast<int>(std::ranges::count_if(sat.trials, &training::TrialRow::correct));
}

std::string lumpTrialLine(const training::TrialRow& trial) {
  const lumps::LumpTrial body = lumps::parseLumpTrial(trial.lumps);
  return fmt::format("  body {:2}: {} lumps, the plainest C = {:.3g}, {} places named: {}; {:.1f} s\n", trial.number,
                     body.hidden.size(), trial.change, body.findings.size(), trial.correct ? "right" : "wrong",
                     trial.seconds);
}

std::string trialLine(const training::TrialRow& trial) {
  if (!trial.lumps.empty()) return lumpTrialLine(trial);
  const char* verdict = trial.timed_out ? "no answer in time" : trial.correct ? "right" : "wrong";
  return fmt::format("  trial {:2}: change {} %, site {}, answered {}: {}; {} felt, {:.1f} s\n", trial.number,
                     formatPercentNumber(trial.change), trial.site_true, trial.site_answer, verdict, trial.sites_felt,
                     trial.seconds);
}

std::string formatLumpResults(const SessionOutcome& sat) {
  const lumps::LumpCounts& counts = sat.lumps;
  std::string words =
      fmt::format("; {} of {} lumps found, {} false alarms", counts.found, counts.lumps, counts.false_places);
  if (counts.without > 0) {
    words += fmt::format("; {} of {} bodies without recognised", counts.without - counts.said_without, counts.without);
  }
  if (counts.lumps > 0) {
    words += fmt::format("; half are found at C = {:.2g} ({:.2g} to {:.2g})", counts.threshold.median,
                         counts.threshold.low, counts.threshold.high);
  }
  if (sat.block.verdict != training::Verdict::none) words += fmt::format("; {}", wordFor(sat.block.verdict));
  return words;
}

/// The end of a line about a session.
std::string formatSessionTime(const SessionOutcome& sat, double wall_s) {
  return fmt::format("{}; {:.1f} min in {:.1f} s\n", sat.block.finished ? "" : "; put down", sat.simulated_s / 60.0,
                     wall_s);
}

std::string sessionLine(const SessionOutcome& sat, int sites, double wall_s) {
  const training::BlockRow& block = sat.block;
  std::string line =
      fmt::format("{}: {} trials, {} right", wordFor(sat.row.kind), sat.trials.size(), countCorrectTrials(sat));
  if (training::hidesLumps(sat.row.kind)) return line + formatLumpResults(sat) + formatSessionTime(sat, wall_s);
  if (sat.resumed) line += ", went on with an earlier block";
  if (block.trials > 0) {
    line += fmt::format("; T {} % ({} to {} %)", formatPercentNumber(block.threshold),
                        formatPercentNumber(block.threshold_low), formatPercentNumber(block.threshold_high));
  }
  if (block.mastered_change) line += fmt::format("; level {} %", formatPercentNumber(*block.mastered_change));
  if (block.verdict != training::Verdict::none) line += fmt::format("; {}", wordFor(block.verdict));
  if (const int flagged = countFlaggedTrials(sat, sites); flagged > 0) {
    line += fmt::format("; {} trials with places not felt", flagged);
  }
  return line + formatSessionTime(sat, wall_s);
}

Json lumpsJson(const SessionOutcome& sat) {
  if (!training::hidesLumps(sat.row.kind)) return nullptr;
  const lumps::LumpCounts& counts = sat.lumps;
  return {{"bodies", counts.bodies},
          {"with", counts.with},
          {"without", counts.without},
          {"said_with", counts.said_with},
          {"said_without", counts.said_without},
          {"hidden", counts.lumps},
          {"found", counts.found},
          {"false_places", counts.false_places}};
}

Json sessionOutcomeJson(const SessionOutcome& sat, int sites) {
  const training::BlockRow& block = sat.block;
  return {{"sitting", sat.row.id},
          {"kind", wordFor(sat.row.kind)},
          {"start_ms", sat.row.start_ms},
          {"device", sat.row.device},
          {"file", sat.row.file},
          {"file_sha256", sat.row.file_sha256},
          {"block", block.id},
          {"resumed", sat.resumed},
          {"finished", block.finished},
          {"trials", sat.trials.size()},
          {"right", countCorrectTrials(sat)},
          {"counted", block.trials},
          {"flagged", countFlaggedTrials(sat, sites)},
          {"threshold", block.threshold},
          {"low", block.threshold_low},
          {"high", block.threshold_high},
          {"level", block.mastered_change ? Json(*block.mastered_change) : Json(nullptr)},
          {"verdict", wordFor(block.verdict)},
          {"lumps", lumpsJson(sat)},
          {"simulated_s", sat.simulated_s}};
}

/// The trainee's own finger in place of the scene's plans.
scene::Scene withOneFingertip(scene::Scene scene, bool standard) {
  constexpr double kFingertipMm = 8.0;
  if (standard || scene.fingers.empty()) {
    scene::Finger fingertip;
    fingertip.name = "index";
    fingertip.radius_mm = kFingertipMm;
    scene.fingers = {fingertip};
  }
  scene.fingers.resize(1);
  scene.fingers.front().steps.clear();
  scene.fingers.front().trajectory.clear();
  return scene;
}

/// One run of the command.
class TraineeCommand {
 public:
  TraineeCommand(const TrainOptions& options, const TraineeOptions& simulated)
      : options_(options),
        simulated_(simulated),
        finds_lumps_(training::hidesLumps(kindAskedFor(options).value_or(SessionKind::pre_test))),
        observer_(finds_lumps_ ? training::ObserverSettings() : training::observerNamed(options.trainee)),
        lump_observer_(finds_lumps_ ? training::lumpTraineeNamed(options.trainee) : training::LumpTraineeSettings()),
        seed_(options.seed.value_or(finds_lumps_ ? lump_observer_.seed : observer_.seed)),
        start_ms_(startMs(simulated.start)) {
    // Faults are reported before a body is built.
    if (simulated.trainees > 1 && !options.code.empty()) throw Error("--code is one trainee's; --trainees are several");
    if (!options.code.empty() && !training::codeTyped(options.code)) {
      throw Error(fmt::format("--code '{}' is not a code: a letter of it is wrong", options.code));
    }
    if (!options.out.empty()) requireWritableFile(options.out);
    bench_.hand = device::handChoice(simulated.hand);
    bench_.protocol = protocolAskedFor(options);
    if (finds_lumps_) {
      if (!training::isLumpTrainee(options.trainee)) {
        throw Error("--trainee: lump sessions need observer=lump,spread=3.4,...");
      }
      if (simulated.fast) throw Error("--fast: lumps are felt on a body");
      if (simulated.programme) throw Error("--programme has no lump sessions");
    }
    if (!options.class_id.empty() && !training::isClassWord(options.class_id)) {
      station_ = classPart().station(options.class_id);
    }
  }

  int run() {
    openBench();
    const std::filesystem::path file = recordsFile(options_);
    training::Store store(file, training::Store::Open::create_too);
    storeReferencedRows(store);
    std::optional<training::ClassLink> link;
    if (station_) link = station_->connect(store, "palpate, simulated", describeDevice());
    for (int i = 0; i < simulated_.trainees && endingSignal() == 0; ++i) train(store, i);
    if (link) sendWaiting(store);
    progress_.clear();
    finish(store);
    return endingSignal() == 0 ? 0 : signalExitCode(endingSignal());
  }

 private:
  std::string formatTrainee(const training::TraineeCourse& course) const {
    return finds_lumps_ ? training::formatLumpTrainee(course.lump_observer) : training::formatObserver(course.observer);
  }
  std::string classId() const { return station_ ? station_->of.id : options_.class_id; }
  std::string describeDevice() const {
    return simulated_.fast ? std::string(training::kNoBody) : training::describeDevice(bench_.hand);
  }

  /// Stores the rows that the first session refers to.
  void storeReferencedRows(training::Store& store) {
    training::StationRow station = training::simulatedStation(start_ms_);
    station.device = describeDevice();
    if (station_) {
      station.id = station_->row.id;
      station.name = station_->row.name;
    }
    store.save(station);
    store.save(training::makeProtocolRow(bench_.protocol));
    bench_.station = station.id;
    const std::string id = classId();
    const auto known = store.classes();
    if (id.empty() || std::ranges::find(known, id, &training::ClassRow::id) != known.end()) return;
    store.save(training::ClassRow{.id = id, .label = id});
  }

  /// Sends until the class has it all, no progress was made for a while, or the user stopped: the rest goes next time.
  void sendWaiting(training::Store& store) {
    constexpr double kPatienceS = 10.0;
    Clock::time_point went = Clock::now();
    std::size_t before = store.waitingCount();
    while (before > 0 && secondsSince(went) < kPatienceS && endingSignal() == 0) {
      progress_.show(fmt::format("sending to the class, {} rows", before), 0.0);
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      const std::size_t waits = store.waitingCount();
      if (waits < before) went = Clock::now();
      before = waits;
    }
    progress_.clear();
    if (before > 0 && !options_.json) fmt::print("{} rows wait for the class\n", before);
  }

  void openBench() {
    const scene::Scene scene = withOneFingertip(sceneToTrainOn(options_), options_.scene.empty());
    const auto body = scene::build(scene, progress_.display());
    bench_.sites = training::sitesOn(*body, bench_.protocol);
    if (!simulated_.fast) bench_.body = body;
    bench_.recording_files = !options_.no_recording_file;
    bench_.stop = [] { return endingSignal() != 0; };
    bench_.answered = [this](const training::TrialRow& trial) { answered(trial); };
  }

  /// For a class, printing each session would be too much to read.
  bool printsSessions() const { return !options_.json && (simulated_.trainees == 1 || options_.verbose); }

  void answered(const training::TrialRow& trial) {
    if (options_.verbose && !options_.json) {
      progress_.clear();
      fmt::print("{}", trialLine(trial));
      std::fflush(stdout);
    } else {
      progress_.show(fmt::format("{}, trial {}", person_, trial.number), 0.0);
    }
  }

  std::vector<SessionKind> kinds() const {
    if (simulated_.programme) return training::vhbCourse();
    const SessionKind kind = kindAskedFor(options_).value_or(SessionKind::pre_test);
    return std::vector<SessionKind>(static_cast<std::size_t>(options_.sessions), kind);
  }

  void train(training::Store& store, int number) {
    const std::string typed = options_.code.empty() ? training::simulatedCode(seed_, number) : options_.code;
    const std::string code = *training::codeTyped(typed);
    const bool alone = simulated_.trainees == 1;
    const training::TraineeRow row =
        training::simulatedTrainee(classId(), code, start_ms_, station_ ? station_->trainee_key : std::string());
    // Stored again for a class, which may have forgotten a trainee who was away.
    if (const auto known = store.trainee(row.id); !known || station_) store.save(known.value_or(row));
    training::TraineeCourse course;
    course.observer = alone ? observer_ : training::oneOfClass(observer_, simulated_.spread, seed_, number);
    course.lump_observer = lump_observer_;
    course.lump_observer.seed += static_cast<std::uint64_t>(number);
    course.trainee = row.id;
    course.kinds = kinds();
    course.goes_on = simulated_.programme;
    course.seed = seed_ + static_cast<std::uint64_t>(number);
    course.start_ms = start_ms_;
    course.most_trials = simulated_.most_trials;
    person_ = code;
    Json sessions = Json::array();
    if (printsSessions()) fmt::print("trainee {}: {}\n", code, formatTrainee(course));
    Clock::time_point began = Clock::now();
    training::runProgramme(store, bench_, course, [&](const SessionOutcome& sat) {
      sessions.push_back(sessionOutcomeJson(sat, bench_.sites.choices()));
      if (sat.block.finished) finished_[sat.row.kind].push_back(sat.block.threshold);
      if (printsSessions()) {
        progress_.clear();
        fmt::print("{}", sessionLine(sat, bench_.sites.choices(), secondsSince(began)));
        std::fflush(stdout);
      }
      began = Clock::now();
    });
    trainees_.push_back(
        {{"code", code}, {"trainee", row.id}, {"observer", formatTrainee(course)}, {"sittings", std::move(sessions)}});
  }

  void finish(const training::Store& store) {
    const Json report = {{"records", store.file().string()}, {"seed", seed_}, {"trainees", std::move(trainees_)}};
    if (!options_.out.empty()) writeFile(options_.out, jsonDump(report, 2) + "\n");
    if (options_.json) {
      fmt::print("{}\n", jsonDump(report, 2));
      return;
    }
    if (simulated_.trainees > 1) fmt::print("{}", classLines());
    fmt::print("kept in {}\n", store.file().string());
  }

  /// Tests only: intermediate readings of a practice are not results.
  std::string classLines() const {
    std::string lines;
    for (const auto& [kind, thresholds] : finished_) {
      if (training::hidesLumps(kind) || training::settingsOf(bench_.protocol, kind).feedback) continue;
      const auto n = static_cast<double>(thresholds.size());
      const double mean = std::accumulate(thresholds.begin(), thresholds.end(), 0.0) / n;
      double squares = 0.0;
      for (const double threshold : thresholds) squares += (threshold - mean) * (threshold - mean);
      lines += fmt::format("{}: {} trainees, smallest reliable change {} % on average (SD {} %)\n", wordFor(kind),
                           thresholds.size(), formatPercentNumber(mean),
                           formatPercentNumber(std::sqrt(squares / std::max(1.0, n - 1.0))));
    }
    return lines;
  }

  const TrainOptions& options_;
  const TraineeOptions& simulated_;
  bool finds_lumps_;  ///< the session has lumps
  training::ObserverSettings observer_;
  training::LumpTraineeSettings lump_observer_;
  std::uint64_t seed_;
  std::int64_t start_ms_;
  training::TraineeBench bench_;
  std::optional<training::ClassStation> station_;  ///< of a class on the network
  ProgressLine progress_;
  std::string person_;
  Json trainees_ = Json::array();
  std::map<SessionKind, std::vector<double>> finished_;  ///< thresholds of finished blocks
};

}  // namespace

void addTraineeOptions(Command& command, TraineeOptions& options) {
  constexpr const char* kGroup = "Simulated trainee";
  command
      .add_flag("--programme", options.programme,
                "Run the whole programme (pre-test, six practices, post-test), except what the records have already")
      ->group(kGroup);
  command.add_flag("--fast", options.fast, "Touch nothing; compute the felt stiffness as even tissue would give it")
      ->group(kGroup);
  addNumber(command, "--trainees", options.trainees, between(1, 1000),
            "Simulate a class of this many trainees, one after the other")
      ->group(kGroup);
  addNumber(command, "--spread", options.spread, between(0.0, 1.0),
            "Spread of the trainees' thresholds (standard deviation of the logarithm)")
      ->group(kGroup);
  command
      .add_option("--hand", options.hand,
                  "Simulated hand and its device, as for --device hand: thimble,touch_x or stylus_z,premium_3_0")
      ->capture_default_str()
      ->group(kGroup);
  command.add_option("--start", options.start, "Time of the first session (UTC)")->capture_default_str()->group(kGroup);
  addNumber(command, "--most-trials", options.most_trials, between(0, 1000),
            "Interrupt each block after this many trials; 0: never")
      ->group(kGroup);
}

int runTrainee(const TrainOptions& options, const TraineeOptions& simulated) {
  const FinishesInOrder in_order;
  return TraineeCommand(options, simulated).run();
}

}  // namespace palpate::app
