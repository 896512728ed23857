// The table [[device]]: read, refused in words, written and patched into a person's file.
#include <gtest/gtest.h>

#include "palpate/scene/scene_file.h"
#include "palpate/scene/scene_writer.h"
#include "support/error_message.h"

namespace palpate::scene {
namespace {

constexpr const char* kTwo = R"(# the desk in room 4
[[device]]
name = "openhaptics:Left"
scale = 1.5
turn_deg = [0, 90, -12.5]
origin_mm = [10, -20, 300] # beside the shoulder
clutch_button = 2

[[device]]
name = "forcedimension:0"
finger = "right"
stop_button = 1
)";

TEST(DeviceKeys, AreReadWithTheirDefaults) {
  const Scene scene = parse(kTwo, "s.toml");
  ASSERT_EQ(scene.devices.size(), 2u);
  const DeviceSettings& left = scene.devices[0];
  EXPECT_EQ(left.name, "openhaptics:Left");
  EXPECT_EQ(left.finger, HeldFinger::left);
  EXPECT_EQ(left.scale, 1.5);
  EXPECT_EQ(left.turn_deg, Vec3(0, 90, -12.5));
  ASSERT_TRUE(left.origin_mm);
  EXPECT_EQ(*left.origin_mm, Vec3(10, -20, 300));
  EXPECT_EQ(left.clutch_button, 2u);
  const DeviceSettings& right = scene.devices[1];
  EXPECT_EQ(right.finger, HeldFinger::right);
  EXPECT_EQ(right.scale, 1.0);
  EXPECT_FALSE(right.origin_mm);
  EXPECT_EQ(right.stop_button, 1u);
}

std::string refusal(const std::string& line) {
  return support::thrownMessage([&] { parse("[[device]]\nname = \"remote\"\n" + line + "\n", "s.toml"); });
}

TEST(DeviceKeys, RefuseWhatMakesNoSense) {
  EXPECT_NE(refusal("scale = 0"), "no error");
  EXPECT_NE(refusal("scale = 1e9"), "no error");
  EXPECT_NE(refusal("turn_deg = [1, 2]"), "no error");
  EXPECT_NE(refusal("clutch_button = 33"), "no error");
  EXPECT_NE(refusal("origin_mm = [nan, 0, 0]"), "no error");
  EXPECT_NE(refusal("finger = \"thumb\"").find("left"), std::string::npos) << "names the choices";
  EXPECT_NE(refusal("scael = 2").find("scale"), std::string::npos);
  EXPECT_NE(support::thrownMessage([] { parse("[[device]]\nscale = 2\n", "s.toml"); }).find("needs a name"),
            std::string::npos);
}

TEST(DeviceKeys, AreWrittenAsTheyAreReadBack) {
  const Scene scene = parse(kTwo, "s.toml");
  const std::string text = sceneAsToml(scene);
  EXPECT_EQ(sceneAsToml(parse(text, "t.toml")), text);
  EXPECT_NE(text.find("turn_deg = [0, 90, -12.5]"), std::string::npos) << text;
}

TEST(DeviceKeys, AChangedOneKeepsAPersonsWords) {
  Scene scene = parse(kTwo, "s.toml");
  scene.devices[0].scale = 2.0;
  scene.devices[1].origin_mm = Vec3(1, 2, 3);
  const auto text = patchedScene(kTwo, scene, "s.toml");
  ASSERT_TRUE(text);
  EXPECT_NE(text->find("# beside the shoulder"), std::string::npos);
  EXPECT_NE(text->find("scale = 2\n"), std::string::npos) << *text;
  const Scene again = parse(*text, "s.toml");
  ASSERT_TRUE(again.devices[1].origin_mm);
  EXPECT_EQ(*again.devices[1].origin_mm, Vec3(1, 2, 3));
}

}  // namespace
}  // namespace palpate::scene
