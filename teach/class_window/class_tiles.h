// The tiles of a class and the station that is opened, drawn with Dear ImGui in a frame that has begun.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/classroom/class_watch.h"

namespace palpate::viewer {

/// What the window remembers between frames.
struct ClassView {
  std::string opened;  ///< a station; empty: none
  std::array<char, classroom::kMostCommandText> message{};
  std::string told;  ///< what the last button did
};

/// A picture of the back, and where places of the body are in it, each from 0 to 1 from its upper left corner.
struct BackPicture {
  std::uint32_t texture = 0;  ///< of the graphics card; 0: none
  double aspect = 1.0;        ///< width over height
  std::vector<Vec2> sites;    ///< of sites 1, 2, ...
  /// Of a finger; nothing without a picture.
  std::function<std::optional<Vec2>(const Vec3& place_mm)> seen_at;
};

/// Returns the station whose tile was clicked.
std::optional<std::string> classTiles(const std::vector<classroom::Tile>& tiles, const ClassView& view, float width);

/// The station that is open.
struct OpenedStation {
  const classroom::Tile& tile;
  const std::vector<classroom::ForcePoint>& forces;
  const BackPicture& back;
};
/// A command that was asked for.
std::optional<classroom::Command> openedStation(const OpenedStation& station, ClassView& view);

void classCurve(const std::vector<classroom::CurvePoint>& curve);

}  // namespace palpate::viewer
