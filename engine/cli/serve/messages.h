// Messages between a page and the server besides skin and frames: one JSON object each.
//
// docs/reference/serve.md has the table. From the server: hello, state, touch, message, refused. To it: Request.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "palpate/base/vec.h"

namespace palpate::app::serving {

/// A longer message closes its stream.
inline constexpr std::size_t kMaxRequestBytes = 1024;
inline constexpr std::size_t kMaxWords = 200;

// Requests of a page.

/// The finger is here on the skin at rest, this deep or this strong.
struct Point {
  std::size_t finger = 0;
  bool pressed = false;
  Vec3 place = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  ///< unit
  double depth_mm = 0.0;        ///< depth of the pad under the skin
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
/// Subscribes to the fingers' outputs, or unsubscribes.
struct Listen {
  bool on = true;
  std::size_t pad = 0;  ///< taxels along a side of a pad on each finger; 0: none
  double pad_mm = 16.0;
};
using Request = std::variant<Point, Lift, Take, Give, Pause, Say, Listen>;

/// Messages beyond these are refused; ControlLimits is tighter.
inline constexpr double kDeepestMm = 60.0;
inline constexpr double kStrongestN = 60.0;
inline constexpr double kFarthestPlaceMm = 1e5;

/// Empty for an invalid message: then `why` has the reason. Never throws.
std::optional<Request> parseRequest(std::string_view message, std::string& why);

}  // namespace palpate::app::serving
