#include "palpate/classroom/class_watch.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <mutex>

#include "palpate/base/stopwatch.h"
#include "palpate/classroom/mqtt_link.h"
#include "palpate/training/records/trainee_code.h"

namespace palpate::classroom {

namespace {

double steadyS() { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); }

}  // namespace

struct ClassWatch::Impl {
  explicit Impl(const Member& instructor) : class_id(instructor.class_id), board(instructor.class_id) {
    MqttSettings settings = makeMqttSettings(instructor);
    settings.client_id += fmt::format("-{}", training::systemRandom()[0]);  // two windows are two clients
    for (const char* kind : {"status", "state", "session", "block"}) {
      settings.subscriptions.push_back({fmt::format("palpate/v1/{}/st/+/{}", class_id, kind), 1});
    }
    settings.subscriptions.push_back({fmt::format("palpate/v1/{}/st/+/live", class_id), 0});
    mqtt.emplace(settings, MqttHandlers{[this](auto topic, auto payload) {
                                          const std::lock_guard lock(mutex);
                                          board.acceptMessage(topic, payload, steadyS());
                                        },
                                        {}});
  }

  const std::string class_id;
  mutable std::mutex mutex;
  ClassBoard board;
  std::atomic<std::uint64_t> sequence = 1;
  std::optional<MqttLink> mqtt;  ///< after what its thread uses
};

ClassWatch::ClassWatch(const Member& instructor) : impl_(std::make_unique<Impl>(instructor)) {}
ClassWatch::~ClassWatch() = default;

std::vector<Tile> ClassWatch::tiles() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->board.tiles(steadyS());
}

std::optional<Tile> ClassWatch::tile(const std::string& station) const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->board.tile(station, steadyS());
}

std::vector<ForcePoint> ClassWatch::forces(const std::string& station) const {
  const std::lock_guard lock(impl_->mutex);
  std::vector<ForcePoint> forces = impl_->board.forces(station);
  const double now_s = steadyS();
  for (ForcePoint& point : forces) point.s -= now_s;
  return forces;
}

std::vector<CurvePoint> ClassWatch::learningCurve() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->board.learningCurve();
}

void ClassWatch::remember(const training::Uuid& trainee, const training::BlockRow& block) {
  const std::lock_guard lock(impl_->mutex);
  impl_->board.remember(trainee, block);
}

bool ClassWatch::ask(const std::string& station, const Command& command) {
  const Envelope envelope =
      makeEnvelope(impl_->sequence++, training::makeUuidV7(training::utcMs(), training::systemRandom()));
  return impl_->mqtt->publish({topicText({impl_->class_id, station, "cmd"}), commandText(envelope, command), 1, false,
                               static_cast<std::uint32_t>(kCommandExpiryS)});
}

bool ClassWatch::connected() const { return impl_->mqtt->connected(); }
std::string ClassWatch::trouble() const { return impl_->mqtt->trouble(); }

}  // namespace palpate::classroom
