// How large the tiles of a class are, so that one station fills the window and thirty are seen without scrolling.
#pragma once

#include <cstddef>

namespace palpate::viewer {

/// Points.
struct TileLayout {
  int columns = 1;
  float width = 0.0f;
  float height = 0.0f;
  bool compact = false;  ///< without the level, and what a station needs in place of its trial
};

struct TileRoom {
  float width = 0.0f;
  float height = 0.0f;
  float gap = 0.0f;  ///< between tiles
};

/// The largest tiles of `count` that fit; where none do, the smallest, and the caller scrolls.
TileLayout tilesIn(const TileRoom& room, std::size_t count);

}  // namespace palpate::viewer
