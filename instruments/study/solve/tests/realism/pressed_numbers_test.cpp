#include "solve/realism/pressed_numbers.h"

#include <gtest/gtest.h>

namespace palpate::tissue {
namespace {

LayeredTable dent() {
  LayeredTable table;
  table.stack.layers = {{"skin", 2.0, 150.0}, {"fat", 8.0, 10.5}};
  table.radii_mm = {0.0, 5.0, 10.0, 20.0};
  table.shapes = {{2.0, 2.0, 0.4, 3.0, {1.0, 0.6, 0.2, -0.1}, {0.0, 0.05, -0.02, 0.01}},
                  {6.0, 5.0, 2.4, 5.0, {1.0, 0.8, 0.6, 0.55}, {0.0, -0.05, -0.04, -0.01}}};
  return table;
}

TEST(PressedNumbers, TellWidthBulgeAndSidewaysMotion) {
  const LayeredTable table = dent();
  const PressedNumbers light = numbersOf(table, table.shapes[0]);
  EXPECT_DOUBLE_EQ(light.secant_n_per_mm, 0.2);
  EXPECT_DOUBLE_EQ(*light.half_radius_mm, 6.25);
  EXPECT_DOUBLE_EQ(*light.tenth_radius_mm, 10.0 + 10.0 / 3.0);
  EXPECT_DOUBLE_EQ(light.bulge_mm, 0.2);
  EXPECT_DOUBLE_EQ(light.drawn_in_mm, 0.04);
  EXPECT_DOUBLE_EQ(light.pushed_out_mm, 0.1);
}

TEST(PressedNumbers, HaveNoWidthWhereTheTableEndsBefore) {
  const LayeredTable table = dent();
  const PressedNumbers deep = numbersOf(table, table.shapes[1]);
  EXPECT_FALSE(deep.half_radius_mm.has_value());
  EXPECT_EQ(deep.bulge_mm, 0.0);
  EXPECT_EQ(deep.pushed_out_mm, 0.0);
}

TEST(PressedNumbers, LieBetweenTheStoredDepths) {
  const LayeredTable table = dent();
  const PressedShape shape = shapeAt(table, 3.0);
  EXPECT_EQ(shape.depth_mm, 3.0);
  EXPECT_DOUBLE_EQ(shape.surface_mm, 2.75);
  EXPECT_DOUBLE_EQ(shape.force_n, 0.9);
  EXPECT_DOUBLE_EQ(shape.down[1], 0.65);
  EXPECT_DOUBLE_EQ(shape.outward[1], 0.025);
  EXPECT_EQ(shapeAt(table, 6.0).force_n, 2.4);
  EXPECT_EQ(shapeAt(table, 1.0).force_n, 0.4) << "the lightest that is known";
  EXPECT_EQ(shapeAt(table, 9.0).force_n, 2.4) << "the deepest";
}

TEST(PressedNumbers, NameAStackByItsSheets) {
  EXPECT_EQ(formatStack(dent().stack), "2 x 150 + 8 x 10.5");
  EXPECT_EQ(formatStack(LayerStack{}), "layers unknown");
}

}  // namespace
}  // namespace palpate::tissue
