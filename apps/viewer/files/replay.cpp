#include "apps/viewer/files/replay.h"

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
  replay.playing = replay.playing && replay.at_s < replay.to_s;
  replay.at_s = std::clamp(replay.at_s, replay.from_s, replay.to_s);
}

}  // namespace palpate::viewer
