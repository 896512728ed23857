// Who of those that look on has the finger, and what of their requests reaches it: one at a time, only so deep, strong
// and fast, and let go as soon as nothing is heard any more.
//
//   Request of a page ─ role, holder, limits ─► device::FingerTarget ─ MouseLink ─► servo (1 kHz, followed smoothly)
//
// A plain machine: it knows no network and no clock. One thread.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "cli/serve/access.h"
#include "palpate/base/json.h"
#include "palpate/base/vec.h"
#include "palpate/device/mouse_finger.h"

namespace palpate::app::serving {

// What a page and the server say to each other beside skin and frames: one JSON object a message.
//
// docs/reference/serve.md has the table. From the server: hello, state, touch, message, refused. To it: what Request
// holds.

/// A longer message closes its stream.
inline constexpr std::size_t kMaxRequestBytes = 1024;
inline constexpr std::size_t kMaxWords = 200;

// What a page may request.

/// The finger is here on the skin at rest: deep, or as strong as that.
struct Point {
  std::size_t finger = 0;
  bool pressed = false;
  Vec3 place = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  ///< unit
  double depth_mm = 0.0;        ///< of the pad under the skin
  std::optional<double> force_n = {};
};
struct Lift {
  std::size_t finger = 0;
};
struct Take {};  ///< control
struct Give {};
struct Pause {
  bool on = true;
};
struct Say {
  std::string words;
};
/// To be told what the fingers feel, or no more.
struct Listen {
  bool on = true;
  std::size_t pad = 0;  ///< taxels along a side of a pad on each finger; 0: none
  double pad_mm = 16.0;
};
using Request = std::variant<Point, Lift, Take, Give, Pause, Say, Listen>;

/// Deeper, stronger or farther is no message; the desk limits further.
inline constexpr double kDeepestMm = 60.0;
inline constexpr double kStrongestN = 60.0;
inline constexpr double kFarthestPlaceMm = 1e5;

/// Nothing for what is none of them: then `why` says what is wrong. Never throws.
std::optional<Request> requestOf(std::string_view message, std::string& why);

struct ControlLimits {
  double depth_mm = 25.0;
  double force_n = 15.0;
  double speed_mm_per_s = 400.0;  ///< of the place while it presses: what comes faster is followed at this
  double beside_mm = 30.0;        ///< a place so far out of the body's box is refused
  double silence_s = 0.5;         ///< a pressing finger of which nothing is heard is let go
  double idle_s = 60.0;           ///< and its holder loses it
  double leaving_s = 0.5;         ///< for a finger that was let go to rise, before it is nowhere
};

/// A finger as a page sees it.
struct ControlledFinger {
  std::string name;
  double radius_mm = 0.0;
  std::string device;  ///< that holds it; empty: a page may
};

/// Names one that looks on; 0 is nobody.
using WatcherId = std::uint64_t;

class FingerControl {
 public:
  using PointServo = std::function<void(std::size_t finger, const device::FingerTarget& target)>;
  /// Halts or frees what devices feel; may be empty.
  using HaltDevices = std::function<void(bool halted)>;

  FingerControl(std::vector<ControlledFinger> fingers, const Box3& body, PointServo point, HaltDevices halt = {},
                const ControlLimits& limits = {});

  /// Does what is requested; why it was not done, or empty. Messages (Say) are only judged: to send them on is the
  /// caller's, and so is who listens (Listen).
  std::string hear(WatcherId who, Role role, const Request& request, double now_s);
  /// The stream has ended, however.
  void left(WatcherId who, double now_s);
  /// Some times a second: lets go what is silent.
  void tick(double now_s);
  /// Lets go everything: the end.
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
    double let_go_s = -1.0;  ///< when it was; below 0: it is held, or nowhere
  };
  std::string take(WatcherId who, Role role, double now_s);
  std::string point(WatcherId who, Role role, const Point& request, double now_s);
  void letGo(std::size_t finger, double now_s);
  void letGoAll(double now_s);
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
