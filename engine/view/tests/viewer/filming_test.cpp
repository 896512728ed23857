// File > Save picture and Save film, by their dialogs: what is written, what is refused, how a film ends.
#include "stage.h"

#include <fstream>

#include "support/run_command.h"

namespace palpate::viewer {
namespace {

void openFromMenu(Stage& stage, const std::string& item) {
  stage.click("menu/File");
  stage.click(item);
  stage.frame();
}

void type(Stage& stage, const std::string& text) {
  for (const char letter : text) {
    window::InputEvent event;
    event.kind = window::InputEvent::Kind::text;
    event.text = std::string(1, letter);
    stage.frame({event});
  }
}

void clearField(Stage& stage, int letters) {
  stage.key(window::Key::end);
  for (int i = 0; i < letters; ++i) stage.key(window::Key::backspace);
}

TEST(SavePicture, GetsTheNameThatWasTyped) {
  Stage stage;
  stage.draws = true;
  openFromMenu(stage, "menu/Save picture");
  clearField(stage, 20);
  type(stage, "back");
  stage.key(window::Key::enter);
  for (int i = 0; i < 3; ++i) stage.frame();
  EXPECT_TRUE(std::filesystem::exists(stage.folder / "back.png")) << stage.lastMessage();
  EXPECT_FALSE(stage.state().state.shown.picture_dialog);
}

TEST(SavePicture, AsksBeforeItReplacesAFile) {
  Stage stage;
  std::ofstream(stage.folder / "back.png") << "before";
  openFromMenu(stage, "menu/Save picture");
  clearField(stage, 20);
  type(stage, "back.png");
  stage.key(window::Key::enter);
  for (int i = 0; i < 3; ++i) stage.frame();
  EXPECT_EQ(support::contentOf(stage.folder / "back.png"), "before");
  EXPECT_TRUE(stage.state().state.shown.picture_dialog);
  stage.key(window::Key::enter);
  for (int i = 0; i < 3; ++i) stage.frame();
  EXPECT_NE(support::contentOf(stage.folder / "back.png"), "before");
}

TEST(SavePicture, TakesNoOtherKind) {
  Stage stage;
  openFromMenu(stage, "menu/Save picture");
  clearField(stage, 20);
  type(stage, "back.jpg");
  stage.key(window::Key::enter);
  stage.frame();
  EXPECT_TRUE(stage.state().state.shown.picture_dialog);
  stage.key(window::Key::escape);
  EXPECT_FALSE(stage.state().state.shown.picture_dialog);
}

TEST(SaveFilm, ShowsItsTimeAndIsWholeWhenItIsStopped) {
  Stage stage;
  stage.draws = true;
  openFromMenu(stage, "menu/Save film");
  stage.key(window::Key::enter);  // film.webm
  stage.frame();
  EXPECT_TRUE(stage.state().recording.film);
  for (int i = 0; i < 75; ++i) stage.frame();
  EXPECT_TRUE(widgetPlaces().contains("menu/recording")) << "the red mark";
  EXPECT_FALSE(std::filesystem::exists(stage.folder / "film.webm"));
  openFromMenu(stage, "menu/Stop the film");
  EXPECT_FALSE(stage.state().recording.film);
  ASSERT_TRUE(stage.until([&] { return stage.lastMessage().starts_with("The film"); }));
  EXPECT_TRUE(std::filesystem::exists(stage.folder / "film.webm")) << stage.lastMessage();
}

TEST(SaveFilm, IsFinishedWhenTheWindowCloses) {
  Stage stage;
  stage.state().request(StartFilm{(stage.folder / "film.gif").string()});
  for (int i = 0; i < 20; ++i) stage.frame();
  stage.viewer->finish("done");
  EXPECT_EQ(support::contentOf(stage.folder / "film.gif").substr(0, 6), "GIF89a") << stage.lastMessage();
}

TEST(SaveFilm, GoesOnWhenTheWindowIsResized) {
  Stage stage;
  stage.state().request(StartFilm{(stage.folder / "film.webm").string()});
  for (int i = 0; i < 10; ++i) stage.frame();
  for (int i = 0; i < 10; ++i) stage.viewer->frame(700, 500, 1.0, stage.now_s += 0.1, {});
  stage.viewer->finish("done");
  EXPECT_TRUE(std::filesystem::exists(stage.folder / "film.webm")) << stage.lastMessage();
}

TEST(SaveFilm, SaysWhyItCannotBeWritten) {
  Stage stage;
  stage.state().request(StartFilm{"/dev/null/film.webm"});
  ASSERT_TRUE(stage.until([&] { return stage.lastMessage().starts_with("The film ended"); }));
  EXPECT_NE(stage.lastMessage().find("/dev/null/film.webm: cannot be written: Not a directory"), std::string::npos)
      << stage.lastMessage();
  EXPECT_FALSE(stage.state().recording.film);
}

}  // namespace
}  // namespace palpate::viewer
