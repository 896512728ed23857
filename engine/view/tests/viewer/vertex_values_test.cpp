// Numbers that a mesh file brings, in the window: which one is shown, and what a press reads.
#include "view/viewer/state/vertex_values.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "palpate/scene/skin_channels.h"
#include "palpate/view/scene_view.h"
#include "view/tests/viewer/stage.h"

namespace palpate::viewer {
namespace {

/// The stage's sheet with x and twice x as numbers.
void saveSheetWithNumbers(const std::filesystem::path& file) {
  const mesh::TriangleMesh sheet = zoo::wavyGrid(40, 200.0, 3.0);
  mesh::VertexChannels channels;
  channels.scalars = {{"across", {}}, {"twice", {}}};
  for (const Vec3& p : sheet.positions) {
    channels.scalars[0].values.push_back(static_cast<float>(p.x()));
    channels.scalars[1].values.push_back(static_cast<float>(2.0 * p.x()));
  }
  mesh::save(file, sheet, channels);
}

class SheetWithNumbers : public ::testing::Test {
 protected:
  void SetUp() override {
    saveSheetWithNumbers(stage_.folder / "numbers.ply");
    stage_.drop(stage_.folder / "numbers.ply");
    ASSERT_TRUE(stage_.until([&] { return state().world.channels && !state().world.channels->scalars.empty(); }));
  }
  ViewerState& state() { return stage_.state(); }

  Stage stage_;
};

TEST_F(SheetWithNumbers, APressReadsTheNearestVertex) {
  EXPECT_FALSE(state().reading);
  stage_.move(stage_.middle());
  stage_.button(true);
  stage_.button(false);
  ASSERT_TRUE(state().reading);
  const VertexReading& reading = *state().reading;
  const scene::World& world = stage_.viewer->world();
  EXPECT_EQ(reading.place, world.body->skin.positions[reading.vertex]);
  EXPECT_EQ(reading.in_file, world.body->channels->source_vertex[reading.vertex]);
  EXPECT_EQ(reading.stiffness_n_per_mm, (*world.surface.stiffness_n_per_mm)[reading.vertex]);
  ASSERT_EQ(reading.scalars.size(), 2u);
  EXPECT_EQ(reading.where, "") << "a mesh has no names";
  EXPECT_EQ(reading.scalars[1].name, "twice");
  EXPECT_EQ(reading.scalars[1].value, static_cast<float>(2.0 * reading.place.x()));
}

TEST(VertexReading, SaysThePlaceAsAnExaminerDoesAndTheBoneBelow) {
  scene::Scene scene;
  scene.body.kind = scene::BodyKind::torso;
  scene.body.triangles = 8163;
  const auto world = scene::build(scene);
  const auto& marks = world->body->anatomy.landmarks;
  const auto t6 = std::find_if(marks.begin(), marks.end(), [](const auto& m) { return m.name == "spinous_T6"; });
  ASSERT_NE(t6, marks.end());
  const VertexReading at = readVertex(*world, t6->position);
  EXPECT_EQ(at.where, "T6");
  EXPECT_EQ(at.bone, "T6");
  ASSERT_TRUE(at.bone_depth_mm);
  EXPECT_LT(*at.bone_depth_mm, 25.0);
  EXPECT_EQ(readVertex(*world, t6->position + Vec3(12, 0, 0)).where, "T6, 12 mm right");
}

TEST_F(SheetWithNumbers, TheFirstIsShownOverItsRangeAndAnotherWhenAskedFor) {
  view::Look& look = state().state.look;
  EXPECT_EQ(look.scalar, "across");
  const auto& scalars = state().world.channels->scalars;
  EXPECT_DOUBLE_EQ(look.scalar_range.low, scalars[0].least);
  EXPECT_DOUBLE_EQ(look.scalar_range.high, scalars[0].greatest);
  look.colouring = view::Colouring::scalar;
  stage_.frame();
  const view::Image first = stage_.picture();
  look.scalar_map = ColourMap::cool_warm;
  stage_.frame();
  EXPECT_NE(stage_.picture().pixels, first.pixels);
  view::showScalar(stage_.viewer->world(), "twice", look);
  EXPECT_DOUBLE_EQ(look.scalar_range.high, scalars[1].greatest);
}

}  // namespace
}  // namespace palpate::viewer
