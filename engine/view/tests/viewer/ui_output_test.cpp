// What a panel asks for when its controls are used: no viewer, no servo and no session is there.
#include "view/viewer/state/requests.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include "palpate/view/offscreen.h"
#include "view/viewer/panels/gui_layout.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {
namespace {

/// A window with one panel in it, and a mouse.
class OnePanel {
 public:
  template <class Draw>
  void frame(const Draw& draw, const std::vector<window::InputEvent>& events = {}) {
    gui_.begin(Vec2(300, 600), 1.0, 1.0 / 60.0, events);
    widgetPlaces().clear();
    ImGui::SetNextWindowPos({0.0f, 0.0f});
    ImGui::SetNextWindowSize({300.0f, 600.0f});
    if (ImGui::Begin("panel", nullptr, ImGuiWindowFlags_NoDecoration)) draw();
    ImGui::End();
    gui_.end();
  }

  /// There, down, up.
  template <class Draw>
  void click(const std::string& widget, const Draw& draw) {
    for (int i = 0; i < 3; ++i) frame(draw);  // windows that fit their contents know them after a frame
    ASSERT_TRUE(widgetPlaces().contains(widget)) << widget;
    const auto [left, top, right, below] = widgetPlaces().at(widget);
    const Vec2 at(0.5 * (left + right), 0.5 * (top + below));
    frame(draw, {{.kind = window::InputEvent::Kind::move, .at = at}});
    frame(draw, {{.kind = window::InputEvent::Kind::button, .at = at, .down = true}});
    frame(draw, {{.kind = window::InputEvent::Kind::button, .at = at, .down = false}});
    frame(draw);
  }

 private:
  const view::OffscreenContext context_;
  window::Gui gui_;
};

TEST(UiOutput, OfTheModelPanelAreARequestAndADialog) {
  OnePanel one;
  UiOutput output;
  scene::Scene scene;
  const WorldFacts world;
  bool dialog = false;
  const auto draw = [&] { modelPanel({scene, world, dialog}, output); };
  one.click("model/open", draw);
  EXPECT_TRUE(dialog);
  EXPECT_TRUE(output.requests.empty());
  one.click("model/default", draw);
  ASSERT_EQ(output.requests.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<OpenPreset>(output.requests.front()));
}

TEST(UiOutput, OfTheFormulaeChangeFidelityWholeAndOneByOne) {
  scene::Scene scene;
  UiOutput output;
  OnePanel one;
  bool open = false;
  const auto draw = [&] { modelPanel({scene, WorldFacts{}, open}, output); };
  one.click("fidelity/errata", draw);
  EXPECT_EQ(output.changed, kNothing);
  one.click("fidelity/E1", draw);
  EXPECT_TRUE(scene.fidelity.literal(Erratum::E1_anchor));
  EXPECT_FALSE(scene.fidelity.literal(Erratum::E14_location_ratio));
  EXPECT_EQ(output.changed, kMapChange);
  one.click("fidelity/E1", draw);
  EXPECT_EQ(scene.fidelity, Fidelity());
}

TEST(UiOutput, OfAChangedKeyTellWhatFollowsFromIt) {
  OnePanel one;
  UiOutput output;
  scene::Scene scene;
  TouchSettings touch;
  std::size_t active = 1;
  const auto draw = [&] { touchPanel({touch, active, scene}, output); };
  one.click("touch/resisting", draw);
  EXPECT_FALSE(touch.resisting_cursor);
  EXPECT_EQ(output.changed, kNothing) << "the scene was not touched";
  one.click("contact/force_shading", draw);
  EXPECT_EQ(output.changed, kFingerChange | kMapChange);
  one.click("touch/radius", draw);
  EXPECT_EQ(scene.fingers.size(), 2u) << "the second finger had to be added";
}

TEST(UiOutput, OfTheDysfunctionPanelCanBeTakenBack) {
  OnePanel one;
  UiOutput output;
  std::vector<maps::Dysfunction> items(2);
  Editor editor{.active = true, .selected = 1};
  const auto draw = [&] { dysfunctionPanel({{items, editor, output}, "delete dysfunction 2", ""}); };
  one.click("dysfunctions/delete", draw);
  EXPECT_EQ(items.size(), 1u);
  EXPECT_EQ(output.changed, kMapChange);
  EXPECT_EQ(output.step, "delete dysfunction 2");
  one.click("dysfunctions/undo", draw);
  one.click("dysfunctions/redo", draw);
  EXPECT_EQ(output.actions, std::vector{window::Action::undo}) << "there is nothing to redo";
}

}  // namespace
}  // namespace palpate::viewer
