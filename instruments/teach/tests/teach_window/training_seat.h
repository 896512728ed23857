// Somebody at a training window without a window: keys in, frames out, and what is in the record.
#pragma once

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "palpate/base/stopwatch.h"
#include "palpate/scene/scene_file.h"
#include "palpate/training/records/trainee_code.h"
#include "palpate/view/offscreen.h"
#include "support/wait_for.h"
#include "teach/window/training_mode.h"
#include "teach/window/training_words.h"
#include "view/viewer/viewer.h"

namespace palpate::viewer {

inline std::string someCode(std::uint64_t bits = 0x1234567) { return training::makeTraineeCode(bits); }

inline window::InputEvent pressOf(window::Key key, window::Modifiers modifiers = {}) {
  window::InputEvent event;
  event.kind = window::InputEvent::Kind::key;
  event.key = key;
  event.modifiers = modifiers;
  event.down = true;
  return event;
}

inline constexpr int kSeatWidth = 640;
inline constexpr int kSeatHeight = 480;

/// A torso that is soon built, the same for all tests.
inline std::shared_ptr<const scene::World> smallTorso() {
  static const auto world = [] {
    scene::Scene scene = scene::parse("[body]\ntriangles = 8164\n", "training.toml");
    scene.file.clear();
    return scene::build(scene);
  }();
  return world;
}

/// What is in the record.
inline std::vector<training::TrialRow> trialsIn(const std::filesystem::path& records) {
  training::Store store(records, training::Store::Open::existing);
  std::vector<training::TrialRow> trials;
  for (const auto& session : store.sessions()) {
    for (const auto& block : store.blocks(session.id)) {
      for (auto& trial : store.trials(block.id)) trials.push_back(std::move(trial));
    }
  }
  return trials;
}

/// A mode behind training, as the package that measures photographs brings one: counts what would open it.
class ShutMode final : public Mode {
 public:
  Claims claims() const override { return {}; }
  bool handle(const window::Command& command, ViewerState& /*viewer*/) override {
    reached += command.action == window::Action::measure_person ? 1 : 0;
    return false;
  }
  bool handle(const Request& request, ViewerState& /*viewer*/) override {
    reached += std::holds_alternative<OpenFile>(request) ? 1 : 0;
    return false;
  }

  int reached = 0;
};

/// Somebody at a training window: keys, frames, and what is in the record.
class TrainingSeat {
 public:
  explicit TrainingSeat(const std::filesystem::path& records, std::optional<training::SessionKind> kind = {},
                        const training::Protocol& protocol = training::builtInProtocol(),
                        const std::optional<training::ClassStation>& station = {}) {
    ViewerSettings settings;
    settings.intro = false;
    settings.output_folder = records.parent_path();
    TrainingSettings of_training;
    of_training.records = records;
    of_training.protocol = protocol;
    of_training.seed = 5;
    of_training.sign_in = {.class_id = station ? station->of.id : "", .code = someCode(), .kind = kind};
    of_training.station = station;
    auto training_mode = std::make_unique<TrainingMode>(of_training);
    training = training_mode.get();
    settings.modes.push_back(std::move(training_mode));
    auto other_mode = std::make_unique<ShutMode>();
    shut = other_mode.get();
    settings.modes.push_back(std::move(other_mode));
    ViewState state;
    state.look.shading = view::Shading::gouraud;  // quick to draw
    viewer = std::make_unique<Viewer>(smallTorso(), state, std::move(settings));
    frames(3);
  }

  /// No pixels: without a graphics card they are most of a frame's cost, and nobody here looks at them. Frames follow
  /// each other as on a screen: the hand's time is the servo's, and the clock's.
  void frame(const std::vector<window::InputEvent>& events = {}) {
    glEnable(GL_RASTERIZER_DISCARD);
    viewer->frame(kSeatWidth, kSeatHeight, 1.0, now_s += 1.0 / 60.0, events);
    glDisable(GL_RASTERIZER_DISCARD);
    std::this_thread::sleep_until(next_frame_);
    next_frame_ = Clock::now() + std::chrono::milliseconds(16);
  }
  void frames(int count) {
    for (int i = 0; i < count; ++i) frame();
  }
  void key(window::Key k, window::Modifiers modifiers = {}) {
    window::InputEvent event = pressOf(k, modifiers);
    frame({event});
    event.down = false;
    frame({event});
    frame();
  }
  void text(const std::string& letters) {
    window::InputEvent event;
    event.kind = window::InputEvent::Kind::text;
    event.text = letters;
    frame({event});
    frame();
  }
  template <class Ready>
  bool until(const Ready& ready) {
    return support::waitFor([&] {
      frame();
      return ready();
    });
  }
  bool settled() {
    frame();
    return until([this] { return !training->waiting(); });
  }
  void comeIn() {
    for (int i = 0; i < 3; ++i) key(window::Key::enter);  // new here, agrees, left hand
  }
  /// Into familiarisation.
  bool checkDevice() {
    if (!settled()) return false;
    pick(4);
    key(window::key('T'));
    if (!until([this] { return words().find("Your device works") != std::string::npos; })) return false;
    key(window::Key::space);
    return settled() && session().screen() == training::Screen::familiarisation;
  }
  /// Past device check and familiarisation, into the first trial.
  bool begin() {
    if (!checkDevice() || !familiarise()) return false;
    key(window::Key::space);
    return settled() && session().screen() == training::Screen::trial;
  }
  /// Feels nothing and knows the answer: is told once to press, is asked, and names the place.
  bool familiarise() {
    key(window::Key::space);
    key(window::Key::space);
    if (!settled() || !session().asks()) return false;
    pick(session().hidden()->site);
    key(window::Key::enter);
    return settled() && session().screen() == training::Screen::instruction;
  }
  void pick(int site) {
    key(window::Key::backspace);
    text(std::to_string(site));
  }
  /// Until its dot is filled.
  bool press(int site) {
    pick(site);
    key(window::Key::space);
    const bool filled = until([&] { return session().visited(site); });
    key(window::Key::space);
    return filled;
  }
  /// Taken at the second time, when nothing was pressed.
  void answer(int site) {
    const std::size_t before = session().trials().size();
    for (int i = 0; i < 2 && session().trials().size() == before; ++i) {
      pick(site);
      key(window::Key::enter);
    }
  }

  std::string words() const {
    std::string all;
    for (const std::string& part : wordsOf(training->screen())) all += part + "\n";
    return all;
  }
  const training::Session& session() const { return *training->session(); }

  const view::OffscreenContext context;
  std::unique_ptr<Viewer> viewer;
  const TrainingMode* training = nullptr;  ///< the viewer's
  const ShutMode* shut = nullptr;          ///< and one that nothing may open
  double now_s = 0.0;

 private:
  Clock::time_point next_frame_ = Clock::now();
};

}  // namespace palpate::viewer
