#include "teach/window/training_mode.h"

#include <algorithm>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/language.h"
#include "palpate/view/overlays/sink_rings.h"
#include "teach/window/training_painting.h"

namespace palpate::viewer {

namespace {

using training::Screen;

/// A finger of the mouse presses as hard as this everywhere, so that what differs is how far the skin gives way.
constexpr double kMousePressN = 2.0;
/// The window stands still for so long where another program holds the record; its rows are written in milliseconds,
/// and what could not be written is tried again at the trainee's next key.
constexpr std::chrono::milliseconds kMaxRecordWait{500};

}  // namespace

TrainingMode::TrainingMode(TrainingSettings settings)
    : settings_(std::move(settings)),
      store_(settings_.records, training::Store::Open::create_too, kMaxRecordWait),
      sign_in_(store_, settings_.protocol, settings_.sign_in),
      voice_(settings_.speech) {
  tidying_.start([records = settings_.records] {
    training::Store store(records, training::Store::Open::existing);
    return training::RecordingFiles(store).lockLeftBehind();
  });
  compose();
}

TrainingMode::~TrainingMode() { TrainingMode::finish("interrupted"); }

void TrainingMode::begin(ViewerState& viewer, const scene::World& world, window::Gui& gui) {
  ground_ = makeGround(world, viewer.scene, settings_.protocol);
  if (settings_.station) {
    const std::string app = engine::recordingHeader(viewer.ticks_per_s).software;
    class_ = settings_.station->connect(store_, app, viewer.held_by);
  }
  ViewState& state = viewer.state;
  state.shown = {.panel = true, .panel_right = true, .plots = false, .numbers = false, .reach = false};
  state.hints = false;
  const view::Shading shading = state.look.shading;
  state.look = {};
  state.look.shading = shading;
  state.touch = {.by = device::PressBy::force, .force_n = kMousePressN};
  viewer.mark_vertex = false;
  gui.useLargeLetters();
}

void TrainingMode::handleNewWorld(const scene::World& world) {
  if (run_) run_->handleNewWorld(world);
}

void TrainingMode::feel(const trace::Sample& sample) {
  handleButtons(sample.buttons);
  if (class_) class_->felt(sample);
  const bool came = world_.feel(sample.world);
  if (run_) run_->feel(sample, came, isAsked());
}

void TrainingMode::handleButtons(std::uint32_t buttons) {
  const std::uint32_t down = buttons & ~holder_.ignored_buttons;
  const bool pressed = down != 0 && buttons_ == 0;
  buttons_ = down;
  if (!pressed || !run_ || isAsked() || world_.waiting()) return;
  const std::vector<TrainingClick> meant = run_->task().button();
  clicks_.insert(clicks_.end(), meant.begin(), meant.end());
  if (meant.empty()) sign_in_.setNotice(tr("Touch the place that you mean, then press the button."));
}

void TrainingMode::requestBody(ViewerState& viewer, WorldSwap& world_swap) {
  if (!run_) return;
  if (world_.waiting() && !world_swap.failure().empty()) report(world_swap.failure());
  run_->requestBody(viewer, world_swap, isAsked());
}

void TrainingMode::look(const Sight& sight, const ViewerState& viewer) {
  seen_ = run_ ? run_->task().look(sight, finger_) : std::vector<SeenSite>();
  if (std::exchange(finger_.moved, false) && finger_.place) {
    sight.pointer.demonstrate(viewer.active_finger, *finger_.place, finger_.presses);
  }
}

void TrainingMode::adjust(view::PictureSettings& picture) const {
  picture.look.colouring = view::Colouring::plain;
  picture.look.overlays.reset();
  picture.look.skin_opacity = 1.0;
  picture.look.lens = screen_.shows_sink;
  picture.labels = view::LabelSettings::none();
  // The fingertip's pressures, where practice shows them: never what lies below.
  if (!run_ || isAsked() || !run_->task().padShown()) return;
  picture.look.show(view::Overlay::pressure);
  picture.labels.beneath = true;
}

std::vector<view::Lines> TrainingMode::marks(const scene::World& world, const ViewerState& viewer) const {
  if (!screen_.shows_sink || world_.waiting()) return {};
  return view::sinkRings(world, viewer.fingers[viewer.active_finger]);
}

/// A session that has not begun shows the door it came through.
void TrainingMode::compose() {
  TrainingView view;
  sign_in_.describe(view);
  view.leads_back = settings_.leads_back;
  view.over = over_;
  view.trouble = trouble_;
  view.message = message_;
  holder_.describe(view);
  view.focus = focus_;
  view.waiting = world_.waiting();
  if (run_) {
    run_->task().describe(view);
    view.now = run_->now();
    view.said_long_ago = run_->saidLongAgo();
    if (!isAsked() && run_->session().paused()) view.over = TrainingOver::paused;
  } else if (view.stage == TrainingStage::session) {
    view.stage = TrainingStage::choice;
  }
  screen_ = makeTrainingScreen(view);
  if (std::exchange(screen_title_, screen_.title) == screen_.title) return;
  const auto suggested = std::ranges::find_if(screen_.buttons, [](const auto& b) { return !b.badge.empty(); });
  const bool found = suggested != screen_.buttons.end();
  screen_.focus = focus_ = found ? static_cast<std::size_t>(suggested - screen_.buttons.begin()) : 0;
}

void TrainingMode::draw(const FreeArea& /*area*/) {
  const TrainingClick clicked = paintTraining(screen_, seen_);
  if (clicked.act != TrainingAct::none) clicks_.push_back(clicked);
}

bool TrainingMode::handle(const window::InputEvent& event, ViewerState& /*viewer*/, bool /*typing*/) {
  const TrainingStroke stroke = interpretInput(event, screen_);
  using Kind = TrainingStroke::Kind;
  if (stroke.kind == Kind::pass) return event.kind == window::InputEvent::Kind::drop;
  if (stroke.kind == Kind::press_button) {
    clicks_.push_back(stroke.click);
  } else if (stroke.kind == Kind::focus) {
    focus_ = stroke.index;
  } else if (run_) {
    const bool on_body = screen_.place == TrainingPlace::body;
    if (on_body || stroke.kind != Kind::letters) run_->task().handle(stroke, finger_);
  } else if (stroke.kind == Kind::letters) {
    sign_in_.type(stroke.text);
  } else if (stroke.kind == Kind::erase) {
    sign_in_.erase();
  }
  return true;
}

bool TrainingMode::handle(const window::Command& command, ViewerState& /*viewer*/) { return isForbidden(command); }

bool TrainingMode::handle(const Request& request, ViewerState& /*viewer*/) {
  return std::holds_alternative<Quit>(request) && !mayQuit();
}

bool TrainingMode::mayQuit() {
  quits_ = run_ && !run_->session().hasEnded();
  if (quits_) over_ = TrainingOver::leaving;
  return !quits_;
}

void TrainingMode::handle(const TrainingClick& click) {
  if (click.act == TrainingAct::quit) {
    quit_ = quit_ || mayQuit();
  } else if (isAsked()) {
    answerQuestion(click.act);
  } else if (run_) {
    act(click);
  } else if (settings_.leads_back && click.act == TrainingAct::no && sign_in_.asksForCode()) {
    quit_ = goes_back_ = true;
  } else {
    try {
      sign_in_.act(click.act, click.value);
    } catch (const Error& error) {
      sign_in_.setNotice(error.what());
    }
  }
}

void TrainingMode::answerQuestion(TrainingAct act) {
  const bool trouble = over_ == TrainingOver::trouble;
  if (trouble ? act != TrainingAct::retry : act != TrainingAct::yes && act != TrainingAct::no) return;
  if (trouble && run_ && run_->trouble().empty()) world_.fail();
  if (over_ == TrainingOver::leaving && act == TrainingAct::yes) return leaveNow();
  over_ = TrainingOver::none;
}

void TrainingMode::leaveNow() {
  quit_ = quit_ || (quits_ && over_ == TrainingOver::leaving);
  endSession();
}

void TrainingMode::act(const TrainingClick& click) {
  if (click.act == TrainingAct::leave) {
    quits_ = false;
    // A finished session needs no question.
    if (run_->session().hasEnded()) return endSession();
    over_ = TrainingOver::leaving;
    return;
  }
  const Task::Acted acted = run_->act(click);
  if (acted == Task::Acted::over) return endSession();
  if (acted == Task::Acted::done) finger_.lift();
}

void TrainingMode::beginSession(training::SessionKind kind, const ViewerState& viewer, LiveServo& servo) {
  try {
    training::SessionPlan plan = planSession(store_, settings_, {kind, sign_in_, holder_, ground_, viewer});
    plan.familiar = familiar_ == plan.row.trainee_id + plan.row.device;
    run_ = std::make_unique<SessionRun>(store_, servo, world_, ground_.base, makeTask(plan));
  } catch (const Error& error) {
    return sign_in_.returnToChoice(error.what());
  }
  voice_.beginSession();
  finger_ = {};
  storeNewRows();
}

void TrainingMode::endSession() {
  const std::string words = run_->finish("done");
  run_.reset();
  finger_.lift();
  world_.clear();
  over_ = TrainingOver::none;
  sign_in_.returnToChoice(words.empty() ? tr("Saved.") : words);
}

void TrainingMode::report(std::string trouble) {
  over_ = TrainingOver::trouble;
  trouble_ = std::move(trouble);
}

void TrainingMode::storeNewRows() {
  if (run_ && !run_->save()) report(run_->trouble());
}

/// Marks the record: a force that was cut off is not the trainee's.
void TrainingMode::followSafety(const ViewerState& viewer) {
  if (std::exchange(stopped_, viewer.devices.stopped) == viewer.devices.stopped) return;
  if (class_) class_->publish_safety(stopped_ ? "emergency stop" : "ok");
  if (session() == nullptr) return;
  session()->safety(stopped_ ? "emergency stop" : "emergency stop released", run_->now());
}

/// Follows an instructor's commands: none affects device or force.
void TrainingMode::followClass() {
  if (!class_) return;
  class_->follow(session());
  while (const auto command = class_->pop_command()) {
    using Kind = training::InstructorAct;
    if (command->kind == Kind::message) {
      message_ = command->text;
      if (!isAsked()) over_ = TrainingOver::message;
    } else if (run_ && command->kind == Kind::pause) {
      run_->session().pause(run_->now());
    } else if (run_ && command->kind == Kind::go_on) {
      run_->session().goOn(run_->now());
    } else if (session() != nullptr && command->kind == Kind::next_block) {
      leaveNow();
    }
  }
}

void TrainingMode::advance(const ModeWork& work) {
  holder_ = findHolder(work.viewer, work.servo);
  for (const TrainingClick& click : std::exchange(clicks_, {})) handle(click);
  if (const auto chosen = sign_in_.consumeChoice(!holder_.mouse)) beginSession(*chosen, work.viewer, work.servo);
  if (run_) run_->advance(work.elapsed_s, isAsked());
  if (const training::Session* now = session()) {
    const bool knows = now->screen() == Screen::instruction || now->screen() == Screen::trial;
    if (knows) familiar_ = now->plan().row.trainee_id + now->plan().row.device;
  }
  followSafety(work.viewer);
  followClass();
  storeNewRows();
  requestBody(work.viewer, work.world_swap);
  voice_.follow(run_ && !isAsked() ? &run_->session() : nullptr, screen_.title);
  compose();
}

std::string TrainingMode::finish(std::string_view ended_by) {
  voice_.stopSpeaking();
  if (!run_) return {};
  std::string words = run_->finish(ended_by);
  run_.reset();
  return words;
}

}  // namespace palpate::viewer
