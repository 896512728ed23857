// Sittings with lumps in the training window: what hides, what shows, and that all of it goes by keys.
#include <gtest/gtest.h>

#include "support/temporary_folder.h"
#include "training_seat.h"

namespace palpate::viewer {
namespace {

class LumpWindow : public testing::Test {
 protected:
  /// Practice whose every body has a lump, in its first body.
  static training::Protocol withLumps() {
    training::Protocol protocol = training::builtInLumpProtocol();
    protocol.lump->empty_share = 0.0;
    return protocol;
  }
  static void start(TrainingSeat& stage) {
    stage.comeIn();
    ASSERT_NE(stage.training->lumpSession(), nullptr) << stage.words();
    stage.key(window::Key::enter);
    ASSERT_TRUE(stage.settled());
  }

  const support::TemporaryFolder folder;
  const std::filesystem::path records = folder / "class.results";
};

TEST_F(LumpWindow, AnExaminationWithLumpsHidesThemAndKeepsEveryAnswer) {
  TrainingSeat stage(records, training::SessionKind::lump_exam, training::builtInLumpProtocol());
  stage.comeIn();
  ASSERT_NE(stage.training->lumpSession(), nullptr) << stage.words();
  const training::LumpSession& session = *stage.training->lumpSession();
  stage.key(window::Key::enter);  // Start
  ASSERT_TRUE(stage.settled());
  ASSERT_EQ(session.screen(), training::Screen::trial);
  EXPECT_EQ(stage.viewer->world().scene.lumps.size(), 3U) << "in the body";
  EXPECT_TRUE(stage.training->screen().sites.empty()) << "and on no screen";
  EXPECT_FALSE(stage.training->screen().buttons.front().enabled) << "nothing was touched yet: Here means nothing";
  stage.key(window::Key::tab);
  stage.key(window::Key::enter);  // No more lumps
  ASSERT_TRUE(stage.settled());
  EXPECT_EQ(session.bodyNumber(), 2);
  ASSERT_EQ(trialsIn(records).size(), 1U) << "before the next screen, not at the end";
  EXPECT_FALSE(trialsIn(records).front().lumps.empty());
  stage.viewer->finish();
}

TEST_F(LumpWindow, PracticeWithLumpsShowsInItsFeedbackWhereTheLumpLies) {
  training::Protocol protocol = training::builtInLumpProtocol();
  protocol.lump->empty_share = 0.0;
  TrainingSeat stage(records, training::SessionKind::lump, protocol);
  stage.comeIn();
  ASSERT_NE(stage.training->lumpSession(), nullptr) << stage.words();
  stage.key(window::Key::enter);
  ASSERT_TRUE(stage.settled());
  EXPECT_TRUE(stage.training->screen().sites.empty());
  stage.key(window::Key::enter);  // no lump
  ASSERT_EQ(stage.training->lumpSession()->screen(), training::Screen::feedback) << stage.words();
  ASSERT_EQ(stage.training->screen().sites.size(), 1U);
  EXPECT_TRUE(stage.training->screen().sites.front().is_true);
  EXPECT_NE(stage.words().find("There was one"), std::string::npos) << stage.words();
  stage.viewer->finish();
}

TEST_F(LumpWindow, APlaceIsNamedWithTheKeyboardAlone) {
  TrainingSeat stage(records, training::SessionKind::lump_exam, training::builtInLumpProtocol());
  start(stage);
  const training::LumpSession& session = *stage.training->lumpSession();
  for (int i = 0; i < 12; ++i) stage.key(window::Key::left);
  EXPECT_TRUE(stage.training->screen().sites.empty()) << "the finger is over the skin, not on it";
  stage.key(window::key('T'));
  ASSERT_TRUE(stage.until([&] { return stage.training->screen().buttons.front().enabled; }));
  const Vec3 first = stage.viewer->state().fingers[0].proxy;
  EXPECT_LT(first.x(), -30.0) << "twelve steps of about 5 mm to the patient's left";
  for (int i = 0; i < 4; ++i) stage.key(window::Key::up);
  ASSERT_TRUE(stage.until([&] { return stage.viewer->state().fingers[0].proxy.y() > first.y() + 10.0; }))
      << "it strokes the skin";
  stage.key(window::Key::enter);  // Here
  ASSERT_EQ(session.named().size(), 1U);
  EXPECT_LT(session.named().front().place_mm->x(), -30.0);
  EXPECT_TRUE(stage.until([&] { return stage.viewer->state().fingers[0].depth_mm == 0.0; })) << "and lifts";
  stage.viewer->finish();
}

TEST_F(LumpWindow, WhileItIsPausedThereIsNothingToBeFoundAndTheQuestionStays) {
  TrainingSeat stage(records, training::SessionKind::lump_exam, training::builtInLumpProtocol());
  start(stage);
  const training::LumpSession& session = *stage.training->lumpSession();
  stage.key(window::key('P'));
  ASSERT_TRUE(stage.settled());
  EXPECT_TRUE(session.paused());
  EXPECT_TRUE(stage.viewer->world().scene.lumps.empty());
  EXPECT_NE(stage.words().find("Paused."), std::string::npos) << stage.words();
  stage.key(window::key('P'));
  ASSERT_TRUE(stage.settled());
  EXPECT_FALSE(session.paused());
  EXPECT_EQ(stage.viewer->world().scene.lumps.size(), 3U);
  EXPECT_EQ(session.question(), lumps::LumpQuestion::place);
  EXPECT_EQ(session.bodyNumber(), 1);
  stage.viewer->finish();
}

TEST_F(LumpWindow, TheMouseShowsHowFarItSinksAndNothingOfTheLumps) {
  for (const auto kind : {training::SessionKind::lump, training::SessionKind::lump_exam}) {
    TrainingSeat stage(folder / (std::string(wordFor(kind)) + ".results"), kind, withLumps());
    stage.comeIn();
    EXPECT_NE(stage.words().find("need a device"), std::string::npos) << stage.words();
    stage.key(window::Key::enter);
    ASSERT_TRUE(stage.settled());
    EXPECT_TRUE(stage.training->screen().shows_sink);
    EXPECT_NE(stage.words().find("fewer rings"), std::string::npos) << stage.words();
    view::PictureSettings picture;
    stage.training->adjust(picture);
    EXPECT_TRUE(picture.look.lens);
    EXPECT_FALSE(picture.look.shows(view::Overlay::lumps));
    for (int i = 0; i < 12; ++i) stage.key(window::Key::left);
    stage.key(window::key('T'));
    EXPECT_TRUE(stage.until([&] {
      return !stage.training->marks(stage.viewer->world(), stage.viewer->state()).empty();
    })) << "rings";
    stage.viewer->finish();
  }
}

TEST_F(LumpWindow, AHandThatFeelsIsNotHelpedByTheEye) {
  TrainingSeat stage(records, training::SessionKind::lump_exam, training::builtInLumpProtocol());
  start(stage);
  const TrainingView view{.stage = TrainingStage::session, .by_mouse = false, .lumps = stage.training->lumpSession()};
  EXPECT_FALSE(makeTrainingScreen(view).shows_sink);
  stage.viewer->finish();
}

bool showsPressure(const TrainingSeat& stage) {
  view::PictureSettings picture;
  picture.look.overlays.set();
  stage.training->adjust(picture);
  EXPECT_FALSE(picture.look.shows(view::Overlay::lumps));
  EXPECT_FALSE(picture.look.shows(view::Overlay::cut));
  EXPECT_EQ(picture.labels.beneath, picture.look.shows(view::Overlay::pressure));
  return picture.look.shows(view::Overlay::pressure);
}

TEST_F(LumpWindow, PressuresAreSeenInPracticeAsTheProtocolSaysAndInNoExamination) {
  training::Protocol protocol = withLumps();
  {
    TrainingSeat stage(records, training::SessionKind::lump, protocol);
    start(stage);
    EXPECT_FALSE(showsPressure(stage)) << "before the answer";
    stage.key(window::Key::enter);  // no lump
    ASSERT_EQ(stage.training->lumpSession()->screen(), training::Screen::feedback);
    EXPECT_TRUE(showsPressure(stage));
    stage.viewer->finish();
  }
  protocol.id = "seen";
  protocol.lump->pad_shown = true;
  for (const auto kind : {training::SessionKind::lump, training::SessionKind::lump_exam}) {
    TrainingSeat stage(folder / (std::string(wordFor(kind)) + ".results"), kind, protocol);
    start(stage);
    EXPECT_EQ(showsPressure(stage), kind == training::SessionKind::lump);
    stage.key(window::key('P'));
    EXPECT_FALSE(showsPressure(stage)) << "a pause shows nothing";
    stage.viewer->finish();
  }
}

}  // namespace
}  // namespace palpate::viewer
