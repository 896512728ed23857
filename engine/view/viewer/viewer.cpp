#include "view/viewer/viewer.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/stopwatch.h"
#include "view/viewer/panels/gui_layout.h"
#include "view/viewer/panels/hints.h"
#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/widgets.h"
#include "view/viewer/request_handler.h"
#include "view/viewer/state/home_view.h"

namespace palpate::viewer {

namespace {

/// The displayed frame rate is the mean of about this many frames.
constexpr double kRateSmoothing = 0.05;
/// Narrower windows start without the side panel.
constexpr double kNarrowPoints = 1000.0;

}  // namespace

Viewer::Viewer(const std::shared_ptr<const scene::World>& world, ViewState state, ViewerSettings settings,
               ViewerHost host)
    : settings_(std::move(settings)),
      host_(std::move(host)),
      world_(world),
      servo_(planFor(world, world->scene, true, scaledCapabilities(settings_.devices)), settings_.devices),
      model_(std::make_unique<LiveModel>(world)),
      world_swap_(world),
      devices_(servo_, world_swap_, edited_.scene, holders_, user_),
      keeper_(servo_, settings_.recording_folder, user_),
      replay_(servo_.thread().ticksPerS(), past_, user_),
      outputs_(settings_.output_folder, user_),
      modes_(std::move(settings_.modes)),
      camera_(seen_, user_.now_s, pointer_, modes_, world_),
      class_run_(host_.class_program),
      requests_({viewer_, world_swap_, devices_, keeper_, outputs_, replay_, camera_, class_run_, modes_, host_,
                 settings_.default_scene, world_}),
      eyesight_(host_.quad_buffer) {
  seen_.state = std::move(state);
  edited_.scene = world->scene;
  edited_.document = settings_.document;
  user_.output_folder = outputs_.folder();
  updateFacts();
  edited_.profile.knots = world->deformation.normal_profile.knots;
  holders_.held = servo_.abilities();
  if (host_.activities) user_.activities = host_.activities();
  user_.class_shown.offered = class_run_.offered();
  holders_.ticks_per_s = servo_.thread().ticksPerS();
  world_swap_.makePlan(edited_.scene, holders_, user_);  // gives the viewer's state the limits
  for (SampleHistory& plot : past_.plots.fingers) plot = SampleHistory(holders_.ticks_per_s);
  input_.settings = seen_.state.input;
  seen_.performance.graphics = view::rendererString();
  devices_.begin();
  for (const auto& mode : modes_) mode->begin(viewer_, *world, gui_);
}

Viewer::~Viewer() = default;

void Viewer::updateFacts() {
  const bool other_file = edited_.world.channels != world_->body->channels;
  edited_.world = collectWorldFacts(*world_);
  if (!other_file) return;
  const std::string words = adoptChannels(*world_, seen_.state.look);
  if (!words.empty()) user_.report(Severity::info, words);
}

servo::LoopReport Viewer::finish(std::string_view ended_by) {
  servo::LoopReport report = servo_.thread().stop();
  processSamples();
  for (const auto& mode : modes_) {
    if (const std::string words = mode->finish(ended_by); !words.empty()) user_.report(Severity::error, words);
  }
  keeper_.finish(ended_by);
  outputs_.finish();
  return report;
}

void Viewer::frame(int width, int height, double scale, double now_s, std::span<const window::InputEvent> events) {
  const Clock::time_point started = Clock::now();
  const bool first = !looked_;
  const double elapsed_s = first ? 1.0 / 60.0 : std::max(1e-4, now_s - user_.now_s);
  user_.now_s = now_s;
  makeTarget(width, height);
  adoptWorld();
  replay_.collectResult(world_, *model_, holders_.device_limit_n);
  followServo(elapsed_s);
  const double points = scale * seen_.state.text_size;
  if (std::exchange(theme_, seen_.state.theme) != seen_.state.theme) gui_.setTheme(seen_.state.theme);
  stereo_ = eyesight_.settings(seen_, user_);
  const view::EyePicture eye = view::eyePictureIn(stereo_.mode, width, height);
  seen_.size_points = Vec2(eye.seen_width, eye.seen_height) / points;
  drawGuiPasses(mapEventsToEye(events, stereo_.mode, width, height), points, elapsed_s);
  const UiOutput& output = user_.output;
  const bool held = ImGui::IsAnyItemActive();
  const bool any = held || !events.empty() || output.changed != kNothing || !output.requests.empty();
  useChanges(elapsed_s);
  if (!edited_.opening && !modes_.claims().window)
    edited_.history.follow(edited_, seen_, {held, edited_.editingNow(), any}, user_.output);
  updateTitle();
  pointServo();
  paintAndKeep(points);
  Performance& performance = seen_.performance;
  performance.frame_ms = millisecondsSince(started);
  frame_s_ += kRateSmoothing * (elapsed_s - frame_s_);
  performance.frames_per_s = 1.0 / frame_s_;
  const bool counts = !first && !modes_.claims().body && !edited_.building && !user_.recording.sequence;
  guardShading(shading_guard_, seen_, elapsed_s, counts, user_);
}

void Viewer::makeTarget(int width, int height) {
  if (target_ && target_->width() == width && target_->height() == height) return;
  target_ = std::make_unique<view::Target>(std::max(1, width), std::max(1, height));
}

/// Maps the cursor's pixels in this frame; places the camera the first time.
void Viewer::lookAround() {
  if (!std::exchange(looked_, true)) {
    // A mode's column exists in any window: the body keeps to the rest.
    if (!modes_.claims().window && seen_.size_points.x() < kNarrowPoints) seen_.state.shown.panel = false;
    seen_.camera = homeView(*world_, seen_.state.shown, view::StandardView::back, seen_.size_points);
    applySceneLook(*world_, seen_, seen_.size_points);
    beginScene();
    if (modes_.homeBox()) camera_.setView(view::StandardView::back);
    if (settings_.intro && !seen_.state.reduced_motion) intro_.begin(*world_, user_.now_s);
  }
  const view::EyePicture eye = view::eyePictureIn(stereo_.mode, target_->width(), target_->height());
  eyes_ = view::placeEyes(seen_.camera, stereo_, eye.aspect());
  pointer_.look({eyes_.screen, eyes_.middle, Vec2(target_->width(), target_->height()), stereo_.mode}, world_);
  const Sight sight{frustum(), seen_.size_points, target_->width() / seen_.size_points.x(), pointer_};
  for (const auto& mode : modes_) mode->look(sight, viewer_);
}

/// The frustum of the middle of both eyes.
view::Frustum Viewer::frustum() const {
  constexpr double kNearMm = 1.0;
  constexpr double kFarMm = 1e6;
  return view::makeFrustum(eyes_.screen, eyes_.middle, kNearMm, kFarMm);
}

void Viewer::adoptWorld() {
  const WorldSwap::Shown shown = world_swap_.popShown(servo_.thread());
  if (!shown.world) return;
  const bool other_scene = std::exchange(edited_.opening, false);
  world_ = shown.world;
  model_->setWorld(world_);
  for (const auto& mode : modes_) mode->handleNewWorld(*world_);
  updateFacts();
  if (edited_.profile.handle < 0) edited_.profile.knots = world_->deformation.normal_profile.knots;
  if (!shown.other_body) return;
  devices_.bodyChanged();
  seen_.reading.reset();
  replay_.clear();
  freeze(past_.replay, false);
  pointer_.reset();
  std::vector<window::Command> lifted;
  input_.handle({.kind = window::InputEvent::Kind::focus}, {}, lifted);
  if (!looked_) return;
  seen_.ruler = {};
  view::Camera camera = homeView(*world_, seen_.state.shown, view::StandardView::back, seen_.size_points);
  if (other_scene) {
    const view::Camera before = seen_.camera;
    if (applySceneLook(*world_, seen_, seen_.size_points)) camera = std::exchange(seen_.camera, before);
    beginScene();
  }
  camera_.showBody(camera);
}

/// Starts without changes. A scene without a file is saved as seen, habits included.
void Viewer::beginScene() {
  const bool of_file = !edited_.document.file.empty();
  seen_.opened = {.look = of_file ? seen_.state.look : view::Look{},
                  .stereo = of_file ? seen_.state.stereo : view::StereoSettings{}};
  edited_.history.begin(edited_, seen_);
}

void Viewer::followServo(double elapsed_s) {
  processSamples();
  Performance& performance = seen_.performance;
  performance.servo = servo_.thread().vitals();
  performance.dropped_samples = servo_.thread().droppedSamples();
  const TouchHistory::Moment* past = replay_.advance(world_, *model_, elapsed_s);
  past != nullptr ? show(*past) : show(servo_.thread().contacts());
}

void Viewer::show(std::span<const trace::Sample> contacts) {
  for (std::size_t i = 0; i < kFingers; ++i) seen_.fingers[i] = contacts[i].contact;
  const LiveModel::Times times = model_->follow(contacts);
  seen_.performance.deform_ms = times.deform_ms;
  seen_.performance.upload_ms = times.upload_ms;
}

void Viewer::processSamples() {
  trace::Sample sample;
  while (servo_.thread().pop(sample)) {
    outputs_.addSample(sample);
    devices_.noteInterventions(sample);
    for (const auto& mode : modes_) mode->feel(sample);
    if (past_.replay.frozen) continue;  // a frozen moment stays
    past_.plot(sample, holders_.device_limit_n);
    replay_.add(sample);
  }
}

/// Next to its second end, as seen from between the eyes.
void Viewer::placeRulerLabel() {
  Ruler& ruler = seen_.ruler;
  if (ruler.ends.size() < 2) return;
  const Vec2 seen = view::seenAt(frustum(), ruler.ends[1].point);
  ruler.label = seen.allFinite() ? Vec2(seen.cwiseProduct(seen_.size_points)) : Vec2(0.5 * seen_.size_points);
}

void Viewer::updateTitle() {
  std::string title = titleOf(edited_);
  if (!host_.set_title || title == title_ || modes_.claims().window) return;
  title_ = std::move(title);
  host_.set_title(title_);
}

void Viewer::useChanges(double elapsed_s) {
  for (const Request& request : std::exchange(user_.output.requests, {})) requests_.handle(request);
  requests_.advance();
  devices_.advance(seen_.active_finger, *world_);
  keeper_.advance(seen_.state.keeps_last_hour, edited_.scene.title, holders_.devices);
  class_run_.advance(user_.now_s, user_.class_shown);
  if (seen_.state.shown.start && host_.activities) user_.activities = host_.activities();
  for (const auto& mode : modes_) {
    mode->advance({viewer_, servo_, world_swap_, *world_, elapsed_s});
    quit_ = quit_ || mode->wantsToQuit();
  }
  quit_ = quit_ || requests_.quits();
  world_swap_.advance({edited_, holders_, user_, seen_.state.recent, servo_.thread()});
  if (const auto reading = replay_.progress()) edited_.building = reading;
  user_.output.changed = kNothing;
}

void Viewer::pointServo() {
  const RecordedTouch* recorded = replay_.recorded();
  for (std::size_t i = 0; i < kFingers; ++i) {
    const device::FingerTarget target = pointer_.target(i, seen_, edited_.scene);
    seen_.finger_present[i] = recorded != nullptr ? i < recorded->radius_mm.size() : target.present || servo_.isHeld(i);
    servo_.point(i, target);
  }
  pointer_.targetsSent();
}

/// In a picture of two parts the system's pointer would be in one of them: our own is drawn in both.
void Viewer::showCursor() {
  const bool own = view::hasTwoParts(stereo_.mode);
  ImGui::GetIO().MouseDrawCursor = own;
  if (std::exchange(own_cursor_, own) != own && host_.show_cursor) host_.show_cursor(!own);
}

/// Pictures are saved without pop-ups, unless these were requested too.
void Viewer::paintAndKeep(double scale) {
  const FrameParts parts{viewer_, *model_,  *world_, pointer_,          replay_, modes_,
                         gui_,    *target_, stereo_, host_.quad_buffer, scale,   outputs_.wantsFrame()};
  const bool twice = outputs_.wantsNoPopUps() && gui_.leavesOut(staysInPictures);
  painter_.paint(parts, twice ? staysInPictures : nullptr);
  outputs_.frameDrawn([this] { return target_->read(); });
  if (const auto picture = outputs_.popSavedPicture(); !picture.empty()) keeper_.attachPicture(picture);
  if (twice) painter_.paint(parts);
  if (!outputs_.popClearPictureRequest()) return;
  try {
    outputs_.saveClearPicture(painter_.paintClear(parts));
  } catch (const std::exception& error) {
    user_.report(Severity::error, error.what());
  }
}

}  // namespace palpate::viewer
