// Options of `palpate train`, the same for the window and for a simulated trainee (trainee_course.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/kit/options.h"
#include "palpate/scene/scene.h"
#include "palpate/training/protocol.h"

namespace palpate::app {

struct TrainOptions {
  std::string scene;             ///< scene or mesh file; empty: the built-in body
  std::string records;           ///< file of results; empty: recordsFile()
  std::string protocol = "vhb";  ///< built in, or a file
  std::string kind;      ///< kind of session, as WordsOf<SessionKind> spells it with hyphens; empty: the user chooses
  std::string class_id;  ///< empty: none
  std::string code;      ///< signs in at once; empty: typed (a simulated trainee: made up from its seed)
  std::vector<std::string> devices;
  std::string thimble;  ///< recorded with the device: "rigid", "soft", "none"; empty: the trainee is asked
  std::optional<std::uint64_t> seed;  ///< nothing: the system's randomness
  std::string trainee;                ///< describes a simulated trainee (observerNamed); empty: a person at the window
  int sessions = 1;                   ///< number that a simulated trainee does in a row
  std::string out;                    ///< a simulated trainee's results, as a file; the window: folder for pictures
  bool json = false;
  bool no_recording_file = false;  ///< trials are not kept tick by tick

  // For the window.
  std::string play;
  std::uint64_t frames = 0;
  int width = 0;
  int height = 0;
  bool full_screen = false;
  bool no_state = false;
  bool no_speech = false;
  bool verbose = false;
  std::string language;  ///< for the window and its voice; empty: the system's
  std::string screens;   ///< folder for a picture of every screen; empty: a window is opened
};

void addTrainOptions(Command& command, TrainOptions& options);

/// The file of results that is used when none is named: in the user's own folder for such things. Throws Error without
/// a home.
std::filesystem::path recordsFile(const TrainOptions& options);

/// The felt scene, without what a trial hides in it. Throws Error.
scene::Scene sceneToTrainOn(const TrainOptions& options);

/// The requested kind, if one was named.
std::optional<training::SessionKind> kindAskedFor(const TrainOptions& options);
/// The named protocol; by default the one for lumps if the session has lumps. Throws Error.
training::Protocol protocolAskedFor(const TrainOptions& options);

// `palpate train --trainee WORDS`: a simulated trainee instead of a person, without a window.

/// Options that only a simulated trainee has.
struct TraineeOptions {
  bool programme = false;  ///< pre-test, six practices, post-test
  bool fast = false;       ///< without a body
  int trainees = 1;
  double spread = 0.33;  ///< SD of the logarithm of several trainees' thresholds
  std::string hand = "thimble,touch_x";
  std::string start = "2026-01-05T09:00:00Z";  ///< time of the first session
  int most_trials = 0;
};

void addTraineeOptions(Command& command, TraineeOptions& options);

/// The exit code: 0, or that of the signal that ended it. Throws Error.
int runTrainee(const TrainOptions& options, const TraineeOptions& simulated);

}  // namespace palpate::app
