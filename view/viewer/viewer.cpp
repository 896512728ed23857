#include "view/viewer/viewer.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "view/viewer/editing/acts.h"
#include "view/viewer/editing/dysfunction_editor.h"
#include "view/viewer/editing/rings.h"
#include "view/viewer/files/recorded_session.h"
#include "view/viewer/files/scene_snippet.h"
#include "view/viewer/files/view_text.h"
#include "view/viewer/home_view.h"
#include "view/viewer/leaving.h"
#include "view/viewer/panels/gui_layout.h"
#include "view/viewer/panels/hints.h"
#include "view/viewer/panels/widgets.h"
#include "palpate/base/error.h"
#include "palpate/base/stopwatch.h"
#include "palpate/trace/forces_table.h"
#include "palpate/trace/session_reader.h"

namespace palpate::viewer {

namespace {

using Kind = window::Command::Kind;

constexpr double kFlightS = 0.35;
/// The frame rate shown is the mean of about this many frames.
constexpr double kRateSmoothing = 0.05;
/// Narrower windows start without the side panel.
constexpr double kNarrowPoints = 1000.0;
/// Of the finger that stays where it was put, points.
constexpr double kOutline = 1.5;
/// A script's finger without a size is drawn as a fingertip.
constexpr double kDrawnPointMm = 8.0;
/// Of a picture without background: each pixel is the mean of this many squared.
constexpr int kClearSupersampling = 2;

/// Of devices that are open before there is a servo.
std::vector<device::Capabilities> abilitiesOf(const std::vector<OpenedDevice>& devices) {
  std::vector<device::Capabilities> able;
  for (const OpenedDevice& opened : devices) able.push_back(abilityOf(opened));
  return able;
}

WorldFacts factsOf(const scene::World& world) {
  const Vec3 size = mesh::boundingBox(world.skin).sizes();
  const auto [soft, stiff] = std::minmax_element(world.stiffness_n_per_mm.begin(), world.stiffness_n_per_mm.end());
  return {.name = world.body_name,
          .triangles = world.skin.triangles.size(),
          .vertices = world.skin.positions.size(),
          .width_mm = size.x(),
          .height_mm = size.y(),
          .depth_mm = size.z(),
          .closed = world.closed,
          .has_bones = !world.anatomy.bones.empty(),
          .softest_n_per_mm = *soft,
          .stiffest_n_per_mm = *stiff,
          .notes = world.notes,
          .has_picture = world.texture != nullptr,
          .channels = world.channels,
          .tissue = scene::inWords(world.tissue),
          .has_names = !world.anatomy.landmarks.empty()};
}

Wish photographWish(const std::string& file, const MeasuringView& view) {
  const bool before = freePlace(view) == Photo::before;
  return {.kind = before ? Wish::Kind::measure_before : Wish::Kind::measure_after, .file = file};
}

}  // namespace

Viewer::Viewer(const std::shared_ptr<const scene::World>& world, ViewState state, ViewerSettings settings,
               ViewerHost host)
    : settings_(std::move(settings)),
      host_(std::move(host)),
      world_(world),
      servo_(planFor(world, world->scene, true, abilitiesOf(settings_.devices)), settings_.devices),
      model_(std::make_unique<LiveModel>(world)),
      turnover_(world),
      devices_(servo_, turnover_),
      keeper_(servo_, settings_.session_folder),
      history_(servo_.thread().ticksPerS()),
      outputs_(settings_.output_folder),
      training_(settings_.training ? std::make_unique<TrainingDesk>(*settings_.training) : nullptr),
      eyesight_(host_.quad_buffer) {
  session_.state = std::move(state);
  session_.scene = world->scene;
  session_.document = documentOf(world->scene.file);
  session_.output_folder = outputs_.folder();
  takeFacts();
  session_.profile.knots = world->deformation.normal_profile.knots;
  session_.held = servo_.abilities();
  session_.ticks_per_s = servo_.thread().ticksPerS();
  turnover_.planNow(session_);  // tells the session what the limits are
  for (SampleHistory& plot : session_.plots.fingers) plot = SampleHistory(session_.ticks_per_s);
  input_.settings = session_.state.input;
  session_.performance.graphics = view::rendererWords();
  devices_.begin(session_);
  if (!training_) return;
  training_->begin(session_, *world);
  gui_.useLargeLetters();
}

Viewer::~Viewer() = default;

void Viewer::takeFacts() {
  const bool other_file = session_.world.channels != world_->channels;
  session_.world = factsOf(*world_);
  if (!other_file) return;
  const std::string words = useChannelsOf(*world_, session_.state.look);
  if (!words.empty()) session_.report(Severity::info, words);
}

servo::LoopReport Viewer::finish(std::string_view ended_by) {
  servo::LoopReport report = servo_.thread().stop();
  takeSamples();
  if (training_) {
    if (const std::string words = training_->finish(ended_by); !words.empty()) session_.report(Severity::error, words);
  }
  keeper_.finish(session_, ended_by);
  outputs_.finish(session_);
  return report;
}

void Viewer::frame(int width, int height, double scale, double now_s, std::span<const window::InputEvent> events) {
  const Clock::time_point started = Clock::now();
  const double elapsed_s = seen_ ? std::max(1e-4, now_s - session_.now_s) : 1.0 / 60.0;
  session_.now_s = now_s;
  makeTarget(width, height);
  takeWorld();
  takeReplay();
  followServo(elapsed_s);
  const double points = scale * session_.state.text_size;
  if (std::exchange(theme_, session_.state.theme) != session_.state.theme) gui_.setTheme(session_.state.theme);
  stereo_ = eyesight_.settings(session_);
  const view::EyePicture eye = view::eyePictureIn(stereo_.mode, width, height);
  session_.size_points = Vec2(eye.seen_width, eye.seen_height) / points;
  gui_.begin(session_.size_points, points, elapsed_s, asOneEyeSees(events, stereo_.mode, width, height));
  showCursor();
  lookAround();
  handle(events);
  intro_.advance(pointer_, *world_, now_s);
  pointer_.advance(session_);
  placeRulerLabel();
  drawPanels();
  const Asks& asks = session_.asks;
  const bool held = ImGui::IsAnyItemActive();
  const bool any = held || !events.empty() || asks.changed != kNothing || !asks.wishes.empty();
  gui_.end();
  useChanges();
  train(elapsed_s);
  if (!session_.opening && !training_)
    session_.history.follow(session_, {held, session_.editor.before.has_value(), any});
  tellTitle();
  pointServo();
  paintAndKeep(points);
  if (std::exchange(clear_picture_, false)) paintClear(points);
  Performance& performance = session_.performance;
  performance.frame_ms = millisecondsSince(started);
  frame_s_ += kRateSmoothing * (elapsed_s - frame_s_);
  performance.frames_per_s = 1.0 / frame_s_;
  guardShading(elapsed_s);
  seen_ = true;
}

void Viewer::drawPanels() {
  if (!training_) {
    drawGui(session_);
    return;
  }
  widgetPlaces().clear();
  training_->paint();
  const FreeArea free = freeArea(session_.state.shown, static_cast<float>(session_.size_points.x()),
                                 static_cast<float>(session_.size_points.y()));
  if (session_.devices.stopped) stopBanner(free, session_.asks);
  toast(session_.messages, session_.now_s, free);
}

void Viewer::train(double elapsed_s) {
  if (!training_) return;
  training_->advance(session_, servo_, turnover_, elapsed_s);
  quit_ = quit_ || training_->wantsToQuit();
}

void Viewer::makeTarget(int width, int height) {
  if (target_ && target_->width() == width && target_->height() == height) return;
  target_ = std::make_unique<view::Target>(std::max(1, width), std::max(1, height));
}

/// What the cursor's pixels mean in this frame; the first time also where the camera stands.
void Viewer::lookAround() {
  if (!seen_) {
    // The column of a trainee stands in any window: the body keeps to what it leaves.
    if (!training_ && session_.size_points.x() < kNarrowPoints) session_.state.shown.panel = false;
    session_.camera = homeView(*world_, session_.state.shown, view::StandardView::back, session_.size_points);
    takeSceneLook(*world_, session_, session_.size_points);
    beginScene();
    if (training_) setView(view::StandardView::back);
    if (settings_.intro && !session_.state.reduced_motion) intro_.begin(*world_, session_.now_s);
  }
  const view::EyePicture eye = view::eyePictureIn(stereo_.mode, target_->width(), target_->height());
  eyes_ = view::eyesOf(session_.camera, stereo_, eye.aspect());
  pointer_.look({eyes_.screen, eyes_.middle, Vec2(target_->width(), target_->height()), stereo_.mode}, world_);
  if (!training_) return;
  constexpr double kNearMm = 1.0;
  constexpr double kFarMm = 1e6;
  training_->look(view::frustumOf(eyes_.screen, eyes_.middle, kNearMm, kFarMm), session_.size_points,
                  target_->width() / session_.size_points.x(), pointer_, session_);
}

void Viewer::takeWorld() {
  const Turnover::Shown shown = turnover_.takeShown(servo_.thread());
  if (!shown.world) return;
  const bool other_scene = std::exchange(session_.opening, false);
  world_ = shown.world;
  model_->setWorld(world_);
  if (training_) training_->worldCame(*world_);
  takeFacts();
  if (session_.profile.handle < 0) session_.profile.knots = world_->deformation.normal_profile.knots;
  if (!shown.other_body) return;
  devices_.bodyChanged();
  session_.reading.reset();
  history_.clear();
  freeze(session_.replay, false);
  pointer_.reset();
  std::vector<window::Command> lifted;
  input_.handle({.kind = window::InputEvent::Kind::focus}, {}, lifted);
  if (!seen_) return;
  session_.ruler = {};
  view::Camera camera = homeView(*world_, session_.state.shown, view::StandardView::back, session_.size_points);
  if (other_scene) {
    const view::Camera before = session_.camera;
    if (takeSceneLook(*world_, session_, session_.size_points)) camera = std::exchange(session_.camera, before);
    beginScene();
  }
  standard_view_ = static_cast<int>(view::StandardView::back);
  pointer_.fly(camera, session_, kFlightS);
}

/// Nothing of it has been changed yet. What has no file is saved as it is seen, habits included.
void Viewer::beginScene() {
  const bool of_file = !session_.document.file.empty();
  session_.opened = {.look = of_file ? session_.state.look : view::Look{},
                     .stereo = of_file ? session_.state.stereo : view::StereoSettings{}};
  session_.history.begin(session_);
}

void Viewer::followServo(double elapsed_s) {
  takeSamples();
  Performance& performance = session_.performance;
  performance.servo = servo_.thread().vitals();
  performance.dropped_samples = servo_.thread().droppedSamples();
  if (!session_.replay.frozen && recorded_) leaveReplay();
  if (session_.replay.beside.empty()) {
    beside_.reset();
    beside_model_.reset();
  }
  advanceReplay(session_.replay, history(), elapsed_s * session_.time_speed);
  if (beside_) beside_model_->follow(momentBeside());
  if (session_.replay.frozen && !history().empty()) {
    show(history().at(session_.replay.at_s));
  } else {
    show(servo_.thread().contacts());
  }
}

void Viewer::show(std::span<const trace::Sample> contacts) {
  for (std::size_t i = 0; i < kFingers; ++i) session_.fingers[i] = contacts[i].contact;
  const LiveModel::Times times = model_->follow(contacts);
  session_.performance.deform_ms = times.deform_ms;
  session_.performance.upload_ms = times.upload_ms;
}

/// A recorded table that has been felt again is shown frozen at its beginning, and the plots show it.
void Viewer::takeReplay() {
  auto result = replay_loader_.take();
  if (!result) return;
  if (!result->touch) return session_.report(Severity::error, "cannot replay " + result->error);
  session_.messages.clearErrors("cannot replay ");
  for (const std::string& note : result->touch->notes) session_.report(Severity::warning, note);
  if (std::exchange(loads_beside_, false) && recorded_) return takeBeside(std::move(*result->touch));
  if (recorded_) leaveReplay();
  recorded_ = std::move(result->touch);
  if (recorded_->world) model_->setWorld(recorded_->world);
  const TouchHistory& history = recorded_->history;
  for (SampleHistory& plot : session_.plots.fingers) plot = SampleHistory(recorded_->ticks_per_s, kLongestReplayS);
  history.forEach([this](const trace::Sample& sample) { plot(sample); });
  session_.replay = {.at_s = history.oldestTime(),
                     .from_s = history.oldestTime(),
                     .to_s = history.newestTime(),
                     .playing = recorded_->of_script,
                     .table = recorded_->file,
                     .tick_s = history.tick(),
                     .frozen = true,
                     .marks = recorded_->marks};
  session_.plots.paused = false;
  if (!session_.beside_at_first.empty()) {
    session_.wish(Wish::Kind::open_beside, std::exchange(session_.beside_at_first, {}));
  }
  if (!trace::isSession(recorded_->file) && trace::isUnfinished(recorded_->file)) {
    session_.report(Severity::warning,
                    fmt::format("{} was not finished: its {:.1f} s are what was written before the end",
                                recorded_->file, session_.replay.to_s - session_.replay.from_s));
  }
}

constexpr const char* kStillReading = "Another table is still being read";

void Viewer::replay(const std::string& file, bool beside) {
  const auto read = [world = world_, scene = session_.scene, file] {
    return trace::isSession(file) ? touchOfSession(file) : touchedAgain(world, scene, file);
  };
  if (!replay_loader_.load(read)) return session_.report(Severity::info, kStillReading);
  loads_beside_ = beside;
}

/// Another session on the right, from its own beginning on.
void Viewer::takeBeside(RecordedTouch touch) {
  beside_ = std::move(touch);
  beside_model_ = std::make_unique<LiveModel>(beside_->world ? beside_->world : world_);
  session_.replay.beside = beside_->file;
}

void Viewer::playScript() {
  if (recorded_ && recorded_->of_script) return freeze(session_.replay, false);
  if (world_->scene.fingers.empty()) {
    return session_.report(Severity::info, "This scene has no fingers of its own: it says nothing under [[finger]]");
  }
  if (!replay_loader_.load([world = world_] { return touchOfScript(world); })) {
    session_.report(Severity::info, kStillReading);
  }
}

void Viewer::leaveReplay() {
  if (recorded_->world) model_->setWorld(world_);
  recorded_.reset();
  session_.replay = {};
  for (SampleHistory& plot : session_.plots.fingers) plot = SampleHistory(session_.ticks_per_s);
}

void Viewer::plot(const trace::Sample& sample) {
  session_.plots.fingers[sample.finger].add(sample, session_.device_limit_n);
}

void Viewer::takeSamples() {
  trace::Sample sample;
  while (servo_.thread().pop(sample)) {
    outputs_.addSample(session_, sample);
    devices_.felt(sample, session_);
    if (training_) training_->feel(sample);
    if (session_.replay.frozen) continue;  // what is studied stays as it is
    plot(sample);
    history_.add(sample);
  }
}

void Viewer::handle(std::span<const window::InputEvent> events) {
  input_.settings = session_.state.input;
  input_.useFinger(session_.active_finger);
  std::vector<window::Command> commands;
  for (const window::InputEvent& event : events) {
    using EventKind = window::InputEvent::Kind;
    if (devices_.hears(event, gui_.wantsText(), session_)) continue;
    if (event.kind == EventKind::drop && !training_) session_.wish(Wish::Kind::open, event.text);
    if (event.kind == EventKind::move || event.kind == EventKind::button) intro_.end(pointer_);
    if (session_.question && event.kind == EventKind::key) {
      const std::string_view chosen = event.down ? answerOf(event.key, session_) : std::string_view();
      if (!chosen.empty()) session_.wish(Wish::Kind::answer, std::string(chosen));
      continue;
    }
    if (hearsOfMeasuring(event)) continue;
    if (training_ && training_->hears(event)) continue;
    window::Situation situation;
    situation.over_gui =
        gui_.wantsMouse() || session_.question || session_.measuring.open || (training_ && !training_->offersBody());
    situation.gui_wants_text = gui_.wantsText();
    situation.editing = session_.editor.active || session_.ruler.active;
    situation.on_skin = event.kind == EventKind::button && pointer_.skinAt(event.at).has_value();
    commands.clear();
    input_.handle(event, situation, commands);
    for (const window::Command& command : commands) obey(command);
  }
}

/// A key that means something to the photographs alone.
bool Viewer::hearsOfMeasuring(const window::InputEvent& event) {
  const Shown& shown = session_.state.shown;
  if (!session_.measuring.open || event.kind != window::InputEvent::Kind::key || !event.down) return false;
  if (gui_.wantsText() || shown.help || shown.messages || shown.open_dialog || shown.save_dialog) return false;
  return measuringKey(session_.measuring, event.key, event.modifiers, session_.asks);
}

void Viewer::obey(const window::Command& command) {
  if (training_ && !training_->allows(command)) return;
  countHint(command, session_.hint, session_.state.hints);
  if (command.kind == Kind::act) return actOn(command);
  // With nothing selected the wheel has nothing to size, so it zooms.
  if (command.kind == Kind::edit_size && (session_.ruler.active || session_.editor.selected < 0)) {
    window::Command zoom = command;
    zoom.kind = Kind::zoom;
    pointer_.apply(zoom, session_);
    return;
  }
  if (command.kind == Kind::press) {
    if (const auto place = pointer_.skinAt(command.at)) session_.reading = readVertex(*world_, place->point);
  }
  if (pointer_.apply(command, session_)) return;
  if (session_.ruler.active) return measure(command);
  const auto place = pointer_.skinAt(command.at);
  std::optional<Vec2> on_map;
  if (place) on_map = Vec2(place->point.x(), place->point.y());
  applyEdit(command, on_map, session_.dysfunctions());
}

void Viewer::actOn(const window::Command& command) {
  using view::StandardView;
  using window::Action;
  if (replayKey(command.action, command.fine, session_.replay)) return;
  if (pointer_.step(command.action, command.fine, session_)) return;
  switch (command.action) {
    case Action::centre_on_finger:
      if (const auto& place = pointer_.placeOf(session_.active_finger)) {
        flyTo(view::centredOn(session_.camera, place->point));
      }
      return;
    case Action::next_view:
    case Action::previous_view: {
      constexpr int kViews = static_cast<int>(std::size(view::kStandardViewNames));
      standard_view_ = (standard_view_ + (command.action == Action::next_view ? 1 : kViews - 1)) % kViews;
      return setView(static_cast<StandardView>(standard_view_));
    }
    case Action::view_back:
      return setView(StandardView::back);
    case Action::view_right:
      return setView(StandardView::right);
    case Action::view_above:
      return setView(StandardView::above);
    default:
      return perform(command.action, session_);
  }
}

void Viewer::setView(view::StandardView side) {
  standard_view_ = static_cast<int>(side);
  if (training_) return flyTo(viewOf(training_->seenBox(), session_.state.shown, side, session_.size_points));
  flyTo(homeView(*world_, session_.state.shown, side, session_.size_points));
}

/// Because the user wants to see it from there.
void Viewer::flyTo(const view::Camera& camera) {
  session_.opened.camera_moved = true;
  pointer_.fly(camera, session_, kFlightS);
}

void Viewer::measure(const window::Command& command) {
  if (command.kind != Kind::edit_grab) return;
  if (const auto place = pointer_.skinAt(command.at)) measureAt(*place, world_->surface, session_.ruler);
}

/// Beside its second end, as the middle of both eyes sees it.
void Viewer::placeRulerLabel() {
  Ruler& ruler = session_.ruler;
  if (ruler.ends.size() < 2) return;
  constexpr double kNearMm = 1.0;
  constexpr double kFarMm = 1e6;
  const view::Frustum frustum = view::frustumOf(eyes_.screen, eyes_.middle, kNearMm, kFarMm);
  const Vec2 seen = view::seenAt(frustum, ruler.ends[1].point);
  ruler.label = seen.allFinite() ? Vec2(seen.cwiseProduct(session_.size_points)) : Vec2(0.5 * session_.size_points);
}

void Viewer::tellTitle() {
  std::string title = titleOf(session_);
  if (!host_.set_title || title == title_ || training_) return;
  title_ = std::move(title);
  host_.set_title(title_);
}

void Viewer::useChanges() {
  for (const Wish& wish : std::exchange(session_.asks.wishes, {})) {
    if (!mustAskFirst(wish, session_)) grant(wish);
  }
  measuring_.advance(session_, world_->anatomy.landmarks);
  devices_.advance(session_, *world_);
  keeper_.advance(session_);
  turnover_.advance(session_, servo_.thread());
  session_.asks.changed = kNothing;
}

void Viewer::grant(const Wish& wish) {
  if (grantOfScene(wish) || grantOfPicture(wish) || devices_.grant(wish, session_)) return;
  if (measuring_.grant(wish, session_)) return;
  switch (wish.kind) {
    case Wish::Kind::plots_csv:
      return outputs_.savePlots(session_);
    case Wish::Kind::record:
      return outputs_.toggleForces(session_);
    case Wish::Kind::keep_session:
      return keeper_.keep(session_, outputs_.folder());
    case Wish::Kind::mark:
      return keeper_.mark(session_, wish.file);
    case Wish::Kind::use_profile:
      return outputs_.useProfile(session_);
    case Wish::Kind::play_script:
      return playScript();
    case Wish::Kind::home:
      return setView(view::StandardView::back);
    case Wish::Kind::full_screen:
      if (host_.toggle_full_screen) host_.toggle_full_screen();
      return;
    case Wish::Kind::copy_view:
      if (host_.set_clipboard) host_.set_clipboard(viewAsText(session_.camera));
      return;
    case Wish::Kind::paste_view:
      if (const auto camera = viewFromText(host_.clipboard ? host_.clipboard() : "")) {
        flyTo(*camera);
      } else {
        session_.report(Severity::warning, "The clipboard holds no view");
      }
      return;
    case Wish::Kind::quit:
      quit_ = !training_ || training_->mayQuit();
      return;
    default:
      return;
  }
}

/// What comes, goes, changes or is kept of the scene as a whole.
bool Viewer::grantOfScene(const Wish& wish) {
  switch (wish.kind) {
    case Wish::Kind::open:
      if (isPhotograph(wish.file)) {
        measuring_.grant(photographWish(wish.file, session_.measuring), session_);
      } else if (trace::isForcesTable(wish.file) || trace::isSession(wish.file)) {
        replay(wish.file, session_.replay.chooses_beside);
      } else {
        turnover_.open(wish.file, session_);
      }
      return true;
    case Wish::Kind::open_beside:
      replay(wish.file, true);
      return true;
    case Wish::Kind::default_scene:
      turnover_.open(settings_.default_scene, session_);
      return true;
    case Wish::Kind::reload:
      reload();
      return true;
    case Wish::Kind::cancel_build:
      turnover_.cancel(session_);
      return true;
    case Wish::Kind::save:
      saveThen(wish, std::nullopt);
      return true;
    case Wish::Kind::answer:
      answer(wish.file);
      return true;
    case Wish::Kind::undo:
    case Wish::Kind::redo:
      takeBack(wish.kind == Wish::Kind::undo);
      return true;
    case Wish::Kind::reset:
      session_.history.reset(session_);
      return true;
    case Wish::Kind::copy_scene:
      copyScene();
      return true;
    default:
      return false;
  }
}

bool Viewer::grantOfPicture(const Wish& wish) {
  switch (wish.kind) {
    case Wish::Kind::screenshot:
    case Wish::Kind::screenshot_with_pop_ups:
      outputs_.askForScreenshot(wish.kind == Wish::Kind::screenshot_with_pop_ups);
      return true;
    case Wish::Kind::clear_screenshot:
      clear_picture_ = true;
      return true;
    case Wish::Kind::sequence:
      outputs_.toggleSequence(session_);
      return true;
    default:
      return false;
  }
}

/// What waited for the answer is done, unless the saving failed or has to ask something itself.
void Viewer::answer(const std::string& chosen) {
  if (!session_.question) return;
  const Question question = *std::exchange(session_.question, std::nullopt);
  const auto answers = answersTo(question);
  if (chosen == answers.back()) return;
  if (question.kind == Question::Kind::overwrite)
    return saveThen({Wish::Kind::save, question.file, true}, question.then);
  if (question.kind == Question::Kind::unmeasure) {
    const bool accepts = chosen == answers.front();
    if (accepts && measuring_.accept(session_, false) != MeasuringDesk::Accepting::done) return;
    session_.measuring.unsaved = false;
    return session_.asks.wishes.push_back(*question.then);  // it may have to ask for the scene, too
  }
  if (question.kind == Question::Kind::leave && chosen == answers.front()) {
    return saveThen({Wish::Kind::save}, question.then);
  }
  if (!question.then) return;
  Wish then = *question.then;
  then.sure = true;
  grant(then);
}

/// While photographs are looked at, what was corrected in them.
void Viewer::takeBack(bool undoes) {
  if (!session_.measuring.open) return undoes ? session_.history.undo(session_) : session_.history.redo(session_);
  const std::string words = undoes ? undoCorrection(session_.measuring) : redoCorrection(session_.measuring);
  const char* what = undoes ? "Undo" : "Redo";
  session_.report(Severity::info, words.empty() ? fmt::format("Nothing to {}", undoes ? "undo" : "redo")
                                                : fmt::format("{}: {}", what, words));
}

void Viewer::saveThen(Wish how, const std::optional<Wish>& then) {
  const Outputs::Saving saving = outputs_.saveScene(session_, how);
  if (saving == Outputs::Saving::asked) session_.question->then = then;
  if (saving != Outputs::Saving::done || !then) return;
  how = *then;
  how.sure = true;
  grant(how);
}

/// The scene's file, else the mesh's, else the built-in torso.
void Viewer::reload() {
  const scene::BodySettings& body = session_.scene.body;
  if (!session_.document.file.empty()) return turnover_.open(session_.document.file.string(), session_);
  if (body.kind == scene::BodyKind::mesh) return turnover_.open(body.file.string(), session_);
  turnover_.open(settings_.default_scene, session_);
}

void Viewer::copyScene() {
  if (!host_.set_clipboard) return session_.report(Severity::warning, "There is no clipboard");
  host_.set_clipboard(sceneSnippet(session_));
  session_.report(Severity::info, "What is seen and felt is on the clipboard, as a scene");
}

void Viewer::pointServo() {
  for (std::size_t i = 0; i < kFingers; ++i) {
    const device::FingerTarget target = pointer_.target(i, session_);
    session_.finger_present[i] = recorded_ ? i < recorded_->radius_mm.size() : target.present || servo_.isHeld(i);
    servo_.point(i, target);
  }
}

/// In a picture of two parts the system's pointer would be in one of them: ours is drawn in both.
void Viewer::showCursor() {
  const bool own = view::hasTwoParts(stereo_.mode);
  ImGui::GetIO().MouseDrawCursor = own;
  if (std::exchange(own_cursor_, own) != own && host_.show_cursor) host_.show_cursor(!own);
}

void Viewer::guardShading(double elapsed_s) {
  const ViewState& state = session_.state;
  if (!state.simpler_when_slow || state.look.shading == view::Shading::gouraud) {
    shading_guard_.reset();
  } else {
    const bool counts = seen_ && !session_.building && !session_.recording.sequence && !session_.measuring.open;
    const auto change = shading_guard_.frame(elapsed_s, 1e-3 * session_.performance.frame_ms, counts);
    if (change == ShadingGuard::Change::simpler) {
      // The menu bar says so as long as it lasts; a plate over the picture would hide what is slow already.
      session_.messages.note(fmt::format("Pictures came {:.0f} times a second, so the skin is drawn smooth for now; "
                                         "Show > shading decides for good",
                                         session_.performance.frames_per_s),
                             session_.now_s);
    } else if (change == ShadingGuard::Change::as_wished) {
      session_.messages.note("There is time to spare: the skin is drawn as before", session_.now_s);
    }
  }
  session_.simple_shading = shading_guard_.simple();
}

std::vector<view::FingerMark> Viewer::fingerMarks() {
  std::vector<view::FingerMark> marks;
  for (std::size_t i = 0; i < kFingers; ++i) {
    peaks_[i].follow(session_.fingers[i], session_.now_s);
    if (!session_.finger_present[i] || session_.fingers[i].tip.z() > 0.5 * device::kNowhere.z()) continue;
    const double radius =
        recorded_ && i < recorded_->radius_mm.size() ? recorded_->radius_mm[i] : fingerRadius(session_.scene, i);
    const bool left = i == 0;
    const double outline = i == session_.active_finger ? 0.0 : kOutline;
    marks.push_back({.contact = session_.fingers[i],
                     .radius_mm = recorded_ && radius <= 0.0 ? kDrawnPointMm : radius,
                     .colour = left ? view::kLeftFinger : view::kRightFinger,
                     .haptic_radius_mm = radius,
                     .left = left,
                     .outline = outline,
                     .lifted = peaks_[i].shown(session_.now_s)});
  }
  return marks;
}

/// The session on the right, as long after its beginning as the left one.
const TouchHistory::Moment& Viewer::momentBeside() const {
  const double since_s = session_.replay.at_s - session_.replay.from_s;
  return beside_->history.at(beside_->history.oldestTime() + since_s);
}

std::vector<view::FingerMark> Viewer::marksBeside() const {
  std::vector<view::FingerMark> marks;
  const TouchHistory::Moment& moment = momentBeside();
  for (std::size_t i = 0; i < std::min(kFingers, beside_->radius_mm.size()); ++i) {
    if (moment[i].contact.tip.z() > 0.5 * device::kNowhere.z()) continue;
    const double radius = beside_->radius_mm[i];
    marks.push_back({.contact = moment[i].contact,
                     .radius_mm = radius <= 0.0 ? kDrawnPointMm : radius,
                     .colour = i == 0 ? view::kLeftFinger : view::kRightFinger,
                     .haptic_radius_mm = radius,
                     .left = i == 0});
  }
  return marks;
}

/// None while the past is looked at: they are where the fingers are now.
std::vector<view::Lines> Viewer::rings() const {
  if (session_.ruler.active) return rulerLines(session_.ruler);
  if (session_.editor.active) return dysfunctionRings(session_, pointer_, *world_);
  std::vector<view::Lines> marks;
  if (!session_.replay.frozen) marks = fingerRings(session_, pointer_);
  if (session_.reading && session_.vertex_panel_open && session_.mark_vertex) {
    marks.push_back(vertexMark(*session_.reading, *world_, model_->surface()));
  }
  addReach(marks);
  return marks;
}

/// The twelve edges of what each device that holds a finger reaches, where the clutch has moved it.
void Viewer::addReach(std::vector<view::Lines>& lines) const {
  constexpr double kReachPx = 1.6;
  for (std::size_t i = 0; i < kFingers && session_.state.shown.reach; ++i) {
    const FingerHeld& held = session_.devices.fingers[i];
    device::DeviceFrame frame = held.workspace.frame;
    frame.origin_mm += held.reading.shift_mm;
    const std::vector<Vec3> corners = device::reachOf(held.able, frame);
    view::Lines edges{kReachPx, {}};
    for (std::size_t from = 0; from < corners.size(); ++from) {
      for (const std::size_t axis : {1u, 2u, 4u}) {
        if ((from & axis) == 0) edges.add(corners[from], corners[from | axis], kFingerPaint[i]);
      }
    }
    if (!corners.empty()) lines.push_back(std::move(edges));
  }
}

view::PictureSettings Viewer::pictureSettings() const {
  view::PictureSettings picture;
  picture.camera = session_.camera;
  picture.look = session_.state.look;
  if (session_.simple_shading) picture.look.shading = view::Shading::gouraud;
  picture.look.light_background = session_.state.theme == window::Theme::light;
  picture.stereo = stereo_;
  picture.labels.numbers = session_.state.shown.numbers;
  if (training_) training_->plain(picture);
  return picture;
}

/// Body, fingers and overlays alone, by one eye: drawn on white and on black.
void Viewer::paintClear(double scale) {
  view::PictureSettings picture = pictureSettings();
  picture.look.shading = session_.state.look.shading;
  picture.stereo.mode = view::StereoMode::mono;
  picture.labels = view::LabelSettings::none();
  const std::vector<view::FingerMark> fingers = fingerMarks();
  const auto drawn = [&](double background) {
    picture.look.plain_background = background;
    view::Target target(kClearSupersampling * target_->width(), kClearSupersampling * target_->height());
    view::Canvas canvas;
    canvas.framebuffer = target.framebuffer();
    canvas.width = target.width();
    canvas.height = target.height();
    canvas.pixels_per_point = kClearSupersampling * scale;
    canvas.supersampling = kClearSupersampling;
    model_->painter().paint({.fingers = fingers, .time_s = session_.now_s, .lift_mm = model_->lift()},
                            model_->surface(), picture, canvas);
    return view::reduced(target.read(), kClearSupersampling);
  };
  try {
    outputs_.saveClearPicture(session_, view::cutOut(drawn(1.0), drawn(0.0)));
  } catch (const std::exception& error) {
    session_.report(Severity::error, error.what());
  }
}

/// Pictures are kept without what lies over them for a moment, unless that was asked for too.
void Viewer::paintAndKeep(double scale) {
  const bool twice = outputs_.wantsNoPopUps(session_) && gui_.leavesOut(staysInPictures);
  paint(scale, twice ? staysInPictures : nullptr);
  outputs_.frameDrawn(session_, [this] { return target_->read(); });
  if (const auto picture = outputs_.takeSavedPicture(); !picture.empty()) keeper_.attachPicture(picture);
  if (twice) paint(scale);
}

/// One of two bodies, by one eye, in the middle of its half and so far away that what is as wide as high has room.
void Viewer::paintHalf(LiveModel& model, std::span<const view::FingerMark> fingers, double scale) {
  view::PictureSettings picture = pictureSettings();
  picture.stereo.mode = view::StereoMode::mono;
  picture.camera = cameraOfFreePart(picture.camera, session_.state.shown, session_.size_points);
  picture.camera.distance_mm *= std::max(1.0, static_cast<double>(half_->height()) / half_->width());
  view::Canvas canvas;
  canvas.framebuffer = half_->framebuffer();
  canvas.width = half_->width();
  canvas.height = half_->height();
  canvas.pixels_per_point = scale;
  model.painter().paint({.fingers = fingers, .time_s = session_.now_s, .lift_mm = model.lift()}, model.surface(),
                        picture, canvas);
}

/// Each in a half of what the panels leave free.
void Viewer::paintBeside(double scale, window::Gui::Choice windows) {
  const auto shown_width = static_cast<float>(session_.size_points.x());
  const FreeArea free = freeArea(session_.state.shown, shown_width, static_cast<float>(session_.size_points.y()));
  const auto pixels = [scale](float points) { return static_cast<int>(scale * static_cast<double>(points)); };
  const int width = std::max(1, pixels(0.5f * (free.right - free.left)) - 1);  // a line between them
  const int height = std::max(1, pixels(free.below - free.top));
  if (!half_ || half_->width() != width || half_->height() != height) {
    half_ = std::make_unique<view::Target>(width, height);
  }
  target_->clear();
  const int below = target_->height() - pixels(free.top) - height;
  paintHalf(*model_, fingerMarks(), scale);
  target_->put(*half_, pixels(free.left), below);
  paintHalf(*beside_model_, marksBeside(), scale);
  target_->put(*half_, pixels(free.right) - width, below);
  target_->bind();
  gui_.present(target_->width(), target_->height(), windows);
}

/// Photographs in place of the body, which is not drawn meanwhile.
void Viewer::paintMeasuring(window::Gui::Choice windows) {
  target_->clear();
  target_->bind();
  gui_.present(target_->width(), target_->height(), windows);
}

void Viewer::paint(double scale, window::Gui::Choice windows) {
  if (session_.measuring.open && stereo_.mode == view::StereoMode::mono) return paintMeasuring(windows);
  if (beside_ && !drawsItself()) return paintBeside(scale, windows);
  const Clock::time_point started = Clock::now();
  const view::PictureSettings picture = pictureSettings();
  view::Canvas canvas;
  canvas.framebuffer = drawsItself() ? 0 : target_->framebuffer();
  canvas.quad_buffer = host_.quad_buffer;
  canvas.width = target_->width();
  canvas.height = target_->height();
  canvas.pixels_per_point = scale;
  const auto width = static_cast<float>(session_.size_points.x());
  const auto height = static_cast<float>(session_.size_points.y());
  const FreeArea free = freeArea(session_.state.shown, width, height);
  canvas.covered = {free.left, free.top, width - free.right, height - free.below};
  const auto over = [this, windows](const view::EyePicture& eye) { gui_.present(eye.width, eye.height, windows); };
  const std::vector<view::FingerMark> fingers = fingerMarks();
  const std::vector<view::Lines> shown_rings = rings();
  model_->painter().paint(
      {.fingers = fingers, .time_s = session_.now_s, .lift_mm = model_->lift(), .marks = shown_rings},
      model_->surface(), picture, canvas, over);
  session_.performance.draw_ms = millisecondsSince(started);
}

}  // namespace palpate::viewer
