#include "view/viewer/world/world_swap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/device/device_profile.h"
#include "palpate/scene/scene_file.h"
#include "palpate/servo/device_limits.h"
#include "palpate/view/layers/skin_picture.h"
#include "view/viewer/state/state_file.h"

namespace palpate::viewer {

namespace {

constexpr const char* kCannotOpen = "cannot open ";

/// A broken picture must not reach the display.
void decodePicture(const scene::World& world) {
  if (world.body->texture && !world.body->texture->made) view::decodedPicture(*world.body->texture);
}

void tellRate(Session& session) {
  if (std::abs(session.scene.ticks_per_s - session.ticks_per_s) < 0.5) return;
  session.report(Severity::info,
                 fmt::format("Felt at {:.0f} ticks a second, as this window began; the scene says {:.0f}",
                             session.ticks_per_s, session.scene.ticks_per_s));
}

/// The panel, the plots and the banner show what the servo gets.
void tellLimits(const engine::ServoPlan& plan, Session& session) {
  DevicesShown& shown = session.devices;
  const scene::SafetySettings& safety = plan.world->scene.safety;
  session.device_limit_n = plan.limiter.force_n;
  shown.stiffness_factor = plan.limiter.stiffness_factor;
  shown.ratios_kept_to_n = plan.limiter.cap_n_per_mm > 0.0 ? plan.limiter.compared_n : 0.0;
  shown.unsafe = safety.unsafe_stiffness;
  std::vector<std::string> notes;
  if (!session.held.empty()) {
    notes = servo::safetyNotes(safety, device::profileOf(session.scene.safety.device, session.held),
                               1.0 / session.ticks_per_s);
  }
  for (const std::string& note : notes) {
    if (std::ranges::find(shown.safety_notes, note) == shown.safety_notes.end()) {
      session.messages.note(note, session.now_s);
    }
  }
  shown.safety_notes = std::move(notes);
}

}  // namespace

scene::Scene sceneFromFile(const std::string& file, const scene::Scene& like) {
  const std::filesystem::path path(file);
  std::string kind = path.extension().string();
  std::transform(kind.begin(), kind.end(), kind.begin(), [](unsigned char c) { return std::tolower(c); });
  if (kind == ".toml") return scene::load(path);
  scene::Scene scene = like;
  scene.title = path.filename().string();
  scene.file.clear();
  // They belong to the body they were placed on.
  scene.dysfunctions.clear();
  scene.fingers.clear();
  for (scene::DeviceSettings& device : scene.devices) device.origin_mm.reset();
  scene.view = {};  // how it is looked at stays (Session::state)
  scene.ellipses.key_points.clear();
  scene.body = {};
  scene.body.kind = scene::BodyKind::mesh;
  scene.body.file = path;
  scene.safety.unsafe_stiffness = false;  // it was given for another body
  return scene;
}

WorldSwap::WorldSwap(std::shared_ptr<const scene::World> world) : builder_(decodePicture), shown_(std::move(world)) {}

void WorldSwap::open(const std::string& file, Session& session) {
  opening_ = file;
  session.opening = true;
  wanted_ = 0;
  body_wished_ = true;
  builder_.wish(
      {.scene = {}, .body = nullptr, .read = [file, like = session.scene] { return sceneFromFile(file, like); }});
}

void WorldSwap::open(const scene::Scene& scene, Session& session) {
  session.scene = scene;
  session.document = {};
  session.opening = true;
  session.editor = {};
  opening_.clear();
  wanted_ = 0;
  body_wished_ = true;
  builder_.wish({.scene = scene, .body = nullptr, .read = {}});
}

void WorldSwap::lay(const scene::Scene& scene, Session& session) {
  session.scene = scene;
  failure_.clear();
  wanted_ = 0;
  builder_.wish({.scene = scene, .body = coming_ ? coming_ : shown_, .read = {}});
}

void WorldSwap::cancel(Session& session) {
  builder_.cancel();
  wanted_ = 0;
  body_wished_ = false;
  opening_.clear();
  session.opening = false;
  // What is at work is what is wished again.
  session.scene.body = shown_->scene.body;
  session.report(Severity::info, "Cancelled: the body stays as it was");
}

void WorldSwap::advance(Session& session, engine::ServoThread& servo) {
  if (session.asks.changed & kFingerChange) changeFingers(session, servo);
  if (const std::uint32_t world = session.asks.changed & (kMapChange | kBodyChange)) {
    wanted_ |= world;
    wanted_since_s_ = session.now_s;
  }
  wishWhenQuiet(session);
  takeResult(session, servo);
  session.building = builder_.progress();
}

void WorldSwap::wishWhenQuiet(Session& session) {
  if (wanted_ == 0 || !opening_.empty() || session.now_s - wanted_since_s_ < kQuietS) return;
  engine::BuildWish wish{.scene = session.scene, .body = nullptr, .read = {}};
  body_wished_ = body_wished_ || (wanted_ & kBodyChange);
  if (!body_wished_) wish.body = coming_ ? coming_ : shown_;
  wanted_ = 0;
  builder_.wish(std::move(wish));
}

void WorldSwap::takeResult(Session& session, engine::ServoThread& servo) {
  const auto result = builder_.take();
  if (!result) return;
  const std::string opened = std::exchange(opening_, {});
  body_wished_ = body_wished_ && !result->world && opened.empty();  // one that failed is tried again with the next wish
  if (!result->world) {
    session.opening = false;
    failure_ = result->error;
    session.report(Severity::error, (opened.empty() ? "" : kCannotOpen) + result->error);
    return;
  }
  if (!opened.empty()) {
    session.messages.clearErrors(kCannotOpen);
    remember(session.state.recent, opened);
    session.scene = result->world->scene;
    session.document = documentOf(session.scene.file);
    session.editor = {};
    tellRate(session);
  }
  adopt(session, *result, servo);
}

void WorldSwap::adopt(Session& session, const engine::BuildResult& result, engine::ServoThread& servo) {
  try {
    engine::ServoPlan plan =
        planFor(result.world, session.scene, result.wish.body == nullptr, session.held, 1.0 / session.ticks_per_s);
    tellLimits(plan, session);
    servo.change(std::move(plan));
  } catch (const Error& error) {
    failure_ = error.what();
    session.report(Severity::error, error.what());
    return;
  }
  coming_ = result.world;
  other_body_ = other_body_ || result.wish.body == nullptr;
}

engine::ServoPlan WorldSwap::planNow(Session& session) const {
  engine::ServoPlan plan = planFor(coming_ ? coming_ : shown_, session.scene, coming_ && other_body_, session.held,
                                   1.0 / session.ticks_per_s);
  tellLimits(plan, session);
  return plan;
}

void WorldSwap::changeFingers(Session& session, engine::ServoThread& servo) const {
  try {
    servo.change(planNow(session));
  } catch (const Error& error) {
    session.report(Severity::warning, error.what());
  }
}

WorldSwap::Shown WorldSwap::takeShown(engine::ServoThread& servo) {
  servo.exchange();
  if (!coming_ || servo.world() != coming_) return {};
  shown_ = std::exchange(coming_, nullptr);
  return {shown_, std::exchange(other_body_, false)};
}

}  // namespace palpate::viewer
