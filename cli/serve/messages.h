// What a page and the server say to each other beside skin and frames: one JSON object a message.
//
// docs/reference/serve.md has the table. From the server: hello, state, message, refused. To it: what Wish holds.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "palpate/base/vec.h"

namespace palpate::app::serving {

/// A longer message closes its stream.
inline constexpr std::size_t kMostWishBytes = 1024;
inline constexpr std::size_t kMostWords = 200;

// What a page may wish.

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
using Wish = std::variant<Point, Lift, Take, Give, Pause, Say>;

/// Deeper, stronger or farther is no message; the desk limits further.
inline constexpr double kDeepestMm = 60.0;
inline constexpr double kStrongestN = 60.0;
inline constexpr double kFarthestPlaceMm = 1e5;

/// Nothing for what is none of them: then `why` says what is wrong. Never throws.
std::optional<Wish> wishOf(std::string_view message, std::string& why);

}  // namespace palpate::app::serving
