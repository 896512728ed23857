#include "palpate/measure/dot_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "measure/tests/measure/drawn_dots.h"

namespace palpate::measure {
namespace {

/// How many dots of the grid sit on the site on which they were drawn, with the offset that most share.
std::size_t onTheirSites(const DotGrid& grid, const DrawnSheet& sheet) {
  std::map<std::pair<int, int>, std::size_t> offsets;
  for (const GridDot& dot : grid.dots) {
    for (int row = 0; row < sheet.rows; ++row) {
      for (int column = 0; column < sheet.columns; ++column) {
        if ((seen(sheet, placeOf(sheet, column, row)) - dot.dot.place_px).norm() <
            0.4 * sheet.spacing_mm * sheet.px_per_mm)
          ++offsets[{dot.site.column - column, dot.site.row - row}];
      }
    }
  }
  std::size_t most = 0;
  for (const auto& [offset, count] : offsets) most = std::max(most, count);
  return most;
}

TEST(DotGrid, OrdersAWholeSheetSeenFromAbove) {
  const DrawnSheet sheet;
  const DotGrid grid = growGrid(drawnDots(sheet, atRest).before);
  EXPECT_EQ(grid.dots.size(), 120u);
  EXPECT_EQ(onTheirSites(grid, sheet), 120u);
  EXPECT_NEAR(grid.spacing_px, 120.0, 0.5);
  EXPECT_NEAR(grid.roll_deg, 0.0, 0.1);
  EXPECT_LT(grid.irregularity, 1e-3);
}

TEST(DotGrid, OrdersASheetThatIsTiltedAndRolled) {
  const DrawnSheet sheet{.tilt_deg = 30.0, .roll_deg = 14.0};
  const DotGrid grid = growGrid(drawnDots(sheet, atRest, 0.4).before);
  EXPECT_GE(onTheirSites(grid, sheet), 118u);
  EXPECT_NEAR(std::abs(grid.roll_deg), 14.0, 3.0);
}

TEST(DotGrid, DoesNotLockOntoTheDiagonals) {
  // Rows a third closer than columns: the diagonal pairs are nearly as long as the columns.
  DotPair pair = drawnDots({}, atRest);
  for (Dot& dot : pair.before) dot.place_px.y() *= 0.66;
  EXPECT_EQ(growGrid(pair.before).dots.size(), 120u);
}

TEST(DotGrid, JumpsGapsAndLeavesStraysOut) {
  const DrawnSheet sheet;
  std::vector<Dot> dots = drawnDots(sheet, atRest, 0.3).before;
  for (const std::size_t gone : {77u, 55u, 54u, 31u, 12u}) dots.erase(dots.begin() + gone);
  const std::size_t good = dots.size();
  for (const Vec2& place : {Vec2(850.0, 1050.0), Vec2(640.0, 800.0), Vec2(1090.0, 1200.0)})
    dots.push_back({place, 700.0});
  std::reverse(dots.begin(), dots.end());
  const DotGrid grid = growGrid(dots);
  EXPECT_GE(onTheirSites(grid, sheet), good - 1);
  EXPECT_EQ(grid.dots.size() + grid.strays.size(), dots.size());
}

TEST(DotGrid, OfMarksWithoutOrderOrHardlyAnyIsEmpty) {
  EXPECT_TRUE(growGrid({}).dots.empty());
  const std::vector<Dot> two = {{{10.0, 10.0}, 5.0}, {{40.0, 10.0}, 5.0}};
  EXPECT_TRUE(growGrid(two).dots.empty());
  EXPECT_EQ(growGrid(two).strays.size(), 2u);
  const std::vector<Dot> same(30, Dot{{5.0, 5.0}, 5.0});  // all on one place
  EXPECT_LT(growGrid(same).dots.size(), 30u);
  Random random(3);
  std::vector<Dot> scattered;
  for (int i = 0; i < 120; ++i) scattered.push_back({{random.uniform(0.0, 1200.0), random.uniform(0.0, 1440.0)}, 50.0});
  EXPECT_LT(growGrid(scattered).dots.size(), 40u);
}

TEST(DotGrid, SaysHowIrregularTheMarksAre) {
  const DotGrid stencil = growGrid(drawnDots({}, atRest, 0.4).before);
  const DotGrid free_hand = growGrid(drawnDots({}, atRest, 1.5).before);
  EXPECT_LT(30.0 * stencil.irregularity, 1.2);
  EXPECT_GT(30.0 * free_hand.irregularity, 1.7);
}

}  // namespace
}  // namespace palpate::measure
