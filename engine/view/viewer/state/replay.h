// Stepping through past touches while the picture is frozen: a picture or a tick back or forth, or in real time. Pure.
#pragma once

#include <string>
#include <vector>

#include "palpate/window/keys.h"
#include "view/viewer/state/touch_history.h"

namespace palpate::viewer {

/// A step of the arrow keys and of the buttons: one picture at sixty a second.
inline constexpr double kReplayStepS = 1.0 / 60.0;

/// A place in a recording to be found again.
struct ReplayMark {
  double at_s = 0.0;
  std::string words;
};

/// State of a replay; times are those of the plots.
struct Replay {
  double at_s = 0.0;  ///< the moment shown
  double from_s = 0.0;
  double to_s = 0.0;  ///< the end of the available time
  bool playing = false;
  std::string table = {};  ///< the shown table; empty: the last minute of this run
  double tick_s = 0.001;
  bool frozen = false;  ///< false: the present is shown
  bool loops = false;   ///< playing starts over at the end
  std::vector<ReplayMark> marks = {};
  bool chooses_beside = false;  ///< the file dialog is open for the next one
  std::string beside = {};      ///< the recording shown on the right, from its own beginning on; empty: none
};

/// Freezes or resumes. Frozen, the newest moment is shown.
void freeze(Replay& replay, bool frozen);

/// Moves the shown moment within the available time; playing stops.
void stepReplay(Replay& replay, double seconds);
/// Returns true if the action is a step of a frozen picture; then it is done. `fine` steps by a tick.
bool replayKey(window::Action action, bool fine, Replay& replay);

/// Goes to the next mark, or with `forth` = false to the one before.
void goToMark(Replay& replay, bool forth);
/// The mark at the shown moment, or empty.
std::string markAt(const Replay& replay);

/// Once a frame: updates the available time and lets time pass when it plays.
void advanceReplay(Replay& replay, const TouchHistory& history, double elapsed_s);

}  // namespace palpate::viewer
