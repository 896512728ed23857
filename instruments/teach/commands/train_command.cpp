// `palpate train`: a window in which people feel, answer and learn how well they did; or a simulated trainee without
// one.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "cli/kit/families.h"
#include "cli/kit/interruption.h"
#include "cli/kit/progress_line.h"
#include "cli/run/control_lines.h"
#include "cli/run/playback.h"
#include "palpate/base/error.h"
#include "palpate/base/language.h"
#include "palpate/base/private_folder.h"
#include "palpate/elements/lump_solver.h"
#include "palpate/training/records/class_names.h"
#include "palpate/training/records/trainee_code.h"
#include "teach/commands/class_part.h"
#include "teach/commands/commands.h"
#include "teach/commands/train_options.h"
#include "teach/window/screen_tour.h"
#include "teach/window/training_mode.h"
#include "teach/window/training_words.h"
#include "view/viewer/state/state_file.h"
#include "view/viewer/viewer.h"

namespace palpate::app {

namespace {

/// A word is a class without a network; a file or folder is that of a station which takes part in one.
bool isClassName(const std::string& text) {
  return text.empty() || (training::isClassWord(text) && !std::filesystem::exists(text));
}

viewer::TrainingSettings trainingSettings(const TrainOptions& options) {
  viewer::TrainingSettings settings;
  settings.records = recordsFile(options);
  settings.protocol = protocolAskedFor(options);
  settings.sign_in.kind = kindAskedFor(options);
  if (isClassName(options.class_id)) {
    settings.sign_in.class_id = options.class_id;
  } else {
    settings.station = classPart().station(options.class_id);
    settings.sign_in.class_id = settings.station->of.id;
    settings.sign_in.trainee_key = settings.station->trainee_key;
  }
  if (!options.code.empty()) {
    const auto code = training::codeTyped(options.code);
    if (!code) throw Error(fmt::format("--code '{}' is not a code: a letter of it is wrong", options.code));
    settings.sign_in.code = *code;
  }
  settings.leads_back = !settings.station && options.code.empty();
  settings.sign_in.thimble = options.thimble;
  settings.seed = options.seed;
  settings.recording_files = !options.no_recording_file;
  if (!options.no_speech) settings.speech = viewer::speechProgram();
  if (settings.records.has_parent_path()) makePrivateFolder(settings.records.parent_path());
  return settings;
}

window::WindowSettings trainingWindow(const TrainOptions& options) {
  window::WindowSettings settings;
  settings.title = tr("Palpate training");
  if (options.width > 0) settings.width = options.width;
  if (options.height > 0) settings.height = options.height;
  settings.full_screen = options.full_screen;
  return settings;
}

/// The display settings of `palpate run` that help to read.
viewer::ViewState readableState(const TrainOptions& options) {
  viewer::ViewState state;
  if (options.no_state) return state;
  const viewer::StateReading reading = viewer::readState(viewer::stateFile());
  if (!reading.remembered) return state;
  const viewer::ViewState& chosen = reading.remembered->state;
  state.theme = chosen.theme;
  state.text_size = chosen.text_size;
  state.reduced_motion = chosen.reduced_motion;
  state.input = chosen.input;
  return state;
}

/// Prints the screen's text, one line per change: for tests and for remote help.
class ScreenPrinter {
 public:
  void print(const viewer::TrainingMode& training) {
    std::string words;
    for (const std::string& part : viewer::wordsOf(training.screen())) words += " | " + part;
    if (std::exchange(before_, words) == words) return;
    fmt::print("screen{}\n", words);
    std::fflush(stdout);
  }

 private:
  std::string before_;
};

/// True to open the start page in its place.
bool trainInWindow(const TrainOptions& options) {
  Playback playback(options.play);
  viewer::TrainingSettings of_training = trainingSettings(options);
  viewer::ViewerSettings settings;
  settings.intro = false;
  settings.output_folder = options.out.empty() ? "." : options.out;
  window::Window window(trainingWindow(options));  // without a display it says so before a body is built
  const auto world = scene::build(sceneToTrainOn(options));
  if (!options.devices.empty()) settings.devices = openedFor(*world, options.devices);
  auto mode = std::make_unique<viewer::TrainingMode>(std::move(of_training));
  const viewer::TrainingMode& training = *mode;
  settings.modes.push_back(std::move(mode));
  viewer::Viewer viewer(world, readableState(options), std::move(settings), makeViewerHost(window));
  const FinishesInOrder in_order;
  const StoppedBySignal stopped(viewer.emergencyStop());
  ScreenPrinter teller;
  ControlLines controls;
  showFrames(window, viewer, playback, options.frames, [&](std::uint64_t, double) {
    if (!options.verbose) return;
    teller.print(training);
    controls.print(window.contentScale() * viewer.state().state.text_size);
  });
  viewer::Messages& messages = viewer.state().messages;
  messages.markRead();
  viewer.finish(endingSignal() == 0 ? "done" : nameOfSignal(endingSignal()));
  if (messages.unread() > 0) throw Error(messages.all().back().text);
  return training.returnsToStartPage() && endingSignal() == 0;
}

void showScreens(const TrainOptions& options) {
  ProgressLine progress;
  const viewer::TourSettings settings{.folder = options.screens,
                                      .protocol = training::protocolNamed(options.protocol),
                                      .width = options.width > 0 ? options.width : 1280,
                                      .height = options.height > 0 ? options.height : 800,
                                      .state = readableState(options)};
  const auto files = viewer::tourScreens(scene::build(sceneToTrainOn(options), progress.display()), settings);
  progress.clear();
  for (const std::filesystem::path& file : files) fmt::print("{}\n", file.string());
}

void addTrainCommand(Command& app) {
  Command* command = app.add_subcommand("train", "Train and examine palpation: people in a window, or simulated");
  addResultsCommand(*command);
  const auto options = std::make_shared<TrainOptions>();
  const auto simulated = std::make_shared<TraineeOptions>();
  addTrainOptions(*command, *options);
  addTraineeOptions(*command, *simulated);
  command->callback([=] {
    if (!command->get_subcommands().empty()) return;  // a subcommand runs instead
    useLanguage(options->language);
    if (!options->screens.empty()) return showScreens(*options);
    if (options->trainee.empty()) {
      if (!trainInWindow(*options)) return;
      std::vector<std::string> words = {"run"};
      if (options->verbose) words.emplace_back("--verbose");
      if (!options->language.empty()) words.insert(words.end(), {"--language", options->language});
      becomeCommand(words);
      return;
    }
    const int code = runTrainee(*options, *simulated);
    if (code != 0) throw ExitWith(code);
  });
}

}  // namespace

void addTeachFamily(Command& app) {
  scene::setLumpSolver(elements::solveLump);
  addTrainCommand(app);
}

}  // namespace palpate::app
