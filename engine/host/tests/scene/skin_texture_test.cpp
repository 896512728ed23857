#include "palpate/scene/skin_texture.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "host/tests/scene/scene_text.h"
#include "palpate/base/text.h"
#include "palpate/scene/scene_writer.h"
#include "palpate/scene/world.h"
#include "support/mesh_bytes.h"
#include "support/mesh_zoo.h"
#include "support/temporary_folder.h"
#include "support/textured_bytes.h"

namespace palpate::scene {
namespace {

const std::string kPng = "\x89PNG\r\n\x1a\n...";

/// A folder with a sphere, its picture and a scene about them.
class SkinTextureOf : public testing::Test {
 protected:
  SkinTextureOf() {
    writeFile(folder_ / "ball.obj", support::texturedObjBytes(zoo::soup(zoo::sphere()), support::onSphere));
    writeFile(folder_ / "skin.png", kPng);
  }
  Scene parseScene(const std::string& body) const {
    return parse("[body]\nkind = \"mesh\"\n" + body + "\n" + kFinger, (folder_ / "s.toml").string());
  }
  /// What is said of a body, with the scene's folder left out.
  std::string buildError(const std::string& body) const {
    std::string message = support::thrownMessage([&] { build(parseScene(body)); });
    const std::string folder = folder_.path().string() + "/";
    for (auto at = message.find(folder); at != std::string::npos; at = message.find(folder)) {
      message.erase(at, folder.size());
    }
    return message;
  }
  support::TemporaryFolder folder_;
};

TEST_F(SkinTextureOf, ABodyLiesOnTheSkinAsItsFileSays) {
  const auto world = build(parseScene("file = \"ball.obj\"\nunit = \"cm\"\nscale = 0.5\ntexture = \"skin.png\""));
  ASSERT_TRUE(world->body->texture);
  EXPECT_EQ(world->body->texture->picture, kPng);
  const auto expected = support::cornersBy(support::onSphere, world->body->skin);
  ASSERT_EQ(world->body->texture->corners.size(), expected.size());
  for (std::size_t t = 0; t < expected.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_LT((world->body->texture->corners[t][i] - expected[t][i]).norm(), 1e-4f) << t;
    }
  }
}

TEST_F(SkinTextureOf, ABodyIsNoneUnlessItIsAskedFor) {
  EXPECT_FALSE(build(parseScene("file = \"ball.obj\""))->body->texture);
}

TEST_F(SkinTextureOf, ABodyStaysWhenOnlyTheMapsChange) {
  const auto world = build(parseScene("file = \"ball.obj\"\ntexture = \"skin.png\""));
  Scene scene = world->scene;
  scene.stiffness.constant_n_per_mm = 0.9;
  EXPECT_EQ(rebuilt(*world, scene)->body->texture, world->body->texture);
}

TEST_F(SkinTextureOf, ABodyIsWrittenWithItsScene) {
  const Scene scene = parseScene("file = \"ball.obj\"\ntexture = \"skin.png\"");
  EXPECT_NE(sceneAsToml(scene, folder_.path()).find("texture = \"skin.png\"\n"), std::string::npos);
}

TEST_F(SkinTextureOf, ABodySaysWhatIsWrongAndWhere) {
  EXPECT_EQ(buildError("file = \"ball.obj\"\ntexture = \"none.png\"").find("s.toml:4: [body] texture: none.png: "), 0u);
  EXPECT_EQ(buildError("file = \"ball.obj\"\ntexture = \"ball.obj\""),
            "s.toml:4: [body] texture: ball.obj: is neither a PNG nor a JPEG picture");
  writeFile(folder_ / "bare.obj", support::objBytes(zoo::cube(100.0)));
  EXPECT_EQ(buildError("texture = \"skin.png\"\nfile = \"bare.obj\""),
            "s.toml:3: [body] texture: bare.obj: has no texture coordinates (OBJ, glTF and GLB can)");
  writeFile(folder_ / "bare.glb", support::glbBytes(zoo::cube(0.1)));
  EXPECT_EQ(buildError("file = \"ball.obj\"\ntexture = \"bare.glb\""),
            "s.toml:4: [body] texture: bare.glb: has no base colour texture");
}

TEST_F(SkinTextureOf, ABuiltInBodyCanBeMade) {
  const std::string finger = kFinger;
  const auto world =
      build(parse("[body]\nkind = \"back\"\ntexture = \"made:9\"\n" + finger, (folder_ / "s.toml").string()));
  ASSERT_TRUE(world->body->texture && world->body->texture->made);
  const MadeSkin& made = *world->body->texture->made;
  EXPECT_EQ(made.seed, 9u);
  EXPECT_TRUE(world->body->texture->picture.empty());
  EXPECT_EQ(world->body->texture->corners.size(), world->body->skin.triangles.size());
  EXPECT_NEAR(made.size_mm.x(), 350.0, 1.0);
  EXPECT_NEAR(made.size_mm.y(), 400.0, 1.0);
  ASSERT_GE(made.spine_mm.size(), 12u);
  for (const Vec2& tip : made.spine_mm) EXPECT_NEAR(tip.x(), 175.0, 15.0);
  EXPECT_NE(sceneAsToml(world->scene, folder_.path()).find("texture = \"made:9\"\n"), std::string::npos);
}

TEST_F(SkinTextureOf, ASpineIsNamedFromAboveInEveryBuiltInBody) {
  for (const std::string kind : {"trunk", "torso", "back"}) {
    const auto world =
        build(parse("[body]\nkind = \"" + kind + "\"\ntexture = \"made\"\n" + kFinger, (folder_ / "s.toml").string()));
    const std::vector<Vec2>& spine_mm = world->body->texture->made->spine_mm;
    ASSERT_GE(spine_mm.size(), 12u) << kind;
    EXPECT_TRUE(std::ranges::is_sorted(spine_mm, std::greater<>(), [](const Vec2& tip) { return tip.y(); })) << kind;
  }
}

TEST_F(SkinTextureOf, AMadeBodyNeedsAWholeNumberAndABuiltInBody) {
  TextureSource source;
  for (const auto& [file, seed] : {std::pair{"made", std::optional<std::uint64_t>(1)},
                                   {"made:12", 12},
                                   {"skin.png", std::nullopt},
                                   {"made.png", std::nullopt}}) {
    source.file = file;
    EXPECT_EQ(madeSeed(source), seed) << file;
  }
  EXPECT_EQ(buildError("file = \"ball.obj\"\ntexture = \"made:x\""),
            "s.toml:4: [body] texture: the seed in 'made:x' must be a whole number, as in made:7");
  EXPECT_EQ(buildError("file = \"ball.obj\"\ntexture = \"made\""),
            "s.toml:4: [body] texture: made is for the trunk, the torso and the back");
}

TEST_F(SkinTextureOf, ABuiltInBodyIsSeenFromBehindInItsLeftHalfAndFromTheFrontInItsRight) {
  const auto world =
      build(parse("[body]\ntriangles = 8000\ntexture = \"skin.png\"\n" + kFinger, (folder_ / "s.toml").string()));
  ASSERT_TRUE(world->body->texture);
  ASSERT_EQ(world->body->texture->corners.size(), world->body->skin.triangles.size());
  const Eigen::AlignedBox3d box = mesh::boundingBox(world->body->skin);
  std::size_t backs = 0;
  for (std::size_t t = 0; t < world->body->skin.triangles.size(); ++t) {
    const Triangle& corners = world->body->skin.triangles[t];
    const auto at = [&](std::size_t i) { return world->body->skin.positions[corners[i]]; };
    const bool back = (at(1) - at(0)).cross(at(2) - at(0)).z() >= 0.0;
    backs += back ? 1 : 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& [across, up] =
          std::pair(world->body->texture->corners[t][i].x(), world->body->texture->corners[t][i].y());
      EXPECT_EQ(back, across <= 0.5f && !(across == 0.5f && !back)) << t;
      // From behind the person's right (+x) is on the right of a photograph, from the front on its left.
      const double right = (at(i).x() - box.min().x()) / box.sizes().x();
      EXPECT_NEAR(across, back ? 0.5 * right : 1.0 - 0.5 * right, 1e-6);
      EXPECT_NEAR(up, (at(i).y() - box.min().y()) / box.sizes().y(), 1e-6);
    }
  }
  EXPECT_GT(backs, world->body->skin.triangles.size() / 4);
  EXPECT_LT(backs, 3 * world->body->skin.triangles.size() / 4);
}

}  // namespace
}  // namespace palpate::scene
