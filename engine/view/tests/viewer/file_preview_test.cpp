// What is known of a file before it is opened, and what is asked about a mesh that says no unit.
#include "stage.h"

#include "palpate/base/text.h"
#include "view/viewer/files/file_preview.h"
#include "view/viewer/files/turned_mesh.h"

namespace palpate::viewer {
namespace {

std::size_t drawnPixels(const view::Image& picture) {
  const view::Pixel ground = picture.at(0, 0);
  return static_cast<std::size_t>(
      std::ranges::count_if(picture.pixels, [&](const view::Pixel& pixel) { return pixel != ground; }));
}

TEST(FilePreview, ShowsAMeshAndItsSize) {
  const support::TemporaryFolder folder;
  mesh::save(folder / "ball.stl", zoo::sphere(60.0, 3));
  const FilePreview preview = previewFile(folder / "ball.stl");
  EXPECT_NE(preview.words.find("triangles, 120 x 120 x 120"), std::string::npos) << preview.words;
  ASSERT_TRUE(preview.picture);
  EXPECT_GT(drawnPixels(*preview.picture), preview.picture->pixels.size() / 6);
  EXPECT_NEAR(preview.longest_units.value_or(0.0), 120.0, 1.0);
}

TEST(FilePreview, ShowsTheMeshOfASceneAndNamesABuiltInBody) {
  const support::TemporaryFolder folder;
  mesh::save(folder / "ball.ply", zoo::sphere(0.6, 3));
  writeFile(folder / "mesh.toml", "title = \"Lab\"\n[body]\nkind = \"mesh\"\nfile = \"ball.ply\"\nunit = \"m\"\n");
  const FilePreview preview = previewFile(folder / "mesh.toml");
  EXPECT_TRUE(preview.picture) << preview.words;
  EXPECT_NE(preview.words.find("1200 x 1200 x 1200 mm"), std::string::npos) << preview.words;
  EXPECT_FALSE(preview.longest_units) << "the scene says its unit";
  writeFile(folder / "built_in.toml", "title = \"Lab\"\n");
  EXPECT_EQ(previewFile(folder / "built_in.toml").words, "Lab, on a built-in body");
}

TEST(FilePreview, SaysWhatOfAMeshIsLeftOut) {
  const support::TemporaryFolder folder;
  writeFile(folder / "cut.obj", "v 0 0 0\nv 90 0 0\nv 0 90 0\nf 1 2 3\nl 1 2\nl 2 3\n");
  writeFile(folder / "cut.toml", "[body]\nkind = \"mesh\"\nfile = \"cut.obj\"\n");
  const std::vector<std::string> told = {"cut.obj: left out: lines (2)"};
  EXPECT_EQ(previewFile(folder / "cut.obj").notes, told);
  EXPECT_EQ(previewFile(folder / "cut.toml").notes, told);
}

TEST(FilePreview, SaysWhatIsWrongWithAFileAndGoesOn) {
  const support::TemporaryFolder folder;
  writeFile(folder / "broken.stl", "solid nothing\nfacet");
  EXPECT_FALSE(previewFile(folder / "broken.stl").words.empty());
  EXPECT_FALSE(previewFile(folder / "broken.stl").picture);
  EXPECT_FALSE(previewFile(folder / "missing.ply").words.empty());
  writeFile(folder / "far.obj", "v 0 0 0\nv 1e300 0 0\nv 0 1e308 0\nv nan 0 0\nf 1 2 3\nf 1 2 4\n");
  EXPECT_NO_THROW(previewFile(folder / "far.obj"));
  mesh::save(folder / "ball.ply", zoo::sphere(60.0, 4));
  const FilePreview large = previewFile(folder / "ball.ply", {.max_bytes = 1000});
  EXPECT_NE(large.words.find("too large for a preview"), std::string::npos) << large.words;
}

TEST(FilePreview, StopsWhenItsTimeIsOver) {
  // Each of them fills the picture.
  mesh::TriangleMesh mesh;
  mesh.positions = {Vec3(-1, -1, 0), Vec3(3, -1, 0), Vec3(-1, 3, 0)};
  mesh.triangles.assign(4'000'000, {0, 1, 2});
  const auto started = Clock::now();
  smallPicture(mesh, {.max_seconds = 0.05});
  EXPECT_LT(secondsSince(started), 2.0);
}

TEST(UnitGuess, AsksWhereMillimetresMakeNoBody) {
  EXPECT_EQ(unitGuess(1.8)->unit, scene::Unit::metre);
  EXPECT_EQ(unitGuess(1.8)->words, "This body is 1.8 across: metres? It would be 1.8 m long.");
  EXPECT_EQ(unitGuess(0.19)->words, "This body is 0.19 across: metres? It would be 19 cm long.");
  EXPECT_EQ(unitGuess(18.0)->unit, scene::Unit::centimetre);
  for (const double plausible : {45.0, 180.0, 720.0, 1800.0, 2900.0}) EXPECT_FALSE(unitGuess(plausible)) << plausible;
  for (const double hopeless : {0.0, -1.0, 1e-9, 1e7, std::nan("")}) EXPECT_FALSE(unitGuess(hopeless)) << hopeless;
}

TEST(UnitQuestion, ABodyInMetresIsAskedAboutBeforeItIsOpened) {
  Stage stage;
  mesh::save(stage.folder / "metres.stl", zoo::sphere(0.4, 4));
  stage.drop(stage.folder / "metres.stl");
  ASSERT_TRUE(stage.until([&] { return stage.state().question.has_value(); }));
  EXPECT_EQ(stage.state().question->words, "This body is 0.8 across: metres? It would be 80 cm long.");
  EXPECT_NE(stage.state().world.name, "metres.stl");
  stage.frame();
  stage.click("question/Metres");
  ASSERT_TRUE(stage.until([&] { return stage.state().world.name == "metres.stl"; })) << stage.lastMessage();
  EXPECT_NEAR(stage.state().world.width_mm, 800.0, 10.0);
  EXPECT_EQ(stage.state().scene.body.unit, scene::Unit::metre) << "and so it is saved";
}

TEST(UnitQuestion, MillimetresAndNothingAreAnswersToo) {
  Stage stage;
  mesh::save(stage.folder / "small.stl", zoo::sphere(15.0, 4));
  stage.drop(stage.folder / "small.stl");
  ASSERT_TRUE(stage.until([&] { return stage.state().question.has_value(); }));
  stage.key(window::Key::escape);
  EXPECT_FALSE(stage.state().question);
  stage.drop(stage.folder / "small.stl");
  ASSERT_TRUE(stage.until([&] { return stage.state().question.has_value(); }));
  stage.frame();
  stage.click("question/Millimetres");
  ASSERT_TRUE(stage.until([&] { return stage.state().world.name == "small.stl"; })) << stage.lastMessage();
  EXPECT_NEAR(stage.state().world.width_mm, 30.0, 1.0);
}

/// The lower half of a ball of 60 mm, or a sheet; both from their backs.
mesh::TriangleMesh insideOut(mesh::TriangleMesh mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}
mesh::TriangleMesh bowl() {
  mesh::TriangleMesh mesh = zoo::sphere(60.0, 4);
  std::erase_if(mesh.triangles, [&](const Triangle& t) { return mesh::centreOf(mesh, t).z() < 0.0; });
  return mesh;
}

TEST(TurnQuestion, ABodyThatMayBeInsideOutIsTurnedWhereTheUserSaysSo) {
  for (const auto& mesh : {insideOut(bowl()), insideOut(zoo::wavyGrid(30, 200.0, 3.0))}) {
    Stage stage;
    mesh::save(stage.folder / "scan.stl", mesh);
    stage.drop(stage.folder / "scan.stl");
    ASSERT_TRUE(stage.until([&] { return stage.state().question.has_value(); }));
    EXPECT_NE(stage.state().question->words.find("inside out"), std::string::npos);
    stage.frame();
    stage.click("question/Turn it over");
    ASSERT_TRUE(stage.until([&] { return stage.state().world.name == "scan_turned.ply"; })) << stage.lastMessage();
    stage.until([&] { return stage.state().question.has_value(); }, 1);
    EXPECT_FALSE(stage.state().question) << "one turned by the user is not asked about again";
    EXPECT_TRUE(std::filesystem::exists(stage.folder / "scan_turned.ply"));
    EXPECT_EQ(doubtfulSides(stage.viewer->world().body->skin, Vec3::UnitZ()), mesh::TurnOver::none);
  }
}

TEST(TurnQuestion, WhatFacesTheRightWayOrIsToStayIsLeftAsItIs) {
  for (const auto& mesh : {bowl(), zoo::wavyGrid(30, 200.0, 3.0), insideOut(zoo::sphere(60.0, 4))}) {
    EXPECT_EQ(doubtfulSides(mesh, Vec3::UnitZ()) != mesh::TurnOver::none, false);
  }
  Stage stage;
  mesh::save(stage.folder / "scan.stl", insideOut(bowl()));
  stage.drop(stage.folder / "scan.stl");
  ASSERT_TRUE(stage.until([&] { return stage.state().question.has_value(); }));
  stage.key(window::Key::escape);
  stage.until([&] { return stage.state().question.has_value(); }, 1);
  EXPECT_FALSE(stage.state().question);
  EXPECT_EQ(stage.state().world.name, "scan.stl");
  EXPECT_FALSE(std::filesystem::exists(stage.folder / "scan_turned.ply"));
}

TEST(OpenDialog, AClickShowsAFileAndASecondOneOpensIt) {
  Stage stage;
  mesh::save(stage.folder / "ball.ply", zoo::sphere(60.0, 3));
  stage.state().state.recent = {(stage.folder / "ball.ply").string()};
  stage.state().state.shown.open_dialog = true;
  stage.frame();
  stage.frame();
  stage.click("open/recent/0");
  EXPECT_TRUE(stage.until([] { return widgetPlaces().contains("open/picture"); }));
  EXPECT_TRUE(stage.state().state.shown.open_dialog);
  stage.click("open/open");
  EXPECT_FALSE(stage.state().state.shown.open_dialog);
  EXPECT_TRUE(stage.until([&] { return stage.state().world.name == "ball.ply"; })) << stage.lastMessage();
}

}  // namespace
}  // namespace palpate::viewer
