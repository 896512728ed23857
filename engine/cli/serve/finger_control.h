// Decides which watcher holds the finger, and which of its requests reach it: one at a time, limited in depth, force
// and speed, and released on silence.
//
//   Request of a page ─ role, holder, limits ─► device::FingerTarget ─ MouseLink ─► servo (1 kHz, followed smoothly)
//
// A plain machine without network or clock. One thread.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "cli/serve/access.h"
#include "cli/serve/messages.h"
#include "palpate/base/vec.h"
#include "palpate/device/mouse_finger.h"

namespace palpate::app::serving {

struct ControlLimits {
  double depth_mm = 25.0;
  double force_n = 15.0;
  double speed_mm_per_s = 400.0;  ///< limit for the place while it presses: faster moves are followed at this
  double margin_mm = 30.0;        ///< places farther out of the body's box are refused
  double silence_s = 0.5;         ///< a pressing finger without messages is released
  double idle_s = 60.0;           ///< and its holder loses it
  double leaving_s = 0.5;         ///< for a released finger to rise, before it disappears
};

/// A finger as a page sees it.
struct ControlledFinger {
  std::string name;
  double radius_mm = 0.0;
  std::string device;  ///< device that holds it; empty: a page may
};

/// Identifies a watcher; 0 is none.
using WatcherId = std::uint64_t;

class FingerControl {
 public:
  using PointServo = std::function<void(std::size_t finger, const device::FingerTarget& target)>;
  /// Halts or frees the devices' forces; may be empty.
  using HaltDevices = std::function<void(bool halted)>;

  FingerControl(std::vector<ControlledFinger> fingers, const Box3& body, PointServo point, HaltDevices halt = {},
                const ControlLimits& limits = {});

  /// Handles a request; returns why it was refused, or empty. Messages (Say) are only checked: sending them on is the
  /// caller's, and so are subscriptions (Listen).
  std::string handleRequest(WatcherId who, Role role, const Request& request, double now_s);
  /// Call when the stream has ended, for any reason.
  void left(WatcherId who, double now_s);
  /// Releases silent fingers; call it some times a second.
  void tick(double now_s);
  /// Releases all fingers at the end.
  void close(double now_s);

  WatcherId holder() const { return holder_; }
  bool paused() const { return paused_; }
  /// A page may move at least one finger.
  bool hasFreeFinger() const;
  const std::vector<ControlledFinger>& fingers() const { return fingers_; }

 private:
  struct Hand {
    device::FingerTarget target;
    double heard_s = 0.0;
    double released_s = -1.0;  ///< time of release; below 0: it is held, or nowhere
  };
  std::string acquireControl(WatcherId who, Role role, double now_s);
  std::string point(WatcherId who, Role role, const Point& request, double now_s);
  void release(std::size_t finger, double now_s);
  void releaseAll(double now_s);
  std::string pause(Role role, bool on, double now_s);
  Vec3 reachable(const Hand& hand, const Vec3& place, double now_s) const;

  std::vector<ControlledFinger> fingers_;
  Box3 body_;
  PointServo point_;
  HaltDevices halt_;
  ControlLimits limits_;
  std::vector<Hand> hands_;
  WatcherId holder_ = 0;
  double holder_heard_s_ = 0.0;
  bool paused_ = false;
};

}  // namespace palpate::app::serving
