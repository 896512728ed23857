#include "view/viewer/state/replay.h"

#include <algorithm>

namespace palpate::viewer {

void freeze(Replay& replay, bool frozen) {
  replay.frozen = frozen;
  replay.playing = false;
  replay.at_s = replay.to_s;
}

void stepReplay(Replay& replay, double seconds) {
  replay.playing = false;
  replay.at_s = std::clamp(replay.at_s + seconds, replay.from_s, replay.to_s);
}

void goToMark(Replay& replay, bool forth) {
  const double half_tick = 0.5 * replay.tick_s;
  const ReplayMark* found = nullptr;
  for (const ReplayMark& mark : replay.marks) {
    if (forth && mark.at_s > replay.at_s + half_tick) {
      found = &mark;
      break;
    }
    if (!forth && mark.at_s < replay.at_s - half_tick) found = &mark;
  }
  if (found != nullptr) stepReplay(replay, found->at_s - replay.at_s);
}

std::string markAt(const Replay& replay) {
  constexpr double kNearS = 0.25;  // long enough to be read while it plays
  for (const ReplayMark& mark : replay.marks) {
    if (replay.at_s >= mark.at_s - 0.5 * replay.tick_s && replay.at_s < mark.at_s + kNearS) return mark.words;
  }
  return {};
}

bool replayKey(window::Action action, bool fine, Replay& replay) {
  using window::Action;
  if (!replay.frozen || (action != Action::ring_left && action != Action::ring_right)) return false;
  const double step = fine ? replay.tick_s : kReplayStepS;
  stepReplay(replay, action == Action::ring_right ? step : -step);
  return true;
}

void advanceReplay(Replay& replay, const TouchHistory& history, double elapsed_s) {
  replay.from_s = history.oldestTime();
  replay.to_s = history.newestTime();
  replay.tick_s = history.tick();
  if (!replay.frozen) return;
  if (replay.playing) replay.at_s += elapsed_s;
  if (replay.playing && replay.loops && replay.at_s >= replay.to_s) replay.at_s = replay.from_s;
  replay.playing = replay.playing && replay.at_s < replay.to_s;
  replay.at_s = std::clamp(replay.at_s, replay.from_s, replay.to_s);
}

}  // namespace palpate::viewer
