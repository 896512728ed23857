// The thing that a simulated trainee's finger touches: a body in a closed loop (body_touch.h), or only the numbers that
// one would give (imagined_touch.h).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "palpate/training/session/session.h"
#include "palpate/training/trainee/trainee_finger.h"

namespace palpate::training {

/// One press as the trainee means it.
struct MeantPress {
  Vec2 beside_mm = Vec2::Zero();  ///< from the site, on the map plane
  double force_n = 1.5;
  double hold_s = 0.5;
};

class Touching {
 public:
  using EachTick = std::function<void(const trace::Sample&)>;

  Touching() = default;
  virtual ~Touching() = default;
  Touching(const Touching&) = delete;
  Touching& operator=(const Touching&) = delete;

  /// From the next tick on the body holds this.
  virtual void change(const std::optional<HiddenNow>& hidden) = 0;
  /// Goes there, presses, and comes up again; calls `each_tick` at every tick.
  virtual FeltPress press(const Site& site, const MeantPress& meant, const EachTick& each_tick) = 0;
  /// Waits over the skin.
  virtual void rest(double seconds, const EachTick& each_tick) = 0;
  /// The number of the next tick: those before have been.
  virtual std::uint64_t tick() const = 0;
  virtual double tickS() const = 0;
  /// Adds a remark to the recording, at the next tick.
  virtual void mark(const std::string& text) = 0;
  /// Writes the rest of the recording; the last call.
  virtual void finish(std::int64_t end_ms) = 0;
};

}  // namespace palpate::training
