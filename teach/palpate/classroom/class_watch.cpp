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

struct ClassWatch::Course {
  explicit Course(const Member& instructor) : class_id(instructor.class_id), board(instructor.class_id) {
    MqttSettings settings = linkOf(instructor);
    settings.client_id += fmt::format("-{}", training::systemRandom()[0]);  // two windows are two clients
    for (const char* kind : {"status", "state", "session", "block"}) {
      settings.subscriptions.push_back({fmt::format("palpate/v1/{}/st/+/{}", class_id, kind), 1});
    }
    settings.subscriptions.push_back({fmt::format("palpate/v1/{}/st/+/live", class_id), 0});
    mqtt.emplace(settings, MqttHandlers{[this](auto topic, auto payload) {
                                          const std::lock_guard lock(mutex);
                                          board.take(topic, payload, steadyS());
                                        },
                                        {}});
  }

  const std::string class_id;
  mutable std::mutex mutex;
  ClassBoard board;
  std::atomic<std::uint64_t> sequence = 1;
  std::optional<MqttLink> mqtt;  ///< after what its thread uses
};

ClassWatch::ClassWatch(const Member& instructor) : course_(std::make_unique<Course>(instructor)) {}
ClassWatch::~ClassWatch() = default;

std::vector<Tile> ClassWatch::tiles() const {
  const std::lock_guard lock(course_->mutex);
  return course_->board.tiles(steadyS());
}

std::optional<Tile> ClassWatch::tile(const std::string& station) const {
  const std::lock_guard lock(course_->mutex);
  return course_->board.tile(station, steadyS());
}

std::vector<ForcePoint> ClassWatch::forces(const std::string& station) const {
  const std::lock_guard lock(course_->mutex);
  std::vector<ForcePoint> forces = course_->board.forces(station);
  const double now_s = steadyS();
  for (ForcePoint& point : forces) point.s -= now_s;
  return forces;
}

std::vector<CurvePoint> ClassWatch::learningCurve() const {
  const std::lock_guard lock(course_->mutex);
  return course_->board.learningCurve();
}

void ClassWatch::remember(const training::Uuid& trainee, const training::BlockRow& block) {
  const std::lock_guard lock(course_->mutex);
  course_->board.remember(trainee, block);
}

bool ClassWatch::ask(const std::string& station, const Command& command) {
  const Envelope envelope{course_->sequence++, training::uuidOf(training::utcMs(), training::systemRandom()),
                          steadyS()};
  return course_->mqtt->publish({topicText({course_->class_id, station, "cmd"}), commandText(envelope, command), 1,
                                 false, static_cast<std::uint32_t>(kCommandExpiryS)});
}

bool ClassWatch::connected() const { return course_->mqtt->connected(); }
std::string ClassWatch::trouble() const { return course_->mqtt->trouble(); }

}  // namespace palpate::classroom
