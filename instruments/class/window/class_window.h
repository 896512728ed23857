// The instructor's window: a tile for each station, who needs help first; one of them opened with its finger on the
// back, its force, its threshold so far; words, pause and the class's learning curve.
//
//   ClassWatch ─ tiles, forces, curve ─► drawing          buttons ─► ClassWatch::ask
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/classroom/class_watch.h"
#include "palpate/scene/world.h"

namespace palpate::viewer {

struct ClassWindowSettings {
  std::string title = "Palpate";
  std::shared_ptr<const scene::World> world;  ///< its back is shown; null: none
  int width = 1280;
  int height = 800;
  double seconds = 0.0;          ///< ends by itself; 0: never
  std::string picture;           ///< file of the last picture (PNG); empty: nowhere
  std::string opened;            ///< station that is open at first
  std::function<bool()> ending;  ///< set from outside: the window must close
};

/// Until it is closed. Throws Error without a display.
void runClassWindow(classroom::ClassWatch& watch, const ClassWindowSettings& settings);

// The tiles of a class and the station that is opened, drawn with Dear ImGui in a frame that has begun.

/// State that the window keeps between frames.
struct ClassView {
  std::string opened;  ///< a station; empty: none
  std::array<char, classroom::kMaxCommandText> message{};
  std::string told;  ///< result of the last button
};

/// A picture of the back, and where places of the body are in it, each from 0 to 1 from its upper left corner.
struct BackPicture {
  std::uint32_t texture = 0;  ///< texture of the graphics card; 0: none
  double aspect = 1.0;        ///< width over height
  std::vector<Vec2> sites;    ///< positions of sites 1, 2, ...
  /// Where a finger is on the picture; nothing without a picture.
  std::function<std::optional<Vec2>(const Vec3& place_mm)> seen_at;
};

// Size of the tiles, so that one station fills the window and thirty are seen without scrolling.

/// Points.
struct TileLayout {
  int columns = 1;
  float width = 0.0f;
  float height = 0.0f;
  bool compact = false;  ///< without the level, and with a station's need in place of its trial
};

struct TileRoom {
  float width = 0.0f;
  float height = 0.0f;
  float gap = 0.0f;  ///< between tiles
};

/// The largest tiles of `count` that fit; where none do, the smallest, and the caller scrolls.
TileLayout tilesIn(const TileRoom& room, std::size_t count);

/// In a room of this width and height, points. Returns the station whose tile was clicked.
std::optional<std::string> classTiles(const std::vector<classroom::Tile>& tiles, const ClassView& view,
                                      const Vec2& room);

/// The station that is open.
struct OpenedStation {
  const classroom::Tile& tile;
  const std::vector<classroom::ForcePoint>& forces;
  const BackPicture& back;
};
/// Returns the command that the user requested, if any.
std::optional<classroom::Command> openedStation(const OpenedStation& station, ClassView& view);

void classCurve(const std::vector<classroom::CurvePoint>& curve);

}  // namespace palpate::viewer
