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
      devices_(servo_, world_swap_),
      keeper_(servo_, settings_.recording_folder),
      replay_(servo_.thread().ticksPerS()),
      outputs_(settings_.output_folder),
      modes_(std::move(settings_.modes)),
      camera_(viewer_, pointer_, modes_, world_),
      class_run_(host_.teach_program),
      requests_({viewer_, world_swap_, devices_, keeper_, outputs_, replay_, camera_, class_run_, modes_, host_,
                 settings_.default_scene, world_}),
      eyesight_(host_.quad_buffer) {
  viewer_.state = std::move(state);
  viewer_.scene = world->scene;
  viewer_.document = settings_.document;
  viewer_.output_folder = outputs_.folder();
  updateFacts();
  viewer_.profile.knots = world->deformation.normal_profile.knots;
  viewer_.held = servo_.abilities();
  if (host_.activities) viewer_.activities = host_.activities();
  viewer_.class_shown.offered = class_run_.offered();
  viewer_.ticks_per_s = servo_.thread().ticksPerS();
  world_swap_.makePlan(viewer_);  // gives the viewer's state the limits
  for (SampleHistory& plot : viewer_.plots.fingers) plot = SampleHistory(viewer_.ticks_per_s);
  input_.settings = viewer_.state.input;
  viewer_.performance.graphics = view::rendererString();
  devices_.begin(viewer_);
  for (const auto& mode : modes_) mode->begin(viewer_, *world, gui_);
}

Viewer::~Viewer() = default;

void Viewer::updateFacts() {
  const bool other_file = viewer_.world.channels != world_->body->channels;
  viewer_.world = collectWorldFacts(*world_);
  if (!other_file) return;
  const std::string words = adoptChannels(*world_, viewer_.state.look);
  if (!words.empty()) viewer_.report(Severity::info, words);
}

servo::LoopReport Viewer::finish(std::string_view ended_by) {
  servo::LoopReport report = servo_.thread().stop();
  processSamples();
  for (const auto& mode : modes_) {
    if (const std::string words = mode->finish(ended_by); !words.empty()) viewer_.report(Severity::error, words);
  }
  keeper_.finish(viewer_, ended_by);
  outputs_.finish(viewer_);
  return report;
}

void Viewer::frame(int width, int height, double scale, double now_s, std::span<const window::InputEvent> events) {
  const Clock::time_point started = Clock::now();
  const bool first = !seen_;
  const double elapsed_s = first ? 1.0 / 60.0 : std::max(1e-4, now_s - viewer_.now_s);
  viewer_.now_s = now_s;
  makeTarget(width, height);
  adoptWorld();
  replay_.collectResult(world_, *model_, viewer_);
  followServo(elapsed_s);
  const double points = scale * viewer_.state.text_size;
  if (std::exchange(theme_, viewer_.state.theme) != viewer_.state.theme) gui_.setTheme(viewer_.state.theme);
  stereo_ = eyesight_.settings(viewer_);
  const view::EyePicture eye = view::eyePictureIn(stereo_.mode, width, height);
  viewer_.size_points = Vec2(eye.seen_width, eye.seen_height) / points;
  drawGuiPasses(mapEventsToEye(events, stereo_.mode, width, height), points, elapsed_s);
  const UiOutput& output = viewer_.output;
  const bool held = ImGui::IsAnyItemActive();
  const bool any = held || !events.empty() || output.changed != kNothing || !output.requests.empty();
  useChanges(elapsed_s);
  if (!viewer_.opening && !modes_.claims().window) viewer_.history.follow(viewer_, {held, viewer_.editingNow(), any});
  updateTitle();
  pointServo();
  paintAndKeep(points);
  Performance& performance = viewer_.performance;
  performance.frame_ms = millisecondsSince(started);
  frame_s_ += kRateSmoothing * (elapsed_s - frame_s_);
  performance.frames_per_s = 1.0 / frame_s_;
  guardShading(shading_guard_, viewer_, elapsed_s, !first && !modes_.claims().body);
}

void Viewer::makeTarget(int width, int height) {
  if (target_ && target_->width() == width && target_->height() == height) return;
  target_ = std::make_unique<view::Target>(std::max(1, width), std::max(1, height));
}

/// Maps the cursor's pixels in this frame; places the camera the first time.
void Viewer::lookAround() {
  if (!std::exchange(seen_, true)) {
    // A mode's column exists in any window: the body keeps to the rest.
    if (!modes_.claims().window && viewer_.size_points.x() < kNarrowPoints) viewer_.state.shown.panel = false;
    viewer_.camera = homeView(*world_, viewer_.state.shown, view::StandardView::back, viewer_.size_points);
    applySceneLook(*world_, viewer_, viewer_.size_points);
    beginScene();
    if (modes_.homeBox()) camera_.setView(view::StandardView::back);
    if (settings_.intro && !viewer_.state.reduced_motion) intro_.begin(*world_, viewer_.now_s);
  }
  const view::EyePicture eye = view::eyePictureIn(stereo_.mode, target_->width(), target_->height());
  eyes_ = view::placeEyes(viewer_.camera, stereo_, eye.aspect());
  pointer_.look({eyes_.screen, eyes_.middle, Vec2(target_->width(), target_->height()), stereo_.mode}, world_);
  const Sight sight{frustum(), viewer_.size_points, target_->width() / viewer_.size_points.x(), pointer_};
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
  const bool other_scene = std::exchange(viewer_.opening, false);
  world_ = shown.world;
  model_->setWorld(world_);
  for (const auto& mode : modes_) mode->handleNewWorld(*world_);
  updateFacts();
  if (viewer_.profile.handle < 0) viewer_.profile.knots = world_->deformation.normal_profile.knots;
  if (!shown.other_body) return;
  devices_.bodyChanged();
  viewer_.reading.reset();
  replay_.clear();
  freeze(viewer_.replay, false);
  pointer_.reset();
  std::vector<window::Command> lifted;
  input_.handle({.kind = window::InputEvent::Kind::focus}, {}, lifted);
  if (!seen_) return;
  viewer_.ruler = {};
  view::Camera camera = homeView(*world_, viewer_.state.shown, view::StandardView::back, viewer_.size_points);
  if (other_scene) {
    const view::Camera before = viewer_.camera;
    if (applySceneLook(*world_, viewer_, viewer_.size_points)) camera = std::exchange(viewer_.camera, before);
    beginScene();
  }
  camera_.showBody(camera);
}

/// Starts without changes. A scene without a file is saved as seen, habits included.
void Viewer::beginScene() {
  const bool of_file = !viewer_.document.file.empty();
  viewer_.opened = {.look = of_file ? viewer_.state.look : view::Look{},
                    .stereo = of_file ? viewer_.state.stereo : view::StereoSettings{}};
  viewer_.history.begin(viewer_);
}

void Viewer::followServo(double elapsed_s) {
  processSamples();
  Performance& performance = viewer_.performance;
  performance.servo = servo_.thread().vitals();
  performance.dropped_samples = servo_.thread().droppedSamples();
  const TouchHistory::Moment* past = replay_.advance(world_, *model_, viewer_, elapsed_s);
  past != nullptr ? show(*past) : show(servo_.thread().contacts());
}

void Viewer::show(std::span<const trace::Sample> contacts) {
  for (std::size_t i = 0; i < kFingers; ++i) viewer_.fingers[i] = contacts[i].contact;
  const LiveModel::Times times = model_->follow(contacts);
  viewer_.performance.deform_ms = times.deform_ms;
  viewer_.performance.upload_ms = times.upload_ms;
}

void Viewer::processSamples() {
  trace::Sample sample;
  while (servo_.thread().pop(sample)) {
    outputs_.addSample(viewer_, sample);
    devices_.felt(sample, viewer_);
    for (const auto& mode : modes_) mode->feel(sample);
    if (viewer_.replay.frozen) continue;  // a frozen moment stays
    viewer_.plot(sample);
    replay_.add(sample);
  }
}

/// Next to its second end, as seen from between the eyes.
void Viewer::placeRulerLabel() {
  Ruler& ruler = viewer_.ruler;
  if (ruler.ends.size() < 2) return;
  const Vec2 seen = view::seenAt(frustum(), ruler.ends[1].point);
  ruler.label = seen.allFinite() ? Vec2(seen.cwiseProduct(viewer_.size_points)) : Vec2(0.5 * viewer_.size_points);
}

void Viewer::updateTitle() {
  std::string title = titleOf(viewer_);
  if (!host_.set_title || title == title_ || modes_.claims().window) return;
  title_ = std::move(title);
  host_.set_title(title_);
}

void Viewer::useChanges(double elapsed_s) {
  for (const Request& request : std::exchange(viewer_.output.requests, {})) requests_.handle(request);
  requests_.advance();
  devices_.advance(viewer_, *world_);
  keeper_.advance(viewer_);
  class_run_.advance(viewer_.now_s, viewer_.class_shown);
  if (viewer_.state.shown.start && host_.activities) viewer_.activities = host_.activities();
  for (const auto& mode : modes_) {
    mode->advance({viewer_, servo_, world_swap_, *world_, elapsed_s});
    quit_ = quit_ || mode->wantsToQuit();
  }
  quit_ = quit_ || requests_.quits();
  world_swap_.advance(viewer_, servo_.thread());
  if (const auto reading = replay_.progress()) viewer_.building = reading;
  viewer_.output.changed = kNothing;
}

void Viewer::pointServo() {
  const RecordedTouch* recorded = replay_.recorded();
  for (std::size_t i = 0; i < kFingers; ++i) {
    const device::FingerTarget target = pointer_.target(i, viewer_);
    viewer_.finger_present[i] =
        recorded != nullptr ? i < recorded->radius_mm.size() : target.present || servo_.isHeld(i);
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
                         gui_,    *target_, stereo_, host_.quad_buffer, scale,   outputs_.wantsFrame(viewer_)};
  const bool twice = outputs_.wantsNoPopUps(viewer_) && gui_.leavesOut(staysInPictures);
  painter_.paint(parts, twice ? staysInPictures : nullptr);
  outputs_.frameDrawn(viewer_, [this] { return target_->read(); });
  if (const auto picture = outputs_.popSavedPicture(); !picture.empty()) keeper_.attachPicture(picture);
  if (twice) painter_.paint(parts);
  if (!outputs_.popClearPictureRequest()) return;
  try {
    outputs_.saveClearPicture(viewer_, painter_.paintClear(parts));
  } catch (const std::exception& error) {
    viewer_.report(Severity::error, error.what());
  }
}

}  // namespace palpate::viewer
