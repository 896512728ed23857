// The pipeline of 2008 gives back what was drawn, and shows it.
#include "palpate/view/layers/immediate_drawing.h"

#include <gtest/gtest.h>

#include <array>

#include "support/error_message.h"

namespace palpate::view {
namespace {

const Eigen::AlignedBox3d kBox(Vec3(-10, -10, 0), Vec3(10, 10, 5));

void drawSquare() {
  for (const auto& [x, y] :
       std::array<std::array<double, 2>, 6>{{{-5, -5}, {5, -5}, {5, 5}, {-5, -5}, {5, 5}, {-5, 5}}}) {
    ImmediateDrawing::corner(Vec3::UnitZ(), Vec3(x, y, 2.0));
  }
}

TEST(ImmediateDrawing, CapturesEachTriangleOnce) {
  ImmediateDrawing drawing(kBox, 40, 40);
  EXPECT_EQ(drawing.capture(2, drawSquare), 2u);
  EXPECT_EQ(drawing.capture(1000,
                            [] {
                              for (int i = 0; i < 500; ++i) drawSquare();
                            }),
            1000u);
}

TEST(ImmediateDrawing, SaysWhenMoreIsDrawnThanThereIsRoomFor) {
  ImmediateDrawing drawing(kBox, 40, 40);
  EXPECT_NE(support::thrownMessage([&] {
              drawing.capture(1, [] {
                for (int i = 0; i < 50; ++i) drawSquare();
              });
            }).find("more triangles"),
            std::string::npos);
}

TEST(ImmediateDrawing, PaintsALitSquareOnWhite) {
  ImmediateDrawing drawing(kBox, 40, 40);
  drawing.paint(drawSquare);
  const Image image = drawing.read();
  EXPECT_EQ(image.at(2, 2), (Pixel{255, 255, 255}));
  const Pixel skin = image.at(20, 20);
  EXPECT_GT(skin[0], skin[2]) << "skin is redder than blue";
  EXPECT_LT(skin[2], 200);
  EXPECT_FALSE(drawing.renderer().empty());
}

}  // namespace
}  // namespace palpate::view
