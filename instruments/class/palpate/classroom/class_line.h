// Reports the training window to a class and receives its instructor's commands, once a frame; idle without a class.
//
//   session, samples ─► ClassLine ─► StationLink ─► class        instructor ─► popCommand ─► desk
#pragma once

#include <optional>
#include <string>

#include "palpate/classroom/station_link.h"
#include "palpate/trace/sample.h"
#include "palpate/training/session/session.h"

namespace palpate::classroom {

class ClassLine {
 public:
  /// The store must outlive it. Throws Error.
  ClassLine(const Member& member, training::Store& store, const StationInfo& info) : link_(member, store, info) {}

  void update(const trace::Sample& sample);
  /// Call once a frame; null: no trainee is signed in.
  void follow(const training::Session* session);
  void publishSafety(const std::string& words) { link_.publishSafety(words); }
  std::optional<Command> popCommand() { return link_.popCommand(); }

 private:
  /// Inputs of a state that is costly to build: it is built again when one of these changed.
  struct StateInputs {
    training::Screen screen = training::Screen::finished;
    int trial = 0;
    bool paused = false;
    friend bool operator==(const StateInputs&, const StateInputs&) = default;
  };
  StationLink link_;
  trace::Sample pressing_;  ///< since the last frame, the one with the most force
  std::optional<StateInputs> seen_;
  bool told_ = false;
};

}  // namespace palpate::classroom
