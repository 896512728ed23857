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

// Rows that do not fit are dropped; their station sends them again. Bytes as unpacked: 263 on the way may be 64 kB
// here.
constexpr std::size_t kMaxInboxRows = 20000;
constexpr std::size_t kMaxInboxBytes = std::size_t{32} << 20;
constexpr std::size_t kMaxStationBytes = std::size_t{4} << 20;  // one station's share
constexpr std::size_t kRowBytes = 200;                          // besides its text
constexpr std::size_t kMaxBatchBytes = std::size_t{8} << 20;
constexpr std::size_t kMaxBatch = 500;  // rows of one commit
/// A batch waits so long for company: a commit costs more than its rows.
constexpr auto kGather = std::chrono::milliseconds(20);
/// A station is reminded of deletions that it has not confirmed.
constexpr auto kReminderPeriod = std::chrono::seconds(5);
constexpr auto kReportPeriod = std::chrono::minutes(1);
constexpr std::size_t kMaxSaidLines = 100;
constexpr std::size_t kMaxSaid = 300;
constexpr auto kFirstRetry = std::chrono::milliseconds(200);
constexpr auto kLongestRetry = std::chrono::milliseconds(2000);
/// The broker keeps rows for a collector that is away; how many is its own limit, and stations send them again anyway.
constexpr std::uint32_t kSessionExpiryS = 3600;

}  // namespace

struct Collector::Impl {
  struct ArrivedRow {
    std::string station;
    std::string kind;
    training::Uuid key;  ///< as its sender calls it
    std::string body;
    std::size_t bytes() const { return body.size() + kRowBytes; }
  };
  struct Batch {
    std::vector<SentRow> rows;
    std::vector<training::Uuid> keys;  ///< one per row
    std::vector<std::pair<std::string, training::Uuid>>
        checks;  ///< by station: to be acknowledged when the database answers
    std::map<std::pair<std::string, std::string>, std::vector<training::Uuid>> refused;  ///< by station and reason
    bool empty() const { return rows.empty() && checks.empty() && refused.empty(); }
  };

  /// Sender by the certificate's name, which the broker has checked.
  SentRow sentBy(const std::string& station, AnyRow row, std::size_t bytes) const {
    const bool teacher = station == wordFor(Role::instructor);
    return {std::move(row), teacher ? training::Uuid() : deriveStationId(class_id, station), station, bytes};
  }
  void read(const ArrivedRow& arrived, Batch& batch) const {
    if (arrived.kind == kCheckKind) {
      batch.checks.emplace_back(arrived.station, arrived.key);
      return;
    }
    try {
      AnyRow row = training::rowFromJson(arrived.kind, arrived.body);
      batch.keys.push_back(training::outboxKey(row));
      batch.rows.push_back(sentBy(arrived.station, std::move(row), arrived.body.size()));
    } catch (const Error& error) {
      batch.refused[{arrived.station, error.what()}].push_back(arrived.key);
    }
  }

  Impl(const Member& member, std::unique_ptr<RowSink> rows_go) : class_id(member.class_id), sink(std::move(rows_go)) {
    MqttSettings settings = makeMqttSettings(member);
    settings.session_expiry_s = kSessionExpiryS;
    for (const char* kind :
         {"station", "class", "trainee", "protocol", "session", "block", "trial", "event", "delete", "check"}) {
      settings.subscriptions.push_back({fmt::format("palpate/v1/{}/st/+/{}", class_id, kind), 1});
    }
    settings.subscriptions.push_back({fmt::format("palpate/v1/{}/st/+/state", class_id), 0});
    mqtt.emplace(settings, MqttHandlers{[this](auto where, auto what) { received(where, what); }, {}});
    thread = std::thread([this] { run(); });
  }
  ~Impl() {
    {
      const std::lock_guard lock(mutex);
      ending = true;
    }
    woken.notify_all();
    thread.join();
    mqtt.reset();
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  // In the connection's thread.
  void received(std::string_view where, std::string_view what) {
    const auto at = parseTopic(where);
    if (!at || at->class_id != class_id) return refuse(where);
    if (at->kind == "state") return noteState(at->station, what);
    if (!isRowKind(at->kind) && at->kind != kCheckKind) return refuse(where);
    {
      const std::lock_guard lock(mutex);
      stations.insert(at->station);
      // Not even unpacked: a station that sends faster than the database accepts delays only itself.
      if (bytes_of[at->station] >= kMaxStationBytes || inbox_bytes >= kMaxInboxBytes || inbox.size() >= kMaxInboxRows) {
        ++counts.dropped;
        return;
      }
    }
    auto message = parseRowMessage(what);
    if (!message) return refuse(where);
    const std::lock_guard lock(mutex);
    inbox.push_back({at->station, at->kind, std::move(message->envelope.id), std::move(message->body)});
    inbox_bytes += inbox.back().bytes();
    bytes_of[at->station] += inbox.back().bytes();
    woken.notify_all();
  }
  void refuse(std::string_view where) {
    const std::lock_guard lock(mutex);
    ++counts.refused;
    counts.trouble = fmt::format("no message of a class at {}", oneLine(where));
  }
  /// Notes which trainee a station reports: a deletion has to retract it.
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
      const Batch batch = nextBatch();
      if (batch.empty()) return;
      storeBatch(batch);
    }
  }
  /// Waits for rows; empty: it must end.
  Batch nextBatch() {
    Batch batch;
    std::unique_lock lock(mutex);
    while (batch.empty()) {
      woken.wait(lock, [this] { return ending || !inbox.empty(); });
      if (inbox.empty()) return {};
      woken.wait_for(lock, kGather, [this] { return ending || inbox.size() >= kMaxBatch; });
      std::set<std::pair<std::string, training::Uuid>> seen;  // a row that was sent again meanwhile
      std::size_t bytes = 0;
      while (!inbox.empty() && seen.size() < kMaxBatch && bytes < kMaxBatchBytes) {
        const ArrivedRow arrived = std::move(inbox.front());
        inbox.pop_front();
        inbox_bytes -= arrived.bytes();
        if (auto& left = bytes_of[arrived.station]; (left -= arrived.bytes()) == 0) bytes_of.erase(arrived.station);
        if (!seen.insert({arrived.station, arrived.key}).second) continue;
        bytes += arrived.bytes();
        lock.unlock();  // reading takes longer than taking
        read(arrived, batch);
        lock.lock();
      }
    }
    return batch;
  }
  void storeBatch(const Batch& batch) {
    try {
      const KeptRows kept = sink->save(batch.rows);
      retry = kFirstRetry;
      settle(batch, kept);
    } catch (const Error& error) {
      // The batch is dropped: its rows will be sent again.
      {
        const std::lock_guard lock(mutex);
        counts.database = false;
        counts.trouble = error.what();
      }
      pauseAfterFailure();
    }
  }
  void pauseAfterFailure() {
    std::unique_lock lock(mutex);
    woken.wait_for(lock, retry, [this] { return ending; });
    retry = std::min<std::chrono::milliseconds>(2 * retry, kLongestRetry);
  }
  /// Acknowledges the rows that are in the database, and reports those that were refused.
  void settle(const Batch& batch, const KeptRows& kept) {
    std::map<std::string, std::vector<training::Uuid>> keys;
    auto refused = batch.refused;
    std::uint64_t trials = 0;
    auto why = kept.refused.begin();
    for (std::size_t i = 0; i < batch.rows.size(); ++i) {
      const SentRow& sent = batch.rows[i];
      if (kept.fates[i] == RowFate::refused) refused[{sent.name, (why++)->why}].push_back(batch.keys[i]);
      if (kept.fates[i] != RowFate::kept) continue;
      keys[sent.name].push_back(batch.keys[i]);
      trials += std::holds_alternative<training::TrialRow>(sent.row) ? 1U : 0U;
      if (const auto* deletion = std::get_if<training::DeletionRow>(&sent.row)) forget(*deletion, sent);
    }
    for (const auto& [station, key] : batch.checks) keys[station].push_back(key);
    const auto answer = [&](const std::string& station, const std::vector<std::string>& texts) {
      for (const std::string& text : texts) mqtt->publish({topicText({class_id, station, "ack"}), text, 1, false, 0});
    };
    for (const auto& [station, rows] : keys) answer(station, ackTexts(makeEnvelope(sequence++, rows.front()), rows));
    for (const auto& [by, rows] : refused)
      answer(by.first, refusalTexts(makeEnvelope(sequence++, rows.front()), rows, by.second));
    notifyDeletions(batch, kept, answer);
    note(batch, kept, refused, trials);
  }
  template <class Answer>
  void notifyDeletions(const Batch& batch, const KeptRows& kept, const Answer& answer) {
    for (const auto& [station, marks] : kept.notices) {
      const auto now = Clock::now();
      if (const auto told = told_at.find(station); told != told_at.end() && now - told->second < kReminderPeriod)
        continue;
      told_at[station] = now;
      const auto sent = std::ranges::find(batch.rows, station, &SentRow::station);
      answer(sent->name, deletionNoticeTexts(makeEnvelope(sequence++, station), marks));
    }
  }
  template <class Refused>
  void note(const Batch& batch, const KeptRows& kept, const Refused& refused, std::uint64_t trials) {
    const std::lock_guard lock(mutex);
    counts.database = true;
    ++counts.commits;
    counts.rows += kept.keys.size() + batch.checks.size();
    counts.trials += trials;
    counts.waited += kept.waits.size();
    counts.trouble = kept.waits.empty() ? sink->trouble() : kept.waits.back().why;
    for (const auto& [by, rows] : refused) {
      counts.refused += rows.size();
      counts.trouble = fmt::format("{}: {} rows refused: {}", by.first, rows.size(), oneLine(by.second, kMaxSaid));
      const auto now = Clock::now();
      const auto found = said_at.find(by.first);
      if (found != said_at.end() && now - found->second < kReportPeriod) continue;
      said_at[by.first] = now;
      say(counts.trouble);
    }
    for (const std::string& line : kept.reports) say(line);
  }
  /// The lock is held.
  void say(std::string line) {
    if (reports.size() >= kMaxSaidLines) reports.pop_front();
    reports.push_back(std::move(line));
  }
  /// The retained messages that name a deleted trainee.
  void forget(const training::DeletionRow& deletion, const SentRow& sent) {
    if (deletion.at_ms == 0) return;
    std::vector<std::string> clear;
    {
      const std::lock_guard lock(mutex);
      for (const auto& [station, trainee] : sits) {
        if (!sent.station.empty() && station != sent.name) continue;
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
  std::map<training::Uuid, Clock::time_point> told_at;  ///< the collector's thread alone

  mutable std::mutex mutex;  ///< guards what follows
  std::condition_variable woken;
  bool ending = false;
  std::deque<ArrivedRow> inbox;
  std::size_t inbox_bytes = 0;
  std::map<std::string, std::size_t> bytes_of;  ///< bytes in the inbox, by station
  std::deque<std::string> reports;
  std::map<std::string, Clock::time_point> said_at;
  std::set<std::string> stations;
  std::map<std::string, training::Uuid> sits;
  CollectorReport counts;

  std::optional<MqttLink> mqtt;  ///< after what its thread uses
  std::thread thread;
};

Collector::Collector(const Member& member, std::unique_ptr<RowSink> sink)
    : impl_(std::make_unique<Impl>(member, std::move(sink))) {}
Collector::~Collector() = default;

CollectorReport Collector::report() const {
  const std::lock_guard lock(impl_->mutex);
  CollectorReport report = impl_->counts;
  report.inbox = impl_->inbox.size();
  report.inbox_bytes = impl_->inbox_bytes;
  report.stations = impl_->stations.size();
  report.connected = impl_->mqtt && impl_->mqtt->connected();
  if (!report.connected && impl_->mqtt) report.trouble = impl_->mqtt->trouble();
  return report;
}

std::vector<std::string> Collector::drainReports() {
  const std::lock_guard lock(impl_->mutex);
  std::vector<std::string> lines(impl_->reports.begin(), impl_->reports.end());
  impl_->reports.clear();
  return lines;
}

}  // namespace palpate::classroom
