#include "view/viewer/world/world_swap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/language.h"
#include "palpate/base/path_text.h"
#include "palpate/base/text.h"
#include "palpate/device/device_profile.h"
#include "palpate/scene/scene_file.h"
#include "palpate/servo/device_limits.h"
#include "palpate/view/layers/skin_picture.h"
#include "view/viewer/state/state_file.h"

namespace palpate::viewer {

namespace {

/// Without `why` it is the beginning of all such messages.
std::string cannotOpen(const std::string& why = {}) { return trf("cannot open {}", why); }

/// A broken picture must not reach the display.
void decodePicture(const scene::World& world) {
  if (world.body->texture && !world.body->texture->made) view::decodedPicture(*world.body->texture);
}

void reportRateMismatch(ViewerState& viewer) {
  if (std::abs(viewer.scene.ticks_per_s - viewer.ticks_per_s) < 0.5) return;
  viewer.report(Severity::info,
                trf("Touch runs at {:.0f} ticks per second since this window opened; the scene asks for {:.0f}",
                    viewer.ticks_per_s, viewer.scene.ticks_per_s));
}

/// Gives panel, plots and banner the servo's limits.
void publishLimits(const engine::ServoPlan& plan, ViewerState& viewer) {
  DevicesShown& shown = viewer.devices;
  const scene::SafetySettings& safety = plan.world->scene.safety;
  viewer.device_limit_n = plan.limiter.force_n;
  shown.stiffness_factor = plan.limiter.stiffness_factor;
  shown.ratios_kept_to_n = plan.limiter.cap_n_per_mm > 0.0 ? plan.limiter.compared_n : 0.0;
  shown.unsafe = safety.unsafe_stiffness;
  std::vector<std::string> notes;
  if (!viewer.held.empty()) {
    notes = servo::safetyNotes(safety, device::profileOf(viewer.scene.safety.device, viewer.held),
                               1.0 / viewer.ticks_per_s);
  }
  for (const std::string& note : notes) {
    if (std::ranges::find(shown.safety_notes, note) == shown.safety_notes.end()) {
      viewer.messages.note(note, viewer.now_s);
    }
  }
  shown.safety_notes = std::move(notes);
}

}  // namespace

OpenedScene sceneFromFile(const std::string& file, const scene::Scene& like) {
  const std::filesystem::path path(pathOf(file));
  const std::string kind = inSmallLetters(path.extension().string());
  if (kind == ".toml") {
    // Before it is read: a write in between then leads to a question, not to a loss.
    SceneDocument document = loadDocument(path);
    return {scene::load(path), std::move(document)};
  }
  scene::Scene scene = like;
  scene.title = path.filename().string();
  scene.file.clear();
  // They belong to the body they were placed on.
  scene.dysfunctions.clear();
  scene.lumps.clear();
  scene.fingers.clear();
  for (scene::DeviceSettings& device : scene.devices) device.origin_mm.reset();
  scene.view = {};  // the view stays (ViewerState::state)
  scene.ellipses.key_points.clear();
  scene.body = {};
  scene.body.kind = scene::BodyKind::mesh;
  scene.body.file = path;
  scene.safety.unsafe_stiffness = false;  // the consent was for another body
  return {std::move(scene), {}};
}

WorldSwap::WorldSwap(std::shared_ptr<const scene::World> world) : builder_(decodePicture), shown_(std::move(world)) {}

void WorldSwap::open(const std::string& file, ViewerState& viewer, scene::Unit unit) {
  opening_ = file;
  viewer.opening = true;
  wanted_ = 0;
  body_requested_ = true;
  opening_document_ = std::make_shared<SceneDocument>();
  const auto read = [file, unit, like = viewer.scene, document = opening_document_] {
    OpenedScene opened = sceneFromFile(file, like);
    if (opened.document.file.empty()) opened.scene.body.unit = unit;
    *document = std::move(opened.document);
    return std::move(opened.scene);
  };
  builder_.request({.scene = {}, .body = nullptr, .read = read});
}

void WorldSwap::open(const scene::Scene& scene, ViewerState& viewer) {
  viewer.scene = scene;
  viewer.document = {};
  viewer.opening = true;
  viewer.editor = {};
  viewer.lump_editor = {};
  opening_.clear();
  wanted_ = 0;
  body_requested_ = true;
  builder_.request({.scene = scene, .body = nullptr, .read = {}});
}

void WorldSwap::showTemporarily(const scene::Scene& scene, ViewerState& viewer) {
  viewer.scene = scene;
  failure_.clear();
  wanted_ = 0;
  builder_.request({.scene = scene, .body = coming_ ? coming_ : shown_, .read = {}});
}

void WorldSwap::cancel(ViewerState& viewer) {
  builder_.cancel();
  wanted_ = 0;
  body_requested_ = false;
  opening_.clear();
  viewer.opening = false;
  // The present body is requested again.
  viewer.scene.body = shown_->scene.body;
  viewer.report(Severity::info, "Cancelled: the body stays as it was");
}

void WorldSwap::advance(ViewerState& viewer, engine::ServoThread& servo) {
  if (viewer.output.changed & kFingerChange) changeFingers(viewer, servo);
  if (const std::uint32_t world = viewer.output.changed & (kMapChange | kBodyChange)) {
    wanted_ |= world;
    wanted_since_s_ = viewer.now_s;
  }
  requestWhenQuiet(viewer);
  handleBuildResult(viewer, servo);
  viewer.building = builder_.progress();
}

void WorldSwap::requestWhenQuiet(ViewerState& viewer) {
  if (wanted_ == 0 || !opening_.empty() || viewer.now_s - wanted_since_s_ < kQuietS) return;
  engine::BuildRequest request{.scene = viewer.scene, .body = nullptr, .read = {}};
  body_requested_ = body_requested_ || (wanted_ & kBodyChange);
  if (!body_requested_) request.body = coming_ ? coming_ : shown_;
  wanted_ = 0;
  builder_.request(std::move(request));
}

void WorldSwap::handleBuildResult(ViewerState& viewer, engine::ServoThread& servo) {
  const auto result = builder_.collectResult();
  if (!result) return;
  const std::string opened = std::exchange(opening_, {});
  body_requested_ =
      body_requested_ && !result->world && opened.empty();  // a failed one is tried again with the next request
  if (!result->world) {
    viewer.opening = false;
    failure_ = result->error;
    viewer.report(Severity::error, opened.empty() ? result->error : cannotOpen(result->error));
    return;
  }
  if (!opened.empty()) {
    viewer.messages.clearErrors(cannotOpen());
    remember(viewer.state.recent, opened);
    viewer.scene = result->world->scene;
    viewer.document = *opening_document_;
    viewer.editor = {};
    viewer.lump_editor = {};
    reportRateMismatch(viewer);
  }
  adopt(viewer, *result, servo);
}

void WorldSwap::adopt(ViewerState& viewer, const engine::BuildResult& result, engine::ServoThread& servo) {
  // To the fingers a swelling over a lump makes another body, to the eye the same.
  const bool other_body = result.request.body == nullptr || result.world->body != shown_->body;
  try {
    engine::ServoPlan plan = planFor(result.world, viewer.scene, other_body, viewer.held, 1.0 / viewer.ticks_per_s);
    publishLimits(plan, viewer);
    servo.change(std::move(plan));
  } catch (const Error& error) {
    failure_ = error.what();
    viewer.report(Severity::error, error.what());
    return;
  }
  coming_ = result.world;
  other_body_ = other_body_ || result.request.body == nullptr;
}

engine::ServoPlan WorldSwap::makePlan(ViewerState& viewer) const {
  const bool other_body = coming_ && (other_body_ || coming_->body != shown_->body);
  engine::ServoPlan plan =
      planFor(coming_ ? coming_ : shown_, viewer.scene, other_body, viewer.held, 1.0 / viewer.ticks_per_s);
  publishLimits(plan, viewer);
  return plan;
}

void WorldSwap::changeFingers(ViewerState& viewer, engine::ServoThread& servo) const {
  try {
    servo.change(makePlan(viewer));
  } catch (const Error& error) {
    viewer.report(Severity::warning, error.what());
  }
}

WorldSwap::Shown WorldSwap::popShown(engine::ServoThread& servo) {
  servo.exchange();
  if (!coming_ || servo.world() != coming_) return {};
  shown_ = std::exchange(coming_, nullptr);
  return {shown_, std::exchange(other_body_, false)};
}

}  // namespace palpate::viewer
