// Recordings behind their handles: facts at once, samples in portions of the caller's size, and the whole replayed.
#include <memory>
#include <string>
#include <vector>

#include "answers.h"
#include "palpate/base/path_text.h"
#include "palpate/engine/recording_replay.h"
#include "structs.h"
#include "touch.h"
#include "world_handle.h"

struct palpate_session {
  explicit palpate_session(const std::filesystem::path& file) : reader(file) {}
  palpate::trace::RecordingReader reader;
};

namespace palpate::c_api {

namespace {

palpate_session_facts makeRecordingFacts(const trace::RecordingFacts& session) noexcept {
  palpate_session_facts facts = {};
  facts.ticks_per_s = session.header.ticks_per_s;
  facts.seconds = session.seconds();
  facts.samples = session.samples;
  facts.first_tick = session.first_tick;
  facts.last_tick = session.last_tick;
  facts.fingers = session.fingers.size();
  facts.first_world = session.first_world;
  facts.worlds = session.worlds;
  facts.events = session.events;
  facts.dropped = session.dropped;
  putText(session.header.started_utc, facts.started_utc);
  putText(session.ended_utc, facts.ended_utc);
  putText(session.ended_by, facts.ended_by);
  putText(session.header.software, facts.software);
  putText(session.header.notes, facts.notes);
  return facts;
}

/// The caller's two arrays and how far they are filled.
struct Room {
  palpate_sample* samples;
  std::size_t sample_stride;
  palpate_touch* touches;
  std::size_t touch_stride;
  std::size_t room;
  std::size_t filled = 0;

  void check(std::size_t fingers) const {
    require(samples == nullptr || isSize<palpate_sample>(sample_stride), "the stride of the samples must be sizeof(palpate_sample)");
    require(touches == nullptr || isSize<palpate_touch>(touch_stride), "the stride of the touches must be sizeof(palpate_touch)");
    require(room >= fingers && room > 0, "the buffer has no room for one tick of every finger");
  }
  /// False, and nothing is written, where the tick does not fit.
  bool put(std::span<const trace::Sample> tick) noexcept {
    if (tick.size() > room - filled) return false;
    for (const trace::Sample& sample : tick) put(sample);
    return true;
  }

 private:
  void put(const trace::Sample& sample) noexcept {
    if (touches != nullptr) putTouch(sample.contact, sample.tick, at(touches, filled, touch_stride), touch_stride);
    if (samples != nullptr) {
      palpate_sample plain = {};
      plain.tick = sample.tick;
      plain.finger = sample.finger;
      plain.world = sample.world;
      for (int axis = 0; axis < 3; ++axis) plain.device_force_n[axis] = sample.device_force[axis];
      plain.safety = sample.safety;
      plain.buttons = sample.buttons;
      toCaller(plain, at(samples, filled, sample_stride), sample_stride);
    }
    ++filled;
  }
};

palpate_replay plain(const engine::ReplayReport& report) {
  palpate_replay replay = {};
  replay.ticks = report.ticks;
  replay.different = report.different;
  replay.unproven = report.unproven;
  replay.identical = report.identical() ? 1 : 0;
  if (const auto& first = report.first_difference) {
    replay.first_different_tick = first->tick;
    putText(first->finger + ", " + first->field + ": recorded " + first->recorded + ", replayed " + first->replayed,
            replay.difference);
  }
  std::string notes;
  for (const std::string& note : report.notes) notes += (notes.empty() ? "" : "; ") + note;
  putText(notes, replay.notes);
  return replay;
}

}  // namespace

}  // namespace palpate::c_api

using namespace palpate;
using c_api::answered;
using c_api::require;

int32_t palpate_session_open(const char* utf8_path, palpate_session** out, palpate_error* error) noexcept {
  return c_api::answeredWith(out, error, [&] {
    require(utf8_path != nullptr, "the path is null");
    return std::make_unique<palpate_session>(pathOf(utf8_path)).release();
  });
}

int32_t palpate_session_get_facts(const palpate_session* session, palpate_session_facts* facts) noexcept {
  if (session == nullptr || !c_api::isUsable(facts)) return PALPATE_ARGUMENT;
  c_api::toCaller(c_api::makeRecordingFacts(session->reader.facts()), facts);
  return PALPATE_OK;
}

int32_t palpate_session_get_finger(const palpate_session* session, size_t index,
                                   palpate_session_finger* finger) noexcept {
  if (session == nullptr || !c_api::isUsable(finger)) return PALPATE_ARGUMENT;
  const std::vector<trace::RecordingFinger>& fingers = session->reader.facts().fingers;
  if (index >= fingers.size()) return PALPATE_ARGUMENT;
  palpate_session_finger plain = {};
  c_api::putText(fingers[index].name, plain.name);
  c_api::putText(fingers[index].device, plain.device);
  c_api::toCaller(plain, finger);
  return PALPATE_OK;
}

int32_t palpate_session_read(palpate_session* session, uint64_t from, uint64_t to, palpate_sample* samples,
                             size_t sample_stride, palpate_touch* touches, size_t touch_stride, size_t room,
                             size_t* count, palpate_error* error) noexcept {
  if (count != nullptr) *count = 0;
  return answered(error, [&] {
    require(session != nullptr && count != nullptr, "the session or count is null");
    c_api::Room target = {samples, sample_stride, touches, touch_stride, room};
    target.check(session->reader.facts().fingers.size());
    session->reader.forEachTick({from, to}, [&](std::span<const trace::Sample> tick) { return target.put(tick); });
    *count = target.filled;
  });
}

int32_t palpate_session_replay(palpate_session* session, const char* folder, palpate_replay* replay,
                               palpate_error* error) noexcept {
  return answered(error, [&] {
    require(session != nullptr, "the session is null");
    require(c_api::isUsable(replay), "replay is null, or its size is not set");
    engine::ReplaySettings settings;
    if (folder != nullptr) settings.folder = pathOf(folder);
    c_api::toCaller(c_api::plain(engine::replay(session->reader, settings)), replay);
  });
}

int32_t palpate_session_world(palpate_session* session, uint64_t number, const char* folder, palpate_world** out,
                              palpate_error* error) noexcept {
  return c_api::answeredWith(out, error, [&] {
    require(session != nullptr, "the session is null");
    const trace::RecordingWorld recorded = session->reader.world(number);
    const std::filesystem::path at = folder != nullptr ? pathOf(folder) : pathOf(recorded.folder);
    return c_api::makeHandle(engine::builtWorld(recorded, at));
  });
}

void palpate_session_close(palpate_session* session) noexcept { delete session; }
