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

void reportRateMismatch(const scene::Scene& scene, double ticks_per_s, Conversation& user) {
  if (std::abs(scene.ticks_per_s - ticks_per_s) < 0.5) return;
  user.report(Severity::info,
              trf("Touch runs at {:.0f} ticks per second since this window opened; the scene asks for {:.0f}",
                  ticks_per_s, scene.ticks_per_s));
}

/// Gives panel, plots and banner the servo's limits.
void publishLimits(const engine::ServoPlan& plan, const scene::Scene& scene, FingerHolders& holders,
                   Conversation& user) {
  DevicesShown& shown = holders.devices;
  const scene::SafetySettings& safety = plan.world->scene.safety;
  holders.device_limit_n = plan.limiter.force_n;
  shown.stiffness_factor = plan.limiter.stiffness_factor;
  shown.ratios_kept_to_n = plan.limiter.cap_n_per_mm > 0.0 ? plan.limiter.compared_n : 0.0;
  shown.unsafe = safety.unsafe_stiffness;
  std::vector<std::string> notes;
  if (!holders.held.empty()) {
    notes = servo::safetyNotes(safety, device::profileOf(scene.safety.device, holders.held), 1.0 / holders.ticks_per_s);
  }
  for (const std::string& note : notes) {
    if (std::ranges::find(shown.safety_notes, note) == shown.safety_notes.end()) {
      user.messages.note(note, user.now_s);
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
  scene.view = {};  // the view stays (BodyView::state)
  scene.ellipses.key_points.clear();
  scene.body = {};
  scene.body.kind = scene::BodyKind::mesh;
  scene.body.file = path;
  scene.safety.unsafe_stiffness = false;  // the consent was for another body
  return {std::move(scene), {}};
}

WorldSwap::WorldSwap(std::shared_ptr<const scene::World> world) : builder_(decodePicture), shown_(std::move(world)) {}

void WorldSwap::open(const std::string& file, EditedScene& edited, scene::Unit unit) {
  opening_ = file;
  edited.opening = true;
  wanted_ = 0;
  body_requested_ = true;
  opening_document_ = std::make_shared<SceneDocument>();
  const auto read = [file, unit, like = edited.scene, document = opening_document_] {
    OpenedScene opened = sceneFromFile(file, like);
    if (opened.document.file.empty()) opened.scene.body.unit = unit;
    *document = std::move(opened.document);
    return std::move(opened.scene);
  };
  builder_.request({.scene = {}, .body = nullptr, .read = read});
}

void WorldSwap::open(const scene::Scene& scene, EditedScene& edited) {
  edited.scene = scene;
  edited.document = {};
  edited.opening = true;
  edited.editor = {};
  edited.lump_editor = {};
  opening_.clear();
  wanted_ = 0;
  body_requested_ = true;
  builder_.request({.scene = scene, .body = nullptr, .read = {}});
}

void WorldSwap::showTemporarily(const scene::Scene& scene, EditedScene& edited) {
  edited.scene = scene;
  failure_.clear();
  wanted_ = 0;
  builder_.request({.scene = scene, .body = coming_ ? coming_ : shown_, .read = {}});
}

void WorldSwap::cancel(EditedScene& edited, Conversation& user) {
  builder_.cancel();
  wanted_ = 0;
  body_requested_ = false;
  opening_.clear();
  edited.opening = false;
  // The present body is requested again.
  edited.scene.body = shown_->scene.body;
  user.report(Severity::info, "Cancelled: the body stays as it was");
}

void WorldSwap::advance(const SwapWork& work) {
  const std::uint32_t changed = work.user.output.changed;
  if (changed & kFingerChange) changeFingers(work);
  if (const std::uint32_t world = changed & (kMapChange | kBodyChange)) {
    wanted_ |= world;
    wanted_since_s_ = work.user.now_s;
  }
  requestWhenQuiet(work.edited.scene, work.user.now_s);
  handleBuildResult(work);
  work.edited.building = builder_.progress();
}

void WorldSwap::requestWhenQuiet(const scene::Scene& scene, double now_s) {
  if (wanted_ == 0 || !opening_.empty() || now_s - wanted_since_s_ < kQuietS) return;
  engine::BuildRequest request{.scene = scene, .body = nullptr, .read = {}};
  body_requested_ = body_requested_ || (wanted_ & kBodyChange);
  if (!body_requested_) request.body = coming_ ? coming_ : shown_;
  wanted_ = 0;
  builder_.request(std::move(request));
}

void WorldSwap::handleBuildResult(const SwapWork& work) {
  EditedScene& edited = work.edited;
  const auto result = builder_.collectResult();
  if (!result) return;
  const std::string opened = std::exchange(opening_, {});
  body_requested_ =
      body_requested_ && !result->world && opened.empty();  // a failed one is tried again with the next request
  if (!result->world) {
    edited.opening = false;
    failure_ = result->error;
    work.user.report(Severity::error, opened.empty() ? result->error : cannotOpen(result->error));
    return;
  }
  if (!opened.empty()) {
    work.user.messages.clearErrors(cannotOpen());
    remember(work.recent, opened);
    edited.scene = result->world->scene;
    edited.document = *opening_document_;
    edited.editor = {};
    edited.lump_editor = {};
    reportRateMismatch(edited.scene, work.holders.ticks_per_s, work.user);
  }
  adopt(*result, work);
}

void WorldSwap::adopt(const engine::BuildResult& result, const SwapWork& work) {
  // To the fingers a swelling over a lump makes another body, to the eye the same.
  const bool other_body = result.request.body == nullptr || result.world->body != shown_->body;
  try {
    engine::ServoPlan plan =
        planFor(result.world, work.edited.scene, other_body, work.holders.held, 1.0 / work.holders.ticks_per_s);
    publishLimits(plan, work.edited.scene, work.holders, work.user);
    work.servo.change(std::move(plan));
  } catch (const Error& error) {
    failure_ = error.what();
    work.user.report(Severity::error, error.what());
    return;
  }
  coming_ = result.world;
  other_body_ = other_body_ || result.request.body == nullptr;
}

engine::ServoPlan WorldSwap::makePlan(const scene::Scene& scene, FingerHolders& holders, Conversation& user) const {
  const bool other_body = coming_ && (other_body_ || coming_->body != shown_->body);
  engine::ServoPlan plan =
      planFor(coming_ ? coming_ : shown_, scene, other_body, holders.held, 1.0 / holders.ticks_per_s);
  publishLimits(plan, scene, holders, user);
  return plan;
}

void WorldSwap::changeFingers(const SwapWork& work) const {
  try {
    work.servo.change(makePlan(work.edited.scene, work.holders, work.user));
  } catch (const Error& error) {
    work.user.report(Severity::warning, error.what());
  }
}

WorldSwap::Shown WorldSwap::popShown(engine::ServoThread& servo) {
  servo.exchange();
  if (!coming_ || servo.world() != coming_) return {};
  shown_ = std::exchange(coming_, nullptr);
  return {shown_, std::exchange(other_body_, false)};
}

}  // namespace palpate::viewer
