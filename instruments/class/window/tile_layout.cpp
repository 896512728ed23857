// Full tiles where all of them fit, compact ones where they do not, and scrolling where even these do not. Cold.
#include "class/window/class_window.h"

#include <algorithm>
#include <optional>

namespace palpate::viewer {

namespace {

struct TileSize {
  float width, height;
};

// Points. Five lines of text, or three; as wide as "pre-test, trial 100 of 100".
constexpr TileSize kFull{218.0f, 112.0f};
constexpr TileSize kCompact{190.0f, 66.0f};
constexpr float kLargest = 1.6f;  ///< times the full tile: beyond, a tile is mostly empty

TileLayout inColumns(const TileRoom& room, std::size_t count, int columns) {
  const int lines = (static_cast<int>(count) + columns - 1) / columns;
  const auto rows = static_cast<float>(lines);
  const auto across = static_cast<float>(columns);
  return {.columns = columns,
          .width = (room.width - (across - 1.0f) * room.gap) / across,
          .height = (room.height - (rows - 1.0f) * room.gap) / rows};
}

int mostColumns(const TileRoom& room, const TileSize& least) {
  return std::max(1, static_cast<int>((room.width + room.gap) / (least.width + room.gap)));
}

std::optional<TileLayout> findLargestLayout(const TileRoom& room, std::size_t count, const TileSize& least) {
  const int most = std::min(static_cast<int>(count), mostColumns(room, least));
  std::optional<TileLayout> best;
  float best_share = 0.0f;
  for (int columns = 1; columns <= most; ++columns) {
    const TileLayout layout = inColumns(room, count, columns);
    const float share = std::min({layout.width / least.width, layout.height / least.height, kLargest});
    if (layout.height < least.height || share <= best_share) continue;
    best = layout;
    best_share = share;
  }
  return best;
}

}  // namespace

TileLayout tilesIn(const TileRoom& room, std::size_t count) {
  count = std::max<std::size_t>(count, 1);
  TileLayout layout;
  if (const auto full = findLargestLayout(room, count, kFull)) {
    layout = *full;
  } else if (const auto compact = findLargestLayout(room, count, kCompact)) {
    layout = *compact;
    layout.compact = true;
  } else {
    layout = inColumns(room, count, mostColumns(room, kCompact));
    layout.height = kCompact.height;
    layout.compact = true;
  }
  layout.width = std::min(layout.width, kLargest * kFull.width);
  layout.height = std::min(layout.height, kLargest * kFull.height);
  return layout;
}

}  // namespace palpate::viewer
