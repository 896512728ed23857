#include "palpate/classroom/station_link.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/stopwatch.h"
#include "palpate/classroom/mqtt_link.h"

namespace palpate::classroom {

namespace {

constexpr auto kLivePeriod = std::chrono::milliseconds(100);    // 10 Hz
constexpr auto kOutboxPeriod = std::chrono::milliseconds(250);  // between two looks for new rows
constexpr std::size_t kMaxAnswers = 10000;
constexpr auto kDiskPeriod = std::chrono::seconds(10);
/// Rows that the class refused are sent again after so long: a clock may have been put right, a share made larger.
constexpr auto kRefusedPeriod = std::chrono::minutes(10);

bool diskNearlyFull(const std::filesystem::path& folder) {
  std::error_code fault;
  const auto space = std::filesystem::space(folder, fault);
  return !fault && static_cast<double>(space.available) < kMinDiskBytes;
}

}  // namespace

struct StationLink::Impl {
  Impl(const Member& at, training::Store& store, const StationInfo& info, const OutboxPace& pace)
      : member(at), own(opened(store)), sender(pace, Clock::now()) {
    status.online = true;
    status.app = info.app;
    status.device = info.device;
    status.safety = "ok";
    row_count = own.waitingCount();
    own.rememberTraineeKey(member.class_id, member.trainee_key);
    MqttSettings settings = makeMqttSettings(member);
    settings.subscriptions = {{topic("ack"), 1}, {topic("cmd"), 1}};
    StationStatus gone = status;
    gone.online = false;
    settings.will =
        OutMessage{topic("status"), statusText(makeEnvelope(sequence++, member.station_id), gone), 1, true, 0};
    mqtt.emplace(settings,
                 MqttHandlers{[this](auto where, auto what) { received(where, what); }, [this] { markStateStale(); }});
    thread = std::thread([this] { run(); });
  }
  ~Impl() {
    {
      const std::lock_guard lock(mutex);
      ending = true;
    }
    woken.notify_all();
    thread.join();
    status.online = false;
    mqtt->publish({topic("state"), {}, 1, true, 0});
    mqtt->publish({topic("status"), statusText(makeEnvelope(sequence++, member.station_id), status), 1, true, 0});
    mqtt.reset();
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  static training::Store opened(training::Store& store) {
    store.fillOutbox(true);
    store.tryRefusedAgain();
    return {store.file(), training::Store::Open::existing};
  }
  std::string topic(const char* kind) const { return topicText({member.class_id, member.name, kind}); }

  // In the connection's thread.
  void received(std::string_view where, std::string_view what) {
    const auto at = parseTopic(where);
    if (!at || at->station != member.name) return;
    if (at->kind == "cmd") {
      if (const auto command = parseCommand(what)) commands.put(command->content, Clock::now());
    } else if (at->kind == "ack") {
      const std::lock_guard lock(mutex);
      if (const auto keys = parseAck(what)) {
        acknowledged.insert(acknowledged.end(), keys->begin(), keys->end());
      } else if (auto refusal = parseRefusal(what)) {
        refusals.push_back(std::move(*refusal));
      } else if (const auto marks = parseDeletionNotice(what)) {
        notices.insert(notices.end(), marks->begin(), marks->end());
      }
      if (refusals.size() > kMaxAnswers || notices.size() > kMaxAnswers)
        refusals.clear(), notices.clear();  // come again
      woken.notify_all();
    }
  }
  void markStateStale() {
    const std::lock_guard lock(mutex);
    status_stale = state_stale = true;
    woken.notify_all();
  }

  // In the link's own thread.
  void run() {
    auto outbox_next = Clock::now();
    auto disk_next = Clock::now();
    auto live_next = Clock::now();
    auto refused_next = Clock::now() + kRefusedPeriod;
    std::unique_lock lock(mutex);
    while (!ending) {
      const auto until = live ? std::min(live_next, outbox_next) : outbox_next;
      woken.wait_until(lock, until, [&] { return ending || hasAnswers() || hasNews(live_next); });
      const bool acks = processAcks(lock);
      if (Clock::now() >= refused_next) {
        lock.unlock();
        work([this] { own.tryRefusedAgain(); });
        lock.lock();
        refused_next = Clock::now() + kRefusedPeriod;
      }
      publishStatus(lock);
      if (live && Clock::now() >= live_next) {
        sendLive(lock);
        live_next = Clock::now() + kLivePeriod;
      }
      if (acks || Clock::now() >= outbox_next) {
        lock.unlock();
        work([this] { sendRows(); });
        lock.lock();
        outbox_next = Clock::now() + kOutboxPeriod;
      }
      if (Clock::now() >= disk_next) {
        disk_full = diskNearlyFull(own.folder());
        disk_next = Clock::now() + kDiskPeriod;
      }
    }
    lock.unlock();
    work([this] { finish(); });
  }
  bool hasNews(Clock::time_point live_next) const {
    return (mqtt->connected() && (status_stale || state_stale)) || (live && Clock::now() >= live_next);
  }
  /// A file that another process holds for a moment does not stop the thread; it is reported and tried again.
  template <class Work>
  void work(const Work& what) {
    std::string said;
    try {
      what();
    } catch (const Error& error) {
      said = error.what();
    }
    const std::lock_guard lock(mutex);
    fault = said;
  }
  bool hasAnswers() const { return !acknowledged.empty() || !refusals.empty() || !notices.empty(); }
  bool processAcks(std::unique_lock<std::mutex>& lock) {
    if (!hasAnswers()) return false;
    const auto keys = std::exchange(acknowledged, {});
    const auto not_kept = std::exchange(refusals, {});
    const auto marks = std::exchange(notices, {});
    lock.unlock();
    work([&] {
      own.acknowledged(keys);
      for (const Refusal& refusal : not_kept) own.refused(refusal.keys, refusal.why);
      if (!marks.empty()) own.applyDeletionNotice(marks);
      refused_count = own.refusedCount();
    });
    sender.acknowledged();
    lock.lock();
    if (!not_kept.empty()) why_refused = not_kept.back().why;
    return true;
  }
  void publishStatus(std::unique_lock<std::mutex>& lock) {
    if (!mqtt->connected()) return;
    if (status_stale) {
      const std::string text = statusText(makeEnvelope(sequence++, member.station_id), status);
      status_stale = false;
      lock.unlock();
      if (!mqtt->publish({topic("status"), text, 1, true, 0})) status_stale = true;
      lock.lock();
    }
    if (!state_stale) return;
    const std::string text = state ? stateText(makeEnvelope(sequence++, state->session), *state) : std::string();
    state_stale = false;
    lock.unlock();
    if (!mqtt->publish({topic("state"), text, 1, true, 0})) state_stale = true;
    lock.lock();
  }
  void sendLive(std::unique_lock<std::mutex>& lock) {
    const std::string text = liveText(makeEnvelope(sequence++, state ? state->session : member.station_id), *live);
    live.reset();
    lock.unlock();
    if (mqtt->publish({topic("live"), text, 0, false, 0})) ++live_count;
    lock.lock();
  }
  void sendRows() {
    row_count = own.waitingCount();
    if (row_count == 0 || !mqtt->connected()) return;
    const auto entries = own.waiting(sender.window(Clock::now()));
    sender.restrictTo(entries);
    for (const training::OutboxEntry& entry : entries) {
      // Rows recorded after a deletion must not reach the class before it.
      const bool last = entry.kind == "delete";
      if (!sender.due(entry.row, Clock::now())) {
        if (last) return;
        continue;
      }
      if (!sender.consumeToken(Clock::now())) return;
      if (!mqtt->publish(
              {topic(entry.kind.c_str()), rowText(makeEnvelope(sequence++, entry.row), entry.body), 1, false, 0}))
        return;
      ++sent_count;
      if (sender.wasSent(entry.row)) ++repeat_count;
      sender.sent(entry.row, Clock::now());
      if (last) return;
    }
  }
  /// Removes the last acknowledged rows from the outbox.
  void finish() {
    std::vector<training::Uuid> keys;
    {
      const std::lock_guard lock(mutex);
      keys.swap(acknowledged);
    }
    if (!keys.empty()) own.acknowledged(keys);
  }

  const Member member;
  training::Store own;  ///< the link's thread alone
  OutboxSender sender;  ///< the link's thread alone
  CommandQueue commands;
  std::atomic<std::uint64_t> sequence = 1;
  std::atomic<std::size_t> row_count = 0;
  std::atomic<std::size_t> refused_count = 0;
  std::atomic<std::uint64_t> live_count = 0;
  std::atomic<std::uint64_t> sent_count = 0;
  std::atomic<std::uint64_t> repeat_count = 0;

  mutable std::mutex mutex;  ///< guards what follows
  std::condition_variable woken;
  bool ending = false;
  StationStatus status;
  std::optional<StationState> state;
  std::atomic<bool> status_stale = true;
  std::atomic<bool> state_stale = true;
  std::optional<LiveSample> live;
  std::vector<training::Uuid> acknowledged;
  std::vector<Refusal> refusals;
  std::vector<std::string> notices;
  std::string why_refused;
  bool disk_full = false;
  std::string fault;

  std::optional<MqttLink> mqtt;  ///< after what its thread uses
  std::thread thread;
};

StationLink::StationLink(const Member& member, training::Store& store, const StationInfo& info, const OutboxPace& pace)
    : impl_(std::make_unique<Impl>(member, store, info, pace)) {}
StationLink::~StationLink() = default;

void StationLink::publishState(const StationState& state) {
  const std::lock_guard lock(impl_->mutex);
  if (impl_->state == state) return;
  impl_->state = state;
  impl_->state_stale = true;
  impl_->woken.notify_all();
}

void StationLink::clearState() {
  const std::lock_guard lock(impl_->mutex);
  if (!impl_->state) return;
  impl_->state.reset();
  impl_->state_stale = true;
  impl_->woken.notify_all();
}

void StationLink::publishLive(const LiveSample& live) {
  const std::lock_guard lock(impl_->mutex);
  impl_->live = live;
  impl_->woken.notify_all();
}

void StationLink::publishSafety(const std::string& safety) {
  const std::lock_guard lock(impl_->mutex);
  if (impl_->status.safety == safety) return;
  impl_->status.safety = safety;
  impl_->status_stale = true;
  impl_->woken.notify_all();
}

std::optional<Command> StationLink::popCommand() { return impl_->commands.popCommand(Clock::now()); }
bool StationLink::connected() const { return impl_->mqtt->connected(); }
std::size_t StationLink::waiting() const { return impl_->row_count; }
LinkCounts StationLink::counts() const {
  return {impl_->live_count, impl_->sent_count, impl_->repeat_count, impl_->refused_count};
}

std::string StationLink::trouble() const {
  const std::string connection = impl_->mqtt->trouble();
  const std::lock_guard lock(impl_->mutex);
  if (impl_->disk_full) return "less than 1 GB is left on the disk";
  if (!impl_->fault.empty()) return impl_->fault;
  if (connection.empty() && impl_->refused_count > 0) {
    return fmt::format("the class refused {} rows: {}", impl_->refused_count.load(), impl_->why_refused);
  }
  return connection;
}

}  // namespace palpate::classroom
