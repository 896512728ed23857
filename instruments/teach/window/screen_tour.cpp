#include "teach/window/screen_tour.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/private_folder.h"
#include "palpate/training/records/trainee_code.h"
#include "palpate/view/image.h"
#include "teach/window/training_mode.h"
#include "view/viewer/panels/widgets.h"
#include "view/viewer/viewer.h"

namespace palpate::viewer {

namespace {

namespace fs = std::filesystem;
using training::Screen;
using window::Key;

/// Longer than a body is built and a press lasts, s.
constexpr double kPatienceS = 60.0;
constexpr double kTourFrameS = 1.0 / 60.0;
/// So that the same pictures show the same trials.
constexpr std::uint64_t kTourSeed = 7;
constexpr std::uint64_t kTourCode = 0x1234567;

/// One that is gone afterwards, with all that was answered.
class RecordsOfNobody {
 public:
  fs::path file() const { return folder_.path() / "nobody.results"; }

 private:
  TemporaryFolder folder_{"palpate-tour"};
};

class Tour {
 public:
  Tour(const std::shared_ptr<const scene::World>& world, const TourSettings& settings) : settings_(settings) {
    ViewerSettings of_viewer;
    of_viewer.intro = false;
    of_viewer.output_folder = settings.folder;
    auto training = std::make_unique<TrainingMode>(
        TrainingSettings{.records = records_.file(), .protocol = settings.protocol, .seed = kTourSeed});
    training_ = training.get();
    of_viewer.modes.push_back(std::move(training));
    viewer_ = std::make_unique<Viewer>(world, settings.state, std::move(of_viewer));
    frames(3);
  }

  std::vector<fs::path> go() {
    fs::create_directories(settings_.folder);
    frontDesk();
    practice();
    test();
    free();
    return std::move(files_);
  }

 private:
  void frontDesk() {
    saveScreen("welcome");
    text("7Q2MK-9DX");
    key(Key::enter);
    saveScreen("typing-error");
    for (int i = 0; i < 9; ++i) key(Key::backspace);
    text(training::makeTraineeCode(kTourCode));
    key(Key::enter);
    saveScreen("new-code");
    key(Key::enter);
    saveScreen("what-is-kept");
    key(Key::enter);
    saveScreen("hand");
    key(Key::right);
    key(Key::enter);
    saveScreen("choice");
  }

  void practice() {
    choose(training::SessionKind::practice);
    saveScreen("device-check");
    pressSite(4);
    key(Key::enter);
    settle();
    pressSite(10, true);
    pressSite(4);
    saveScreen("familiarisation");
    key(kKeyT);
    key(Key::space);
    settle();
    pressSite(10, true);
    pressSite(4);
    saveScreen("which-is-stiffer");
    key(Key::space);
    answerFamiliar();
    saveScreen("instruction");
    key(Key::space);
    settle();
    for (const int site : {1, 2, 3, 9}) pressSite(site, true);
    saveScreen("practice-trial");
    answer(truth());
    saveScreen("right");
    key(Key::space);
    settle();
    answer(truth() % 12 + 1);
    settle();
    pressSite(truth());
    saveScreen("wrong");
    key(kKeyT);
    key(Key::space);
    settle();
    key(window::key('P'));
    saveScreen("paused");
    key(Key::escape);
    saveScreen("leaving");
    key(Key::right);
    key(Key::enter);
    saveScreen("choice-again");
  }

  void test() {
    choose(training::SessionKind::pre_test);
    settle();
    key(Key::space);
    settle();
    for (const int site : {1, 2, 7}) pressSite(site, true);
    key(Key::backspace);
    text("7");
    saveScreen("test-trial");
    key(Key::enter);
    saveScreen("not-pressed-yet");
    key(Key::enter);
    settle();
    saveScreen("answer-saved");
    while (screen() == Screen::trial) {
      answer(truth());
      settle();
    }
    saveScreen("test-summary");
    key(Key::space);
    saveScreen("finished");
    key(Key::space);
  }

  void free() {
    choose(training::SessionKind::free);
    settle();
    saveScreen("free-exploration");
    key(Key::enter);
    settle();
    key(Key::enter);
  }

  // --- hands

  Screen screen() const { return training_->session()->screen(); }
  int truth() const { return training_->session()->hidden()->site; }

  void frame(const std::vector<window::InputEvent>& events = {}) {
    viewer_->frame(settings_.width, settings_.height, 1.0, now_s_ += kTourFrameS, events);
  }
  void frames(int count) {
    for (int i = 0; i < count; ++i) frame();
  }

  /// Frames until it is so.
  template <class Ready>
  void until(const Ready& ready, const char* what) {
    for (const auto end = now_s_ + 60.0 * kPatienceS; !ready();) {
      if (now_s_ > end) throw Error(fmt::format("screen tour: timed out waiting for {}", what));
      frame();
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }
  void settle() {
    frames(2);
    until([this] { return !training_->waiting(); }, "the body of a trial");
    frames(2);
  }

  void key(Key k) {
    window::InputEvent event;
    event.kind = window::InputEvent::Kind::key;
    event.key = k;
    event.time_s = now_s_;
    event.down = true;
    frame({event});
    event.down = false;
    frame({event});
    frames(2);
  }
  void text(const std::string& letters) {
    window::InputEvent event;
    event.kind = window::InputEvent::Kind::text;
    event.text = letters;
    frame({event});
    frames(2);
  }

  void choose(training::SessionKind kind) {
    const std::string name = nameOfKind(kind);
    for (std::size_t i = 0; i < 10; ++i) {
      const TrainingScreen& shown = training_->screen();
      if (shown.buttons[shown.focus].label == name) break;
      key(Key::down);
    }
    key(Key::enter);
    settle();
  }

  void answer(int site) {
    settle();
    for (int i = 0; i < 2 && screen() == Screen::trial; ++i) {
      const int before = training_->session()->trialNumber();
      key(Key::backspace);
      text(fmt::format("{}", site));
      key(Key::enter);
      if (screen() != Screen::trial || training_->session()->trialNumber() != before) return;
    }
  }

  void answerFamiliar() {
    key(Key::backspace);
    text(fmt::format("{}", truth()));
    key(Key::enter);
    settle();
  }

  /// With the keyboard's finger, until the dot is filled or for a moment.
  void pressSite(int site, bool lifts = false) {
    const bool trial = training_->screen().picks_sites;
    key(Key::backspace);
    text(fmt::format("{}", site));
    key(trial ? Key::space : kKeyT);
    const auto end = now_s_ + 2.0;
    const auto pressed = [&] { return training_->session()->visited(site); };
    while (now_s_ < end && !((trial || lifts) && pressed())) {
      frame();
      std::this_thread::sleep_for(std::chrono::milliseconds(16));
    }
    if (lifts) key(trial ? Key::space : kKeyT);
  }

  void saveScreen(const std::string& name) {
    frames(2);
    fs::path file = settings_.folder / fmt::format("{:02}-{}.png", files_.size() + 1, name);
    view::writePng(file, viewer_->target().read());
    files_.push_back(std::move(file));
  }

  static constexpr Key kKeyT = window::key('T');
  const TourSettings& settings_;
  const RecordsOfNobody records_;
  const view::OffscreenContext context_;
  std::unique_ptr<Viewer> viewer_;
  const TrainingMode* training_ = nullptr;  ///< the viewer's
  double now_s_ = 0.0;
  std::vector<fs::path> files_;
};

}  // namespace

std::vector<fs::path> tourScreens(const std::shared_ptr<const scene::World>& world, const TourSettings& settings) {
  return Tour(world, settings).go();
}

}  // namespace palpate::viewer
