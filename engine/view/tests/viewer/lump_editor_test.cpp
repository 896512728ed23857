// Lumps are placed by hand and by words, changed by the wheel and the panel, and taken back.
#include "view/viewer/editing/lump_editor.h"

#include <gtest/gtest.h>

#include "palpate/scene/lumps_of_body.h"
#include "stage.h"

namespace palpate::viewer {
namespace {

using window::Command;

const std::vector<body::SkinLandmark> kSpine = {{"spinous_T6", "", {2, 40, 100}, Vec3::UnitZ(), {2, 40, 92}},
                                                {"spinous_T9", "", {0, -30, 100}, Vec3::UnitZ(), {0, -30, 92}}};

struct EditedLumps {
  std::vector<scene::LumpSettings> items;
  LumpEditor editor = {};
  UiOutput output = {};

  LumpEdit edit() { return {items, editor, output, kSpine}; }
  void apply(Command::Kind kind, const Vec2& place, double amount = 0.0) {
    Command command;
    command.kind = kind;
    command.amount = amount;
    applyEdit(command, place, edit());
  }
};

TEST(LumpEditor, PlacesOneWhereTheSkinIsFreeAndMovesOneThatIsThere) {
  EditedLumps edited{{}};
  edited.apply(Command::Kind::edit_grab, {-51.4, -30.2});
  edited.apply(Command::Kind::edit_drop, {-51.4, -30.2});
  ASSERT_EQ(edited.items.size(), 1u);
  EXPECT_EQ(edited.items[0].at, "T9 left 51 mm") << "in words, to the whole millimetre";
  EXPECT_EQ(edited.items[0].name, "lump1");
  EXPECT_EQ(edited.output.changed, kMapChange);
  EXPECT_EQ(edited.output.step, "place lump lump1");
  edited.apply(Command::Kind::edit_grab, {-47.0, -28.0});
  edited.apply(Command::Kind::edit_move, {34.0, 40.0});
  edited.apply(Command::Kind::edit_drop, {34.0, 40.0});
  ASSERT_EQ(edited.items.size(), 1u) << "it was grabbed";
  EXPECT_EQ(edited.items[0].at, "T6 right 32 mm");
}

TEST(LumpEditor, NamesNoTwoLumpsAlike) {
  EditedLumps edited{{}};
  placeAt(edited.edit(), body::placeNamed(kSpine, "T6"));
  placeAt(edited.edit(), body::placeNamed(kSpine, "T9"));
  edited.editor.selected = 0;
  deleteSelected(edited.edit());
  placeAt(edited.edit(), body::placeNamed(kSpine, "T6"));
  ASSERT_EQ(edited.items.size(), 2u);
  EXPECT_NE(edited.items[0].name, edited.items[1].name);
}

TEST(LumpEditor, SizesAndHardensByTheWheelWithinWhatScenesTake) {
  EditedLumps edited{{scene::LumpSettings{.name = "a"}}};
  edited.editor.selected = 0;
  edited.apply(Command::Kind::edit_size, {0, 0}, 1.0);
  EXPECT_GT(edited.items[0].diameter_mm, 10.0);
  edited.apply(Command::Kind::edit_strength, {0, 0}, 1.0);
  EXPECT_GT(edited.items[0].stiffness_ratio, 5.0);
  edited.apply(Command::Kind::edit_size, {0, 0}, 1000.0);
  EXPECT_EQ(edited.items[0].diameter_mm, kMaxLumpMm);
  edited.apply(Command::Kind::edit_strength, {0, 0}, -1000.0);
  EXPECT_EQ(edited.items[0].stiffness_ratio, kMinLumpRatio);
  edited.items[0].half_axes_mm = Vec3(6.0, 6.0, 3.0);
  edited.apply(Command::Kind::edit_size, {0, 0}, 1.0);
  EXPECT_NEAR(edited.items[0].half_axes_mm->x() / edited.items[0].half_axes_mm->z(), 2.0, 1e-9) << "it keeps its form";
}

// ---- in the window

/// A torso, which has bones and so layers.
scene::Scene torsoScene() {
  scene::Scene scene = scene::parse("[[finger]]\nname = \"a\"\nscript = [{ do = \"lift\" }]\n", "torso.toml");
  scene.file.clear();
  scene.body.kind = scene::BodyKind::torso;
  scene.body.triangles = 8163;
  return scene;
}

class LumpWindow : public testing::Test {
 protected:
  LumpWindow() {
    stage.click("panel/Touch");
    stage.click("panel/Lumps");
  }
  bool hasLumps(std::size_t count) {
    return stage.until([&] { return stage.viewer->world().lumps.size() == count; });
  }

  Stage stage{torsoScene()};
};

TEST_F(LumpWindow, ALumpIsPlacedOnTheBodyFeltAndTakenBack) {
  stage.click("lumps/edit");
  ASSERT_TRUE(stage.state().lump_editor.active);
  const Vec2 beside = stage.middle() + Vec2(70.0, 0.0);
  stage.move(beside);
  stage.button(true);
  stage.button(false);
  ASSERT_EQ(stage.state().scene.lumps.size(), 1u);
  EXPECT_TRUE(hasLumps(1));
  EXPECT_FALSE(stage.state().scene.lumps[0].at.empty()) << "in words";
  stage.key(window::key('Z'), {true, false});
  EXPECT_TRUE(stage.state().scene.lumps.empty());
  EXPECT_TRUE(hasLumps(0));
  stage.key(window::key('Z'), {true, true});
  EXPECT_TRUE(hasLumps(1));
  stage.move(beside);  // chosen again: taking back forgets what was selected
  stage.button(true);
  stage.button(false);
  stage.key(window::Key::delete_key);
  EXPECT_TRUE(hasLumps(0));
  stage.key(window::Key::escape);
  EXPECT_FALSE(stage.state().editing());
}

TEST_F(LumpWindow, OneEditorIsOpenAtATime) {
  stage.click("lumps/edit");
  stage.click("panel/Dysfunctions");
  stage.click("dysfunctions/edit");
  stage.frame();
  EXPECT_TRUE(stage.state().editor.active);
  EXPECT_FALSE(stage.state().lump_editor.active);
}

TEST_F(LumpWindow, OneThatReachesTheBoneIsRefusedAndTheBodyStays) {
  scene::LumpSettings deep;
  deep.name = "deep";
  deep.x_mm = 40.0;
  deep.y_mm = 20.0;
  deep.depth_mm = 55.0;
  stage.state().scene.lumps = {deep};
  stage.state().output.changed |= kMapChange;
  EXPECT_TRUE(stage.until([&] { return stage.state().messages.toast(stage.now_s) != nullptr; }));
  EXPECT_TRUE(stage.viewer->world().lumps.empty());
  stage.state().scene.lumps[0].depth_mm = 4.0;
  stage.state().output.changed |= kMapChange;
  EXPECT_TRUE(hasLumps(1));
}

TEST_F(LumpWindow, ASwellingRaisesTheSkinUnderTheEyeThatStays) {
  scene::LumpSettings swollen;
  swollen.name = "swollen";
  swollen.x_mm = 40.0;
  swollen.y_mm = 20.0;
  swollen.depth_mm = 4.0;
  swollen.diameter_mm = 12.0;
  stage.state().scene.lumps = {swollen};
  stage.state().output.changed |= kMapChange;
  ASSERT_TRUE(hasLumps(1));
  stage.state().camera.distance_mm *= 0.5;
  stage.frame();
  const double distance = stage.state().camera.distance_mm;
  const double height = stage.viewer->world().lumps[0]->lump.foot.z();
  stage.state().scene.lumps[0].raise_mm = 8.0;
  stage.state().output.changed |= kMapChange;
  EXPECT_TRUE(stage.until([&] { return stage.viewer->world().lumps[0]->lump.foot.z() > height + 3.0; }))
      << (stage.state().building ? stage.state().building->stage : "idle");
  EXPECT_EQ(stage.state().camera.distance_mm, distance);
}

}  // namespace
}  // namespace palpate::viewer
