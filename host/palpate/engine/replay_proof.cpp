// Within a tick first what the record says was forgotten, then the events: a session that was joined to another begins
// as one that remembers nothing, and may have been cut itself. Own.
#include "palpate/engine/replay_proof.h"

#include <fmt/format.h>

#include <algorithm>

#include "palpate/trace/session_edit.h"

namespace palpate::engine {

ReplayProof::ReplayProof(trace::SessionReader& session) : ticks_per_s_(session.facts().header.ticks_per_s) {
  for (const trace::SessionFinger& finger : session.facts().fingers) fingers_.emplace_back().name = finger.name;
  for (trace::SessionEvent& event : session.events()) {
    if (event.kind == trace::kTrimEvent || event.kind == trace::kCutEvent || event.kind == trace::kDroppedEvent) {
      events_.push_back(std::move(event));
    }
  }
}

void ReplayProof::loseSight(const trace::SessionEvent& event) {
  for (std::size_t i = 0; i < fingers_.size(); ++i) {
    if (event.finger && *event.finger != i) continue;
    fingers_[i].counts_known = false;
    if (event.kind == trace::kTrimEvent) continue;
    fingers_[i].known = false;
    fingers_[i].rest = {};
  }
}

void ReplayProof::begin(std::span<const trace::Sample> recorded) {
  for (const trace::Sample& sample : recorded) {
    Finger& finger = fingers_[sample.finger];
    if ((sample.forgot & trace::kForgotLimiter) == 0) continue;
    finger.counts_known = true;
    finger.known = finger.known || (sample.forgot & trace::kForgotTouch) != 0;
  }
  for (; next_ < events_.size() && events_[next_].tick <= recorded.front().tick; ++next_) loseSight(events_[next_]);
}

bool ReplayProof::beginsAnew(const trace::Sample& recorded) {
  Finger& finger = fingers_[recorded.finger];
  if (finger.known) return false;
  finger.known = finger.rest.add(recorded);
  if (!finger.known && finger.unproven++ == 0) finger.since = recorded.tick;
  return finger.rest.ticks() == 1;
}

std::vector<std::string> ReplayProof::notes() const {
  std::vector<std::string> notes;
  for (const Finger& finger : fingers_) {
    if (finger.unproven == 0) continue;
    notes.push_back(fmt::format(
        "{}: {} samples from {:.3f} s on cannot be proven: time before them is missing and the finger had not rested",
        finger.name, finger.unproven, static_cast<double>(finger.since) / ticks_per_s_));
  }
  return notes;
}

std::uint64_t ReplayProof::unproven() const {
  std::uint64_t all = 0;
  for (const Finger& finger : fingers_) all += finger.unproven;
  return all;
}

}  // namespace palpate::engine
