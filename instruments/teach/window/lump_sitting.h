// A session with lumps in the window: the text of its screen, the place that was touched last, the body that is felt,
// and its rows in the record.
//
//   samples ─► LumpSessionRun ─ screen, marks ─► TrainingMode ─► painting          act ─► LumpSession ─► rows
//                   └─ wanted ─► the body of a trial
//
// A place is named by touching it: Here means the finger's last press, whether a device, the mouse or the keyboard
// moves the finger (training_mode.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "palpate/training/session/lump_session.h"
#include "teach/window/session_run.h"
#include "teach/window/training_screen.h"

namespace palpate::viewer {

/// Inputs of a screen.
struct LumpView {
  const training::LumpSession* session = nullptr;
  std::string corner = {};  ///< the signed-in trainee
  bool waiting = false;     ///< for the body
  bool touched = false;     ///< a place was, that Here would name
  bool by_mouse = false;    ///< no device holds the finger
  std::size_t named = 0;    ///< number of marks, from the first, that were named
  std::size_t marks = 0;
};
/// Pure: words, buttons and marks.
TrainingScreen makeLumpScreen(const LumpView& view);

class LumpSessionRun {
 public:
  /// All must outlive it. Throws Error.
  LumpSessionRun(training::Store& store, LiveServo& servo, const training::LumpSessionPlan& plan,
                 const training::Moment& now);

  const training::LumpSession& session() const { return session_; }
  bool save() { return rows_.save(session_.drainRows()); }
  const std::string& trouble() const { return rows_.trouble(); }
  std::string finish(std::string_view ended_by, const training::Moment& now);

  /// The body to be felt now, and its scene around `base`.
  TrialWorld::Body wanted() const;
  scene::Scene makeScene(const scene::Scene& base) const;
  /// Call once the world with the hidden lumps is at work.
  void handleNewWorld(const scene::World& world);
  void ready(const training::Moment& now) { session_.ready(now); }
  void feel(const trace::Sample& sample, const training::Moment& now);
  /// Handles a button or key; true: the session is over and may be closed.
  bool act(TrainingAct act, int value, const training::Moment& now);
  /// Handles a device's button: names the touched place, else continues.
  bool deviceButton(const training::Moment& now);

  TrainingScreen screen(const std::string& corner, bool waiting, bool by_mouse) const;
  /// Points on the skin of the screen's marks, by their number from 1.
  const std::vector<Vec3>& places() const { return places_; }

 private:
  void namePlace(const training::Moment& now);
  void markPlaces();

  RowWriter rows_;
  training::LumpSession session_;
  std::optional<Vec3> touched_;  ///< place on the skin of the newest press of this body
  std::vector<Vec3> named_;      ///< places named in this body
  std::vector<Vec3> feet_;       ///< points on the skin over the body's lumps
  std::vector<Vec3> places_;
};

}  // namespace palpate::viewer
