#include "apps/viewer/viewer.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "apps/viewer/editing/acts.h"
#include "apps/viewer/editing/dysfunction_editor.h"
#include "apps/viewer/editing/rings.h"
#include "apps/viewer/files/view_text.h"
#include "apps/viewer/home_view.h"
#include "apps/viewer/panels/gui_layout.h"
#include "apps/viewer/panels/hints.h"
#include "palpate/base/stopwatch.h"
#include "palpate/trace/forces_table.h"

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
          .channels = world.channels};
}

}  // namespace

Viewer::Viewer(const std::shared_ptr<const scene::World>& world, ViewState state, ViewerSettings settings,
               ViewerHost host)
    : settings_(std::move(settings)),
      host_(std::move(host)),
      world_(world),
      servo_(planFor(world, world->scene, true)),
      model_(std::make_unique<LiveModel>(world)),
      turnover_(world),
      history_(servo_.thread().ticksPerS()),
      outputs_(settings_.output_folder),
      eyesight_(host_.quad_buffer) {
  session_.state = std::move(state);
  session_.scene = world->scene;
  session_.scene_file = world->scene.file.string();
  takeFacts();
  session_.device_limit_n = world->scene.safety.nominal_force_n;
  session_.profile.knots = world->deformation.normal_profile.knots;
  session_.ticks_per_s = servo_.thread().ticksPerS();
  for (SampleHistory& plot : session_.plots.fingers) plot = SampleHistory(session_.ticks_per_s);
  input_.settings = session_.state.input;
  session_.performance.graphics = view::rendererWords();
}

Viewer::~Viewer() = default;

void Viewer::takeFacts() {
  const bool other_file = session_.world.channels != world_->channels;
  session_.world = factsOf(*world_);
  if (!other_file) return;
  const std::string words = useChannelsOf(*world_, session_.state.look);
  if (!words.empty()) session_.report(Severity::info, words);
}

servo::LoopReport Viewer::finish() {
  servo::LoopReport report = servo_.thread().stop();
  takeSamples();
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
  size_points_ = Vec2(eye.seen_width, eye.seen_height) / points;
  gui_.begin(size_points_, points, elapsed_s, asOneEyeSees(events, stereo_.mode, width, height));
  showCursor();
  lookAround();
  handle(events);
  intro_.advance(pointer_, *world_, now_s);
  pointer_.advance(session_);
  drawGui(session_);
  gui_.end();
  useChanges();
  pointServo();
  paintAndKeep(points);
  Performance& performance = session_.performance;
  performance.frame_ms = millisecondsSince(started);
  frame_s_ += kRateSmoothing * (elapsed_s - frame_s_);
  performance.frames_per_s = 1.0 / frame_s_;
  guardShading(elapsed_s);
  seen_ = true;
}

void Viewer::makeTarget(int width, int height) {
  if (target_ && target_->width() == width && target_->height() == height) return;
  target_ = std::make_unique<view::Target>(std::max(1, width), std::max(1, height));
}

/// What the cursor's pixels mean in this frame; the first time also where the camera stands.
void Viewer::lookAround() {
  if (!seen_) {
    if (size_points_.x() < kNarrowPoints) session_.state.shown.panel = false;
    session_.camera = homeView(*world_, session_.state.shown, view::StandardView::back, size_points_);
    takeSceneLook(*world_, session_, size_points_);
    if (settings_.intro && !session_.state.reduced_motion) intro_.begin(*world_, session_.now_s);
  }
  const view::EyePicture eye = view::eyePictureIn(stereo_.mode, target_->width(), target_->height());
  eyes_ = view::eyesOf(session_.camera, stereo_, eye.aspect());
  pointer_.look({eyes_.screen, eyes_.middle, Vec2(target_->width(), target_->height()), stereo_.mode}, world_);
}

void Viewer::takeWorld() {
  const Turnover::Shown shown = turnover_.takeShown(servo_.thread());
  if (!shown.world) return;
  const bool other_scene = shown.world->scene.file != world_->scene.file;
  world_ = shown.world;
  model_->setWorld(world_);
  takeFacts();
  session_.device_limit_n = session_.scene.safety.nominal_force_n;
  if (session_.profile.handle < 0) session_.profile.knots = world_->deformation.normal_profile.knots;
  if (!shown.other_body) return;
  session_.reading.reset();
  history_.clear();
  freeze(session_.replay, false);
  pointer_.reset();
  std::vector<window::Command> lifted;
  input_.handle({.kind = window::InputEvent::Kind::focus}, {}, lifted);
  if (!seen_) return;
  const view::Camera before = session_.camera;
  if (!other_scene || !takeSceneLook(*world_, session_, size_points_)) {
    return setView(view::StandardView::back);
  }
  pointer_.fly(std::exchange(session_.camera, before), session_, kFlightS);
}

void Viewer::followServo(double elapsed_s) {
  takeSamples();
  Performance& performance = session_.performance;
  performance.servo = servo_.thread().vitals();
  performance.dropped_samples = servo_.thread().droppedSamples();
  if (!session_.replay.frozen && recorded_) leaveReplay();
  advanceReplay(session_.replay, history(), elapsed_s);
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
  recorded_ = std::move(result->touch);
  const TouchHistory& history = recorded_->history;
  for (SampleHistory& plot : session_.plots.fingers) plot = SampleHistory(recorded_->ticks_per_s, kLongestReplayS);
  history.forEach([this](const trace::Sample& sample) { plot(sample); });
  session_.replay = {.at_s = history.oldestTime(),
                     .from_s = history.oldestTime(),
                     .to_s = history.newestTime(),
                     .table = recorded_->file,
                     .tick_s = history.tick(),
                     .frozen = true};
  session_.plots.paused = false;
  if (trace::isUnfinished(recorded_->file)) {
    session_.report(Severity::warning,
                    fmt::format("{} was not finished: its {:.1f} s are what was written before the end",
                                recorded_->file, session_.replay.to_s - session_.replay.from_s));
  }
}

void Viewer::replay(const std::string& table) {
  if (!replay_loader_.load(world_, session_.scene, table)) {
    session_.report(Severity::info, "Another table is still being read");
  }
}

void Viewer::leaveReplay() {
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
    if (session_.replay.frozen) continue;  // what is studied stays as it is
    plot(sample);
    history_.add(sample);
  }
}

void Viewer::handle(std::span<const window::InputEvent> events) {
  input_.settings = session_.state.input;
  std::vector<window::Command> commands;
  for (const window::InputEvent& event : events) {
    using EventKind = window::InputEvent::Kind;
    if (event.kind == EventKind::drop) session_.wish(Wish::Kind::open, event.text);
    if (event.kind == EventKind::move || event.kind == EventKind::button) intro_.end(pointer_);
    window::Situation situation;
    situation.over_gui = gui_.wantsMouse();
    situation.gui_wants_text = gui_.wantsText();
    situation.editing = session_.editor.active;
    situation.on_skin = event.kind == EventKind::button && pointer_.skinAt(event.at).has_value();
    commands.clear();
    input_.handle(event, situation, commands);
    for (const window::Command& command : commands) obey(command);
  }
}

void Viewer::obey(const window::Command& command) {
  countHint(command, session_.hint, session_.state.hints);
  if (command.kind == Kind::act) return actOn(command);
  // With nothing selected the wheel has nothing to size, so it zooms.
  if (command.kind == Kind::edit_size && session_.editor.selected < 0) {
    window::Command zoom = command;
    zoom.kind = Kind::zoom;
    pointer_.apply(zoom, session_);
    return;
  }
  if (command.kind == Kind::press) {
    if (const auto place = pointer_.skinAt(command.at)) session_.reading = readVertex(*world_, place->point);
  }
  if (pointer_.apply(command, session_)) return;
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
        pointer_.fly(view::centredOn(session_.camera, place->point), session_, kFlightS);
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
  pointer_.fly(homeView(*world_, session_.state.shown, side, size_points_), session_, kFlightS);
}

void Viewer::useChanges() {
  for (const Wish& wish : std::exchange(session_.asks.wishes, {})) grant(wish);
  turnover_.advance(session_, servo_.thread());
  session_.asks.changed = kNothing;
}

void Viewer::grant(const Wish& wish) {
  switch (wish.kind) {
    case Wish::Kind::open:
      if (trace::isForcesTable(wish.file)) return replay(wish.file);
      return turnover_.open(wish.file, session_);
    case Wish::Kind::default_scene:
      return turnover_.open(settings_.default_scene, session_);
    case Wish::Kind::cancel_build:
      return turnover_.cancel(session_);
    case Wish::Kind::save:
      return outputs_.saveScene(session_, wish.file);
    case Wish::Kind::screenshot:
      return outputs_.askForScreenshot();
    case Wish::Kind::screenshot_with_pop_ups:
      return outputs_.askForScreenshot(true);
    case Wish::Kind::plots_csv:
      return outputs_.savePlots(session_);
    case Wish::Kind::record:
      return outputs_.toggleForces(session_);
    case Wish::Kind::sequence:
      return outputs_.toggleSequence(session_);
    case Wish::Kind::use_profile:
      return outputs_.useProfile(session_);
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
        pointer_.fly(*camera, session_, kFlightS);
      } else {
        session_.report(Severity::warning, "The clipboard holds no view");
      }
      return;
    case Wish::Kind::quit:
      quit_ = true;
      return;
  }
}

void Viewer::pointServo() {
  for (std::size_t i = 0; i < kFingers; ++i) {
    const device::FingerTarget target = pointer_.target(i, session_);
    session_.finger_present[i] = target.present;
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
    const bool counts = seen_ && !session_.building && !session_.recording.sequence;
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
    const double radius = fingerRadius(session_.scene, i);
    const bool left = i == 0;
    const double outline = i == session_.active_finger ? 0.0 : kOutline;
    marks.push_back({.contact = session_.fingers[i],
                     .radius_mm = radius,
                     .colour = left ? view::kLeftFinger : view::kRightFinger,
                     .haptic_radius_mm = radius,
                     .left = left,
                     .outline = outline,
                     .lifted = peaks_[i].shown(session_.now_s)});
  }
  return marks;
}

/// None while the past is looked at: they are where the fingers are now.
std::vector<view::Lines> Viewer::rings() const {
  if (session_.editor.active) return dysfunctionRings(session_, pointer_, *world_);
  std::vector<view::Lines> marks;
  if (!session_.replay.frozen) marks = fingerRings(session_, pointer_);
  if (session_.reading && session_.vertex_panel_open && session_.mark_vertex) {
    marks.push_back(vertexMark(*session_.reading, *world_, model_->surface()));
  }
  return marks;
}

/// Pictures are kept without what lies over them for a moment, unless that was asked for too.
void Viewer::paintAndKeep(double scale) {
  const bool twice = outputs_.wantsNoPopUps(session_) && gui_.leavesOut(staysInPictures);
  paint(scale, twice ? staysInPictures : nullptr);
  outputs_.frameDrawn(session_, [this] { return target_->read(); });
  if (twice) paint(scale);
}

void Viewer::paint(double scale, window::Gui::Choice windows) {
  const Clock::time_point started = Clock::now();
  view::PictureSettings picture;
  picture.camera = session_.camera;
  picture.look = session_.state.look;
  if (session_.simple_shading) picture.look.shading = view::Shading::gouraud;
  picture.look.light_background = session_.state.theme == window::Theme::light;
  picture.stereo = stereo_;
  picture.labels.numbers = session_.state.shown.numbers;
  view::Canvas canvas;
  canvas.framebuffer = drawsItself() ? 0 : target_->framebuffer();
  canvas.quad_buffer = host_.quad_buffer;
  canvas.width = target_->width();
  canvas.height = target_->height();
  canvas.pixels_per_point = scale;
  const auto width = static_cast<float>(size_points_.x());
  const auto height = static_cast<float>(size_points_.y());
  const FreeArea free = freeArea(session_.state.shown, width, height);
  canvas.covered = {free.left, free.top, width - free.right, height - free.below};
  const auto over = [this, windows](const view::EyePicture& eye) { gui_.present(eye.width, eye.height, windows); };
  const std::vector<view::FingerMark> fingers = fingerMarks();
  const std::vector<view::Lines> shown_rings = rings();
  model_->painter().paint({fingers, session_.now_s, shown_rings}, model_->surface(), picture, canvas, over);
  session_.performance.draw_ms = millisecondsSince(started);
}

}  // namespace palpate::viewer
