// The tiles of a class: seen without scrolling, and as large as the window allows.
#include "class/window/class_window.h"

#include <gtest/gtest.h>

namespace palpate::viewer {
namespace {

constexpr TileRoom kWindow{800.0f, 750.0f, 8.0f};  // beside an opened station in a window of 1280 x 800

float widthOfAll(const TileLayout& layout, float gap) {
  return static_cast<float>(layout.columns) * (layout.width + gap) - gap;
}

float heightOfAll(const TileLayout& layout, std::size_t count, float gap) {
  const int rows = (static_cast<int>(count) + layout.columns - 1) / layout.columns;
  return static_cast<float>(rows) * (layout.height + gap) - gap;
}

TEST(TileLayout, ShowsOneToThirtyStationsWithoutScrolling) {
  for (std::size_t count = 1; count <= 30; ++count) {
    const TileLayout layout = tilesIn(kWindow, count);
    EXPECT_LE(widthOfAll(layout, kWindow.gap), kWindow.width + 0.5f) << count;
    EXPECT_LE(heightOfAll(layout, count, kWindow.gap), kWindow.height + 0.5f) << count;
  }
}

TEST(TileLayout, GivesFewStationsLargeTiles) {
  const TileLayout few = tilesIn(kWindow, 4);
  const TileLayout many = tilesIn(kWindow, 18);
  EXPECT_GT(few.width, 300.0f);
  EXPECT_GT(few.height, many.height);
  EXPECT_FALSE(few.compact);
  EXPECT_FALSE(many.compact);
}

TEST(TileLayout, LeavesTheLevelOutWhereThirtyWouldNotFit) { EXPECT_TRUE(tilesIn(kWindow, 30).compact); }

TEST(TileLayout, KeepsTilesReadableInASmallWindowThatThenScrolls) {
  const TileLayout layout = tilesIn({170.0f, 440.0f, 8.0f}, 30);
  EXPECT_EQ(layout.columns, 1);
  EXPECT_GE(layout.height, 60.0f);
  EXPECT_GT(heightOfAll(layout, 30, 8.0f), 440.0f);
}

}  // namespace
}  // namespace palpate::viewer
