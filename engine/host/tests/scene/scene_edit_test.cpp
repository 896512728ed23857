#include "palpate/scene/scene_edit.h"

#include <gtest/gtest.h>

#include "palpate/scene/scene_writer.h"
#include "support/error_message.h"

namespace palpate::scene {
namespace {

TEST(SceneEdit, ReadsAndChangesAKeyByItsName) {
  Scene scene;
  setKey(scene, "friction", "static", "0.8");
  EXPECT_EQ(scene.contact.finger.mu_static, 0.8);
  EXPECT_EQ(keyOf(scene, "friction", "static")->fallback, "0.8");
  EXPECT_EQ(defaultOf("friction", "static"), "0.46");
  setKey(scene, "", "title", "\"a back\"");
  EXPECT_EQ(scene.title, "a back");
  EXPECT_EQ(keyOf(scene, "", "title")->form.kind, KeyForm::Kind::text);
}

TEST(SceneEdit, TellsWhatAKeyTakes) {
  const auto number = keyOf({}, "deformation", "f_adj");
  ASSERT_TRUE(number);
  EXPECT_EQ(number->form.kind, KeyForm::Kind::number);
  EXPECT_EQ(number->form.high, 10.0);
  const auto choice = keyOf({}, "stiffness", "source");
  ASSERT_TRUE(choice);
  ASSERT_EQ(choice->form.kind, KeyForm::Kind::choice);
  EXPECT_EQ(choice->form.choices.front(), "auto");
  EXPECT_EQ(keyOf({}, "contact", "force_shading")->form.kind, KeyForm::Kind::flag);
  EXPECT_FALSE(keyOf({}, "friction", "nonsense"));
  EXPECT_FALSE(keyOf({}, "finger", "radius_mm")) << "which finger?";
}

TEST(SceneEdit, RefusesWhatAFileMayNotSayAndLeavesTheSceneAsItWas) {
  Scene scene;
  const std::string before = sceneAsToml(scene);
  for (const char* value : {"-1", "\"rough\"", "0.1 0.2", "]"}) {
    EXPECT_NE(support::thrownMessage([&] { setKey(scene, "friction", "static", value); }), "no error") << value;
  }
  EXPECT_NE(support::thrownMessage([&] { setKey(scene, "friction", "stick", "1"); }), "no error");
  EXPECT_NE(support::thrownMessage([&] { setKey(scene, "nowhere", "static", "1"); }), "no error");
  EXPECT_EQ(sceneAsToml(scene), before);
}

}  // namespace
}  // namespace palpate::scene
