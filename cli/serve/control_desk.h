// Who of those that look on has the finger, and what of their wishes reaches it: one at a time, only so deep, strong
// and fast, and let go as soon as nothing is heard any more.
//
//   Wish of a page ─ role, holder, limits ─► device::FingerTarget ─ MouseLink ─► servo (1 kHz, followed smoothly)
//
// A plain machine: it knows no network and no clock. One thread.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "cli/serve/access.h"
#include "cli/serve/messages.h"
#include "palpate/device/mouse_finger.h"

namespace palpate::app::serving {

struct DeskLimits {
  double depth_mm = 25.0;
  double force_n = 15.0;
  double speed_mm_per_s = 400.0;  ///< of the place while it presses: what comes faster is followed at this
  double beside_mm = 30.0;        ///< a place so far out of the body's box is refused
  double silence_s = 0.5;         ///< a pressing finger of which nothing is heard is let go
  double idle_s = 60.0;           ///< and its holder loses it
  double leaving_s = 0.5;         ///< for a finger that was let go to rise, before it is nowhere
};

/// A finger as a page sees it.
struct DeskFinger {
  std::string name;
  double radius_mm = 0.0;
  std::string device;  ///< that holds it; empty: a page may
};

/// Names one that looks on; 0 is nobody.
using OnlookerId = std::uint64_t;

class ControlDesk {
 public:
  using PointServo = std::function<void(std::size_t finger, const device::FingerTarget& target)>;
  /// Halts or frees what devices feel; may be empty.
  using HaltDevices = std::function<void(bool halted)>;

  ControlDesk(std::vector<DeskFinger> fingers, const Box3& body, PointServo point, HaltDevices halt = {},
              const DeskLimits& limits = {});

  /// Does what is wished; why it was not done, or empty. Messages (Say) are only judged: to send them on is the
  /// caller's.
  std::string hear(OnlookerId who, Role role, const Wish& wish, double now_s);
  /// The stream has ended, however.
  void left(OnlookerId who, double now_s);
  /// Some times a second: lets go what is silent.
  void tick(double now_s);
  /// Lets go everything: the end.
  void close(double now_s);

  OnlookerId holder() const { return holder_; }
  bool paused() const { return paused_; }
  /// A page may move at least one finger.
  bool hasFreeFinger() const;
  const std::vector<DeskFinger>& fingers() const { return fingers_; }

 private:
  struct Hand {
    device::FingerTarget target;
    double heard_s = 0.0;
    double let_go_s = -1.0;  ///< when it was; below 0: it is held, or nowhere
  };
  std::string take(OnlookerId who, Role role, double now_s);
  std::string point(OnlookerId who, Role role, const Point& wish, double now_s);
  void letGo(std::size_t finger, double now_s);
  void letGoAll(double now_s);
  std::string pause(Role role, bool on, double now_s);
  Vec3 reachable(const Hand& hand, const Vec3& place, double now_s) const;

  std::vector<DeskFinger> fingers_;
  Box3 body_;
  PointServo point_;
  HaltDevices halt_;
  DeskLimits limits_;
  std::vector<Hand> hands_;
  OnlookerId holder_ = 0;
  double holder_heard_s_ = 0.0;
  bool paused_ = false;
};

}  // namespace palpate::app::serving
