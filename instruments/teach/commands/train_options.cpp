#include "teach/commands/train_options.h"
#include "palpate/scene/presets.h"

#include <algorithm>

#include "cli/kit/choice_option.h"
#include "cli/kit/device_option.h"
#include "cli/kit/number_option.h"
#include "cli/kit/options.h"
#include "palpate/scene/scene_file.h"
#include "palpate/training/records/store.h"
#include "view/viewer/world/world_swap.h"

namespace palpate::app {

namespace {

void addWindowOptions(Command& command, TrainOptions& options) {
  constexpr const char* kGroup = "Window";
  command.add_flag("--full-screen", options.full_screen, "Fill the screen")->group(kGroup);
  addNumber(command, "--width", options.width, between(320, 16384, "pixels"), "Of the window")->group(kGroup);
  addNumber(command, "--height", options.height, between(240, 16384, "pixels"), "Of the window")->group(kGroup);
  command.add_flag("--no-speech", options.no_speech, "Show sentences without speaking them")->group(kGroup);
  command.add_flag("--no-state", options.no_state, "Ignore the theme and text size of `palpate run`")->group(kGroup);
  command.add_option("--play", options.play, "Play an input script (docs/reference/viewer.md): time_s, event, values")
      ->group(kGroup);
  addLanguage(command, options.language)->group(kGroup);
  addNumber(command, "--frames", options.frames, between(1, 1e12), "Close after this many frames")->group(kGroup);
  command
      .add_option("--screens", options.screens,
                  "Open no window; write a picture of every screen to this folder, with temporary records")
      ->group(kGroup);
}

}  // namespace

void addTrainOptions(Command& command, TrainOptions& options) {
  command.add_option("SCENE", options.scene, "Scene (TOML) or mesh file (default: the built-in body)");
  command.add_option("--records", options.records, "File of results (default: your own)");
  command
      .add_option("--protocol", options.protocol,
                  "Protocol to train and test: vhb, lumps, or a file (docs/howto/training.md)")
      ->capture_default_str();
  restrictTo(choiceNames<training::SessionKind>(),
             command.add_option("--kind", options.kind, "Session to start right after signing in (default: ask)"));
  command.add_option("--class", options.class_id,
                     "Class that codes belong to: a word, or the station's file from `palpate class init`");
  command.add_option("--code", options.code, "Sign in with this code at the start");
  addDeviceOption(command, options.devices, "Device for the finger instead of the mouse");
  command.add_option("--thimble", options.thimble,
                     "Thimble or pen on the device, for the record: \"rigid thimble\", \"pen\" (default: ask)");
  addNumber(command, "--seed", options.seed, between(0, 9007199254740991.0),
            "Seed of everything drawn at random (default: the system's random numbers)");
  command.add_option("--trainee", options.trainee,
                     "Simulate a trainee instead of opening a window: weber=0.2,lapse=0.02,sites=12,... or "
                     "observer=lump,spread=3.4,...");
  addNumber(command, "--sittings", options.sessions, between(1, 1000),
            "Sessions of the simulated trainee, one after the other");
  command.add_option("-o,--out", options.out,
                     "Folder for saved pictures; with --trainee, a file (JSON) of what it did");
  command.add_flag("--json", options.json, "With --trainee: print what it did as JSON");
  command.add_flag("--no-session-file", options.no_recording_file, "Do not record trials tick by tick");
  command.add_flag("--verbose", options.verbose, "Print what happens, line by line");
  addWindowOptions(command, options);
}

std::filesystem::path recordsFile(const TrainOptions& options) {
  return options.records.empty() ? training::defaultRecords() : std::filesystem::path(options.records);
}

scene::Scene sceneToTrainOn(const TrainOptions& options) {
  const scene::Scene standard = scene::standardScene();
  return options.scene.empty() ? standard : viewer::sceneFromFile(options.scene, standard).scene;
}

training::Protocol protocolAskedFor(const TrainOptions& options) {
  const auto kind = kindAskedFor(options);
  const bool lumps = kind && training::hidesLumps(*kind) && options.protocol == TrainOptions().protocol;
  return lumps ? training::builtInLumpProtocol() : training::protocolNamed(options.protocol);
}

std::optional<training::SessionKind> kindAskedFor(const TrainOptions& options) {
  return options.kind.empty() ? std::nullopt : choiceNamed<training::SessionKind>(options.kind);
}

}  // namespace palpate::app
