#include "view/viewer/files/scene_snippet.h"

#include <gtest/gtest.h>

namespace palpate::viewer {
namespace {

TEST(ViewText, ReadsBackTheSame) {
  view::Camera camera;
  camera.centre = Vec3(1.5, -20, 300);
  camera.yaw_rad = -2.0;
  camera.pitch_rad = 0.7;
  camera.distance_mm = 812.5;
  const auto read = viewFromText(viewAsText(camera));
  ASSERT_TRUE(read);
  EXPECT_LT((read->eye() - camera.eye()).norm(), 0.01);
}

TEST(ViewText, RefusesWhatIsNoView) {
  for (const char* text : {"", "hello", "palpate-view 1 2 3", "palpate-view 0 0 0 0 0 nan 30",
                           "palpate-view 0 0 0 0 0 -5 30", "palpate-view 0 0 0 0 95 500 30"}) {
    EXPECT_FALSE(viewFromText(text)) << text;
  }
}

}  // namespace
}  // namespace palpate::viewer
