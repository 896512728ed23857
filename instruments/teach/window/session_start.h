// From who sits there and what holds the finger to the plan of a session, and to the rows of the record that it names.
//
//   TrainingSettings, SignIn, Holder ─ planSession ─► SessionPlan        station, class, trainee, protocol ─► Store
#pragma once

#include <optional>
#include <string>

#include "palpate/training/session/class_part.h"
#include "palpate/training/session/lump_bodies.h"
#include "palpate/training/session/session.h"
#include "teach/window/sign_in.h"
#include "view/viewer/state/viewer_state.h"
#include "view/viewer/world/live_servo.h"

namespace palpate::viewer {

struct TrainingSettings {
  std::filesystem::path records;
  training::Protocol protocol = training::builtInProtocol();
  SignInSettings sign_in = {};
  std::optional<std::uint64_t> seed = {};  ///< nothing: the system's randomness, another one for each session
  bool recording_files = true;             ///< trials are kept tick by tick
  std::optional<std::string> speech = {};  ///< program
  std::optional<training::ClassStation> station = {};  ///< of a class with a live view
  bool leads_back = false;                             ///< to the start page, from the sign-in
};

/// Holder of the trained finger, and what it can render.
struct Holder {
  void describe(TrainingView& view) const;
  bool mouse = true;
  std::string words = "mouse";
  double force_share = 1.0;
  double ratios_kept_to_n = 0.0;
  std::uint32_t ignored_buttons = 0;  ///< clutch and stop
};
Holder findHolder(const ViewerState& viewer, LiveServo& servo);

/// Body and sites, the same for every session of the window.
struct TrainingGround {
  training::SiteSet sites = {};
  scene::Scene base = {};
  std::shared_ptr<const scene::World> body = {};
  std::shared_ptr<const training::LumpBodies> lumps = {};  ///< filled on first use
};
/// Throws Error for a body that does not have the places of the protocol.
TrainingGround makeGround(const scene::World& world, const scene::Scene& base, const training::Protocol& protocol);

/// Everything that a session needs to begin.
struct SessionStart {
  training::SessionKind kind;
  const SignIn& who;
  const Holder& holder;
  TrainingGround& ground;
  const ViewerState& viewer;
};
/// Throws Error.
training::SessionPlan planSession(training::Store& store, const TrainingSettings& settings, const SessionStart& start);

}  // namespace palpate::viewer
