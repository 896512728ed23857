// The body of a trial on its way to the finger. Its making takes time, and the clock of a trial begins with the first
// tick that is felt on it.
//
//   requested ─ built on its own thread, handed to the servo ─► taken ─ first tick on it ─► felt
//
// Pure: it builds nothing.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "palpate/training/session/session.h"

namespace palpate::viewer {

class TrialWorld {
 public:
  /// A body to be felt, and for which trial: another trial is another body, even if the place is the same, so that the
  /// build time reveals nothing.
  struct Body {
    std::optional<training::HiddenNow> hidden = {};
    int trial = 0;
    friend bool operator==(const Body&, const Body&) = default;
  };

  /// True if it is another one than was requested last: it has to be made.
  bool request(const Body& body) {
    if (requested_ == body) return false;
    requested_ = body;
    state_ = State::requested;
    before_ = newest_;
    return true;
  }
  const std::optional<Body>& requested() const { return requested_; }
  /// The servo has taken a world: the requested one, or another.
  void taken(bool as_requested) {
    if (waiting()) state_ = as_requested ? State::taken : State::requested;
  }
  /// Every tick, with the number of the world it was felt on. True once, with the first one on the requested body.
  bool feel(std::uint32_t world) {
    newest_ = std::max(newest_, world);
    if (state_ != State::taken || world <= before_) return false;
    state_ = State::felt;
    return true;
  }
  /// Requested, and not felt yet.
  bool waiting() const { return state_ != State::felt; }
  /// True once for each trial: an interrupted one continues when its body is built again.
  bool begins() {
    if (!requested_ || begun_ == *requested_) return false;
    begun_ = *requested_;
    return true;
  }
  /// It could not be made: the next request makes it again.
  void fail() { requested_.reset(); }
  /// No trial is under way.
  void clear() {
    requested_.reset();
    begun_ = kNone;
    state_ = State::felt;
  }

 private:
  enum class State : std::uint8_t { requested, taken, felt };
  static constexpr Body kNone = {.hidden = std::nullopt, .trial = -1};
  State state_ = State::felt;
  std::optional<Body> requested_;
  Body begun_ = kNone;        ///< clock has begun; GCC 12.2 miscompiles the comparison of two optionals here
  std::uint32_t newest_ = 0;  ///< newest of the worlds that were felt
  std::uint32_t before_ = 0;  ///< the newest when the body was requested
};

}  // namespace palpate::viewer
