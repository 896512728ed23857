// A training that is under way, as the window meets it: what hides in the body, what its screen shows, what keys and
// touches mean, and how an answer counts. Trainings of places and of lumps differ in this alone.
//
//   samples, keys, acts ─► Task ─ rows ─► SessionRun (session_run.h)        Task ─ describe ─► TrainingView ─► screen
//                           └─ wanted, makeScene ─► the body to be felt
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "palpate/training/session/lump_session.h"
#include "palpate/training/session/session.h"
#include "teach/window/training_keys.h"
#include "teach/window/training_words.h"
#include "teach/window/trial_world.h"
#include "view/viewer/modes/mode.h"

namespace palpate::viewer {

/// A finger that no hand moves: it walks from site to site, where lumps are sought step by step over the skin, and
/// presses by a key.
struct KeyboardFinger {
  bool presses = false;
  bool moved = false;  ///< the pointer is still to be moved
  std::optional<SkinPlace> place = {};
  void press(bool down) {
    presses = down;
    moved = true;
  }
  void lift() {
    if (presses) press(false);
  }
};

struct Task {
  enum class Acted : std::uint8_t { nothing, done, over };  ///< over: the session may be closed

  virtual ~Task() = default;

  virtual training::Sitting& session() = 0;
  // The session, for what only its kind has.
  virtual training::Session* places() { return nullptr; }
  virtual const training::LumpSession* lumps() const { return nullptr; }

  // The body.
  virtual TrialWorld::Body wanted() const = 0;
  virtual scene::Scene makeScene(const scene::Scene& base, const TrialWorld::Body& body) const = 0;
  /// The requested body is at work, or another one.
  virtual void handleNewWorld(const scene::World& /*world*/) {}
  virtual bool padShown() const { return false; }

  // The screen, and hands.
  virtual void describe(TrainingView& view) const = 0;
  virtual void feel(const trace::Sample& sample, const training::Moment& now) { session().feel(sample, now); }
  /// Where the screen's marks are seen, by their number from 1.
  virtual std::vector<SeenSite> look(const Sight& sight, KeyboardFinger& finger) = 0;
  virtual void handle(const TrainingStroke& stroke, KeyboardFinger& finger) = 0;
  /// Clicks that a device's button stands for; none while the finger is at no place.
  virtual std::vector<TrainingClick> button() const = 0;
  /// `waiting`: for the body.
  virtual Acted act(const TrainingClick& click, bool waiting, const training::Moment& now) = 0;
};

/// Starts the task of this kind of session. Throws Error where a resumed block does not fit.
std::unique_ptr<Task> makeTask(const training::SessionPlan& plan);
std::unique_ptr<Task> makeLumpsTask(const training::SessionPlan& plan, const training::Moment& now);

/// The sites and the body beside them that shows where they are.
Eigen::AlignedBox3d roomAround(const training::SiteSet& sites);

}  // namespace palpate::viewer
