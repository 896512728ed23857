#include "class/commands/class_load.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/base/random.h"
#include "palpate/base/stopwatch.h"
#include "palpate/classroom/mqtt_link.h"
#include "palpate/classroom/station_link.h"
#include "palpate/training/records/trainee_code.h"
#include "palpate/training/sha256.h"

namespace palpate::app {

namespace {

using classroom::StationLink;
using training::Store;

constexpr int kSites = 12;
constexpr int kTrialsOfBlock = 40;
constexpr auto kLiveEvery = std::chrono::milliseconds(100);

double steadyNowS() { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); }
training::Uuid newId() { return training::makeUuidV7(training::utcMs(), training::systemRandom()); }

/// A trainee who answers at random: the class counts rows, whatever is in them.
class LoadedStation {
 public:
  LoadedStation(const classroom::Member& member, const std::filesystem::path& records, std::uint64_t seed)
      : store_(records, Store::Open::create_too), random_(seed) {
    begin(member);
    link_ = std::make_unique<StationLink>(member, store_, classroom::StationInfo{"palpate load", "none"});
  }

  void live() {
    classroom::LiveSample sample;
    sample.force_n = random_.uniform(0.0, 3.0);
    sample.finger_mm = {random_.uniform(-80.0, 80.0), random_.uniform(0.0, 400.0), 120.0};
    sample.site = 1 + static_cast<int>(random_.below(kSites));
    sample.sites_pressed = static_cast<int>(random_.below(kSites + 1));
    link_->publishLive(sample);
  }

  training::Uuid answer() {
    training::TrialRow trial;
    trial.id = newId();
    trial.block_id = block_.id;
    trial.session_id = session_.id;
    trial.number = ++trials_;
    trial.end_ms = training::utcMs();
    trial.start_ms = trial.end_ms - 20'000;
    trial.seconds = 20.0;
    trial.change = 0.28;
    trial.site_true = 1 + static_cast<int>(random_.below(kSites));
    trial.site_answer = random_.below(2) == 0 ? trial.site_true : 1 + static_cast<int>(random_.below(kSites));
    trial.correct = trial.site_true == trial.site_answer;
    trial.sites_felt = kSites;
    trial.peak_force_n = 2.0;
    for (int site = 1; site <= kSites; ++site) trial.visits.push_back({site, 2, 700.0, 2.0, 1.2, 4.0});
    block_.trials = trials_;
    block_.threshold = 0.28 / std::sqrt(trials_);
    block_.threshold_low = 0.6 * block_.threshold;
    block_.threshold_high = 1.6 * block_.threshold;
    block_.finished = trials_ % kTrialsOfBlock == 0;
    wrong_in_a_row_ = trial.correct ? 0 : wrong_in_a_row_ + 1;
    block_.state_json += fmt::format("[{},{}]", trial.site_true, trial.site_answer);
    const training::Uuid id = trial.id;
    const double trial_change = trial.change;
    store_.save(std::vector<training::Row>{block_, std::move(trial)});
    classroom::StationState state;
    state.session = session_.id;
    state.trainee = session_.trainee_id;
    state.screen = training::Screen::trial;
    state.kind = training::SessionKind::pre_test;
    state.trial = trials_ + 1;
    state.trials_at_most = kTrialsOfBlock;
    state.change = trial_change;
    state.wrong_in_a_row = wrong_in_a_row_;
    state.palpate_force_n = random_.uniform(0.4, 2.0);
    link_->publishState(state);
    return id;
  }
  double nextAnswerIn(double mean_s) { return mean_s * random_.uniform(0.5, 1.5); }

  const StationLink& link() const { return *link_; }

 private:
  void begin(const classroom::Member& member) {
    training::TraineeRow trainee;
    trainee.id = newId();
    trainee.class_id = member.class_id;
    trainee.created_ms = training::utcMs();
    training::ProtocolRow protocol{"load", 1, "", training::sha256Hex("load")};
    session_.id = newId();
    session_.trainee_id = trainee.id;
    session_.station_id = member.station_id;
    session_.start_ms = training::utcMs();
    session_.app_version = "load";
    block_.id = newId();
    block_.session_id = session_.id;
    block_.protocol_id = protocol.id;
    store_.save(training::ClassRow{.id = member.class_id});
    store_.save(training::StationRow{member.station_id, member.name, "", "none", 0});
    store_.save(trainee);
    store_.save(protocol);
    store_.save(std::vector<training::Row>{session_, block_});
  }

  Store store_;
  Random random_;
  training::SessionRow session_;
  training::BlockRow block_;
  int trials_ = 0;
  int wrong_in_a_row_ = 0;
  std::unique_ptr<StationLink> link_;
};

/// Name of the i-th loaded station.
const std::string& loadedName(const classroom::ClassFolder& folder, const ClassLoadSettings& load, int i) {
  const int at = load.first - 1 + i;
  return folder.stations.at(static_cast<std::size_t>(at));
}

/// An instructor's certificate of its own: several loads watch at once, and a certificate is one connection.
classroom::Member ensureInstructor(const classroom::ClassFolder& folder, const ClassLoadSettings& load) {
  const int number = std::min(classroom::kMaxInstructors, 2 + (load.first - 1) / std::max(1, load.stations));
  while (!std::filesystem::exists(folder.instructor(number) / "instructor.toml")) classroom::addInstructor(folder);
  return classroom::readMember(folder.instructor(number));
}

/// The instructor: counts live samples and how long they took.
class LoadViewer {
 public:
  LoadViewer(const classroom::ClassFolder& folder, const ClassLoadSettings& load) {
    classroom::MqttSettings settings = classroom::makeMqttSettings(ensureInstructor(folder, load));
    for (int i = 0; i < load.stations; ++i) {
      const std::string& name = loadedName(folder, load, i);
      settings.subscriptions.push_back({classroom::topicText({folder.class_id, name, "live"}), 0});
    }
    link_ = std::make_unique<classroom::MqttLink>(
        settings, classroom::MqttHandlers{[this](std::string_view, std::string_view text) { seen(text); }, {}});
  }
  bool connected() const { return link_->connected(); }
  void stopCounting() { link_.reset(); }

  void fill(ClassLoadReport& report) {
    std::ranges::sort(delays_ms_);
    report.live_seen = delays_ms_.size();
    if (delays_ms_.empty()) return;
    const auto at = [&](double share) {
      return delays_ms_[static_cast<std::size_t>(share * static_cast<double>(delays_ms_.size() - 1))];
    };
    report.delay_p50_ms = at(0.5);
    report.delay_p99_ms = at(0.99);
    report.delay_max_ms = delays_ms_.back();
  }

 private:
  void seen(std::string_view text) {
    const double now_s = steadyNowS();
    if (const auto live = classroom::parseLive(text)) {
      delays_ms_.push_back(1000.0 * (now_s - live->envelope.monotonic_s));
    }
  }
  std::vector<double> delays_ms_;  ///< the connection's thread alone, until it has ended
  std::unique_ptr<classroom::MqttLink> link_;
};

using Stations = std::vector<std::unique_ptr<LoadedStation>>;

Stations makeStations(const classroom::ClassFolder& folder, const ClassLoadSettings& settings) {
  Stations stations;
  for (int i = 0; i < settings.stations; ++i) {
    const std::string& name = loadedName(folder, settings, i);
    stations.push_back(std::make_unique<LoadedStation>(classroom::readMember(folder.station(name)),
                                                       settings.folder / (name + ".results"),
                                                       static_cast<std::uint64_t>(settings.first + i)));
  }
  return stations;
}

std::size_t countUnsentRows(const Stations& stations) {
  std::size_t waiting = 0;
  for (const auto& station : stations) waiting += station->link().waiting();
  return waiting;
}

/// Answers, each station at its own pace; in a thread of its own, since each waits for the disk.
class Answers {
 public:
  Answers(Stations& stations, double every_s, ClassLoadReport& report)
      : stations_(stations), every_s_(every_s), report_(report), thread_([this] { run(); }) {}
  ~Answers() {
    ending_ = true;
    thread_.join();
  }
  Answers(const Answers&) = delete;
  Answers& operator=(const Answers&) = delete;

 private:
  void run() {
    std::vector<double> next(stations_.size());
    for (std::size_t i = 0; i < next.size(); ++i) next[i] = steadyNowS() + stations_[i]->nextAnswerIn(0.7 * every_s_);
    while (!ending_) {
      for (std::size_t i = 0; i < next.size() && !ending_; ++i) {
        if (steadyNowS() < next[i]) continue;
        const double began_s = steadyNowS();
        report_.trials.insert(stations_[i]->answer());
        report_.longest_keep_ms = std::max(report_.longest_keep_ms, 1000.0 * (steadyNowS() - began_s));
        next[i] += stations_[i]->nextAnswerIn(every_s_);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
  Stations& stations_;
  double every_s_;
  ClassLoadReport& report_;
  std::atomic<bool> ending_ = false;
  std::thread thread_;
};

bool allConnected(const Stations& stations) {
  return std::ranges::all_of(stations, [](const auto& station) { return station->link().connected(); });
}

}  // namespace

ClassLoadReport runClassLoad(const classroom::ClassFolder& folder, const ClassLoadSettings& settings,
                             const std::function<bool(double done_s)>& going) {
  if (static_cast<int>(folder.stations.size()) < settings.first - 1 + settings.stations) {
    throw Error(fmt::format("the class has only {} station{}; lower --stations or --first", folder.stations.size(),
                            folder.stations.size() == 1 ? "" : "s"));
  }
  ClassLoadReport report;
  report.stations = settings.stations;
  Stations stations = makeStations(folder, settings);
  LoadViewer viewer(folder, settings);
  while (!(viewer.connected() && allConnected(stations)) && going(0.0)) std::this_thread::sleep_for(kLiveEvery);
  const auto started = Clock::now();
  {
    const Answers answers(stations, settings.trial_every_s, report);
    for (auto next = started; secondsSince(started) < settings.seconds && going(secondsSince(started));) {
      for (const auto& station : stations) station->live();
      next += kLiveEvery;
      std::this_thread::sleep_until(next);
    }
  }
  const auto ended = Clock::now();
  std::this_thread::sleep_for(std::chrono::milliseconds(500));  // lets messages in transit arrive
  viewer.stopCounting();
  viewer.fill(report);
  while (countUnsentRows(stations) > 0 && secondsSince(ended) < settings.catch_up_s && going(settings.seconds)) {
    std::this_thread::sleep_for(kLiveEvery);
  }
  report.waiting = countUnsentRows(stations);
  report.caught_up_s = report.waiting == 0 ? secondsSince(ended) : -1.0;
  for (const auto& station : stations) {
    const classroom::LinkCounts counts = station->link().counts();
    report.live_sent += counts.live;
    report.rows_sent += counts.rows;
    report.repeats += counts.repeats;
  }
  return report;
}

}  // namespace palpate::app
