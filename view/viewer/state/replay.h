// Stepping through what was touched while the picture is frozen: a picture or a tick back or forth, or as it was. Pure.
#pragma once

#include <string>
#include <vector>

#include "palpate/window/keys.h"
#include "view/viewer/state/touch_history.h"

namespace palpate::viewer {

/// A step of the arrow keys and of the buttons: one picture at sixty a second.
inline constexpr double kReplayStepS = 1.0 / 60.0;

/// A place in what was recorded that somebody wants to find again.
struct ReplayMark {
  double at_s = 0.0;
  std::string words;
};

/// Looking again at what was; times are those of the plots.
struct Replay {
  double at_s = 0.0;  ///< the moment that is shown
  double from_s = 0.0;
  double to_s = 0.0;  ///< what there is to look at
  bool playing = false;
  std::string table = {};  ///< the recorded table that is looked at; empty: the last minute of this run
  double tick_s = 0.001;
  bool frozen = false;  ///< else the present is shown
  bool loops = false;   ///< playing begins again at the end
  std::vector<ReplayMark> marks = {};
  bool chooses_beside = false;  ///< the file dialog is open for the next one
  std::string beside = {};      ///< the recording that is shown on the right, from its own beginning on; empty: none
};

/// Freezes or goes on. Frozen, the newest moment is shown.
void freeze(Replay& replay, bool frozen);

/// Moves what is shown, within what there is; playing stops.
void stepReplay(Replay& replay, double seconds);
/// True if the action is a step of a frozen picture; then it was done. `fine` steps by a tick.
bool replayKey(window::Action action, bool fine, Replay& replay);

/// To the next mark, or with `forth` = false to the one before.
void goToMark(Replay& replay, bool forth);
/// The mark that is shown, or no words.
std::string markAt(const Replay& replay);

/// Once a frame: notes what there is to look at and lets time pass when it plays.
void advanceReplay(Replay& replay, const TouchHistory& history, double elapsed_s);

}  // namespace palpate::viewer
