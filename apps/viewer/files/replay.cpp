#include "apps/viewer/files/replay.h"

#include <algorithm>

namespace palpate::viewer {

namespace {

double tickOf(const Session& session) { return 1.0 / session.scene.ticks_per_s; }

}  // namespace

void freeze(Session& session, bool frozen) {
  session.frozen = frozen;
  session.replay.playing = false;
  session.replay.at_s = session.replay.to_s;
}

void stepReplay(Session& session, double seconds) {
  Replay& replay = session.replay;
  replay.playing = false;
  replay.at_s = std::clamp(replay.at_s + seconds, replay.from_s, replay.to_s);
}

void stepTick(Session& session, bool forth) { stepReplay(session, forth ? tickOf(session) : -tickOf(session)); }

bool replayKey(window::Action action, bool fine, Session& session) {
  using window::Action;
  if (!session.frozen || (action != Action::ring_left && action != Action::ring_right)) return false;
  const bool forth = action == Action::ring_right;
  if (fine) {
    stepTick(session, forth);
  } else {
    stepReplay(session, forth ? kReplayStepS : -kReplayStepS);
  }
  return true;
}

void advanceReplay(Session& session, const TouchHistory& history, double elapsed_s) {
  Replay& replay = session.replay;
  replay.from_s = history.oldestTime();
  replay.to_s = history.newestTime();
  if (!session.frozen) return;
  if (replay.playing) replay.at_s += elapsed_s;
  replay.playing = replay.playing && replay.at_s < replay.to_s;
  replay.at_s = std::clamp(replay.at_s, replay.from_s, replay.to_s);
}

}  // namespace palpate::viewer
