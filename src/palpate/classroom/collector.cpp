#include "palpate/classroom/collector.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <thread>

#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/stopwatch.h"
#include "palpate/classroom/messages.h"
#include "palpate/classroom/mqtt_link.h"

namespace palpate::classroom {

namespace {

using training::AnyRow;

constexpr std::size_t kMostInbox = 20000;  // some 20 MB of rows; more is dropped and comes again
constexpr std::size_t kMostBatch = 500;    // rows of one commit
/// A batch waits so long for company: a commit costs more than its rows.
constexpr auto kGather = std::chrono::milliseconds(20);
constexpr auto kFirstRetry = std::chrono::milliseconds(200);
constexpr auto kLongestRetry = std::chrono::milliseconds(2000);
/// The broker keeps rows for a collector that is away; how many is its own limit, and stations send them again anyway.
constexpr std::uint32_t kSessionExpiryS = 3600;

}  // namespace

struct Collector::Course {
  struct ArrivedRow {
    std::string station;
    std::string kind;
    std::string body;
  };

  struct ReadRow {
    std::string station;
    training::Uuid key;
    AnyRow row;
  };

  static std::optional<ReadRow> readRow(const ArrivedRow& arrived) {
    try {
      AnyRow row = training::rowFromJson(arrived.kind, arrived.body);
      training::Uuid key = training::outboxKey(row);
      return ReadRow{arrived.station, std::move(key), std::move(row)};
    } catch (const Error&) {
      return std::nullopt;
    }
  }

  Course(const Member& member, std::unique_ptr<RowSink> rows_go) : class_id(member.class_id), sink(std::move(rows_go)) {
    MqttSettings settings = linkOf(member);
    settings.session_expiry_s = kSessionExpiryS;
    for (const char* kind :
         {"station", "class", "trainee", "protocol", "session", "block", "trial", "event", "delete"}) {
      settings.subscriptions.push_back({fmt::format("palpate/v1/{}/st/+/{}", class_id, kind), 1});
    }
    settings.subscriptions.push_back({fmt::format("palpate/v1/{}/st/+/state", class_id), 0});
    mqtt.emplace(settings, MqttHandlers{[this](auto where, auto what) { received(where, what); }, {}});
    thread = std::thread([this] { run(); });
  }
  ~Course() {
    {
      const std::lock_guard lock(mutex);
      ending = true;
    }
    woken.notify_all();
    thread.join();
    mqtt.reset();
  }
  Course(const Course&) = delete;
  Course& operator=(const Course&) = delete;

  // In the connection's thread.
  void received(std::string_view where, std::string_view what) {
    const auto at = parseTopic(where);
    if (!at || at->class_id != class_id) return refuse(where);
    if (at->kind == "state") return noteState(at->station, what);
    auto message = isRowKind(at->kind) ? parseRowMessage(what) : std::nullopt;
    if (!message) return refuse(where);
    const std::lock_guard lock(mutex);
    stations.insert(at->station);
    if (inbox.size() >= kMostInbox) {
      ++counts.dropped;
      return;
    }
    inbox.push_back({at->station, at->kind, std::move(message->body)});
    woken.notify_all();
  }
  void refuse(std::string_view where) {
    const std::lock_guard lock(mutex);
    ++counts.refused;
    counts.trouble = fmt::format("no message of a class at {}", oneLine(where));
  }
  /// Who is said to sit where: what a deletion has to take back.
  void noteState(const std::string& station, std::string_view what) {
    const auto state = parseState(what);
    const std::lock_guard lock(mutex);
    if (state) {
      sits[station] = state->content.trainee;
    } else {
      sits.erase(station);
    }
  }

  // In the collector's own thread.
  void run() {
    for (;;) {
      std::vector<ReadRow> batch = nextBatch();
      if (batch.empty()) return;
      keepBatch(batch);
    }
  }
  /// Waits for rows; empty: it is to end.
  std::vector<ReadRow> nextBatch() {
    std::vector<ReadRow> batch;
    std::unique_lock lock(mutex);
    while (batch.empty()) {
      woken.wait(lock, [this] { return ending || !inbox.empty(); });
      if (inbox.empty()) return {};
      woken.wait_for(lock, kGather, [this] { return ending || inbox.size() >= kMostBatch; });
      std::set<training::Uuid> seen;  // a row that was sent again meanwhile
      for (; !inbox.empty() && batch.size() < kMostBatch; inbox.pop_front()) {
        auto row = readRow(inbox.front());
        if (!row) {
          ++counts.refused;
          counts.trouble = fmt::format("{}: a row '{}' that is none", inbox.front().station, inbox.front().kind);
        } else if (seen.insert(row->key).second) {
          batch.push_back(std::move(*row));
        }
      }
    }
    // What others refer to comes first, whatever the order in which it arrived.
    std::ranges::stable_sort(batch, {}, [](const ReadRow& read) { return read.row.index(); });
    return batch;
  }
  void keepBatch(const std::vector<ReadRow>& batch) {
    std::vector<AnyRow> rows;
    rows.reserve(batch.size());
    for (const ReadRow& read : batch) rows.push_back(read.row);
    try {
      const RowSink::Kept kept = sink->keep(rows);
      retry = kFirstRetry;
      noteKept(kept);
      settle(batch, {kept.keys.begin(), kept.keys.end()});
    } catch (const Error& error) {
      // The batch is let go: whatever is in it comes again.
      {
        const std::lock_guard lock(mutex);
        counts.database = false;
        counts.trouble = error.what();
      }
      pauseAfterFailure();
    }
  }
  void noteKept(const RowSink::Kept& kept) {
    const std::lock_guard lock(mutex);
    counts.database = true;
    ++counts.commits;
    counts.refused += kept.refused;
    counts.trouble = kept.why;
  }
  void pauseAfterFailure() {
    std::unique_lock lock(mutex);
    woken.wait_for(lock, retry, [this] { return ending; });
    retry = std::min<std::chrono::milliseconds>(2 * retry, kLongestRetry);
  }
  /// What is in the database is said to be there.
  void settle(const std::vector<ReadRow>& batch, const std::set<training::Uuid>& kept) {
    std::map<std::string, std::vector<training::Uuid>> keys;
    std::uint64_t trials = 0;
    for (const ReadRow& read : batch) {
      if (!kept.contains(read.key)) continue;
      keys[read.station].push_back(read.key);
      trials += std::holds_alternative<training::TrialRow>(read.row) ? 1U : 0U;
      if (const auto* deletion = std::get_if<training::DeletionRow>(&read.row)) forget(*deletion);
    }
    for (const auto& [station, rows] : keys) {
      const Envelope envelope{sequence++, rows.front(),
                              std::chrono::duration<double>(Clock::now().time_since_epoch()).count()};
      for (const std::string& text : ackTexts(envelope, rows)) {
        mqtt->publish({topicText({class_id, station, "ack"}), text, 1, false, 0});
      }
    }
    const std::lock_guard lock(mutex);
    counts.rows += kept.size();
    counts.trials += trials;
  }
  /// The retained messages that name a deleted trainee.
  void forget(const training::DeletionRow& deletion) {
    std::vector<std::string> clear;
    {
      const std::lock_guard lock(mutex);
      for (const auto& [station, trainee] : sits) {
        if (training::deletedMark(trainee) == deletion.trainee_sha256) clear.push_back(station);
      }
      for (const std::string& station : clear) sits.erase(station);
    }
    for (const std::string& station : clear) mqtt->publish({topicText({class_id, station, "state"}), {}, 1, true, 0});
  }

  const std::string class_id;
  std::unique_ptr<RowSink> sink;                  ///< the collector's thread alone
  std::chrono::milliseconds retry = kFirstRetry;  ///< the collector's thread alone
  std::uint64_t sequence = 1;

  mutable std::mutex mutex;  ///< of what follows
  std::condition_variable woken;
  bool ending = false;
  std::deque<ArrivedRow> inbox;
  std::set<std::string> stations;
  std::map<std::string, training::Uuid> sits;
  CollectorReport counts;

  std::optional<MqttLink> mqtt;  ///< after what its thread uses
  std::thread thread;
};

Collector::Collector(const Member& member, std::unique_ptr<RowSink> sink)
    : course_(std::make_unique<Course>(member, std::move(sink))) {}
Collector::~Collector() = default;

CollectorReport Collector::report() const {
  const std::lock_guard lock(course_->mutex);
  CollectorReport report = course_->counts;
  report.inbox = course_->inbox.size();
  report.stations = course_->stations.size();
  report.connected = course_->mqtt && course_->mqtt->connected();
  if (!report.connected && course_->mqtt) report.trouble = course_->mqtt->trouble();
  return report;
}

}  // namespace palpate::classroom
