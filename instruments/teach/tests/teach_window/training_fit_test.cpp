// Every screen of the training window in each language in the smallest window that is promised, 640x480: no text is cut
// and none lies over another. tools/check-translations counts the lines "overflow: ...".
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <iostream>
#include <set>

#include "palpate/base/language.h"
#include "palpate/training/session/lump_session.h"
#include "palpate/window/gui.h"
#include "session_words.h"
#include "teach/window/training_painting.h"
#include "training_seat.h"
#include "view/tests/viewer/text_fit.h"

namespace palpate::viewer {
namespace {

using training::Screen;
using training::SessionKind;

constexpr const char* kCodeOfSomebody = "7Q2MK-9DX4A";

/// What is left of the window beside the column of buttons, points.
constexpr float kRoomOfBody = kSeatWidth - kTrainingColumn;

struct NamedScreen {
  std::string name;
  TrainingScreen screen;
};
using Screens = std::vector<NamedScreen>;

TrainingView frontDesk(TrainingStage stage) {
  TrainingView view;
  view.stage = stage;
  view.typed = view.code = kCodeOfSomebody;
  view.device = "Geomagic Touch (OpenHaptics)";
  return view;
}

/// Of somebody with this past, who may do everything that the protocol knows.
Screens choices(const training::Protocol& protocol) {
  constexpr std::int64_t kDay = 86'400'000;
  Screens screens;
  TrainingPast past;
  const auto add = [&](const char* name, std::int64_t now_ms) {
    TrainingView view = frontDesk(TrainingStage::choice);
    view.offers = offersFor(past, protocol, now_ms);
    view.notice = tr("Saved.");
    screens.push_back({name, makeTrainingScreen(view)});
  };
  add("choice of a beginner", 0);
  past.kinds[SessionKind::pre_test] = {.finished = 1};
  past.kinds[SessionKind::practice] = {.finished = 2, .interrupted = true};
  add("choice with an interrupted block", 0);
  past.kinds[SessionKind::post_test] = {.finished = 1, .last_ms = kDay};
  add("choice with days to wait", 3 * kDay);
  return screens;
}

Screens frontDeskScreens() {
  Screens screens;
  const std::vector<std::pair<const char*, TrainingStage>> stages = {
      {"sign in", TrainingStage::sign_in},   {"new code", TrainingStage::new_code},
      {"own code", TrainingStage::own_code}, {"what is kept", TrainingStage::consent},
      {"hand", TrainingStage::hand},         {"thimble", TrainingStage::thimble}};
  for (const auto& [name, stage] : stages) screens.push_back({name, makeTrainingScreen(frontDesk(stage))});
  TrainingView wrong = frontDesk(TrainingStage::sign_in);
  wrong.notice = tr("This is not a code. Check each letter, then try again.");
  screens.push_back({"typing error", makeTrainingScreen(wrong)});
  wrong.typed.clear();
  screens.push_back({"empty code", makeTrainingScreen(wrong)});
  for (const training::Protocol& protocol : {training::builtInProtocol(), training::builtInLumpProtocol()}) {
    for (NamedScreen& choice : choices(protocol)) screens.push_back(std::move(choice));
  }
  const std::vector<std::pair<const char*, TrainingOver>> over = {{"paused", TrainingOver::paused},
                                                                  {"leaving", TrainingOver::leaving},
                                                                  {"trouble", TrainingOver::trouble},
                                                                  {"message", TrainingOver::message}};
  for (const auto& [name, which] : over) {
    TrainingView view = frontDesk(TrainingStage::session);
    view.over = which;
    view.trouble = "/home/class/palpate.results: the disk is full";
    view.message = "Please stop after this block and come to the front.";
    screens.push_back({name, makeTrainingScreen(view)});
  }
  return screens;
}

/// From the device check to the end, every second answer wrong, by mouse and by a device that gives half of the forces.
Screens sessionScreens(SessionKind kind) {
  Screens screens;
  WordsOfSession somebody(kind, false);
  std::set<std::string> seen;
  const auto add = [&](const std::string& name) {
    for (const bool by_mouse : {true, false}) {
      somebody.by_mouse = by_mouse;
      const TrainingScreen screen = somebody.screen(somebody.session.asks() ? 12 : 0, by_mouse ? 1.0 : 0.52, 2.0);
      screens.push_back({name + (by_mouse ? "" : ", device"), screen});
    }
  };
  for (int step = 0; step < 400; ++step) {
    const Screen at = somebody.session.screen();
    std::string name = fmt::format("{}, {}", wordFor(kind), wordFor(at));
    if (at == Screen::feedback) name += somebody.session.trials().back().correct ? ", right" : ", wrong";
    if (seen.insert(name).second) add(name);
    if (at == Screen::finished) return screens;
    if (at != Screen::free_exploration) somebody.pressAll();
    if (somebody.session.asks()) {
      somebody.answer(step % 2 == 0 || at == Screen::familiarisation);
    } else if (at == Screen::block_summary) {
      somebody.session.leave({.s = somebody.s});
    } else {
      somebody.session.next({.s = somebody.s});
    }
  }
  ADD_FAILURE() << wordFor(kind) << ": did not come to its end";
  return screens;
}

/// All bodies: the questions, the feedback of right and wrong answers, the summary.
Screens lumpScreens(SessionKind kind) {
  static const training::Protocol protocol = training::builtInLumpProtocol();
  static const training::SiteSet sites = training::twelveSites(smallTorso()->body->anatomy.landmarks);
  static const auto bodies = std::make_shared<const training::LumpBodies>(smallTorso(), protocol, sites);
  training::SessionPlan plan;
  plan.protocol = protocol;
  plan.kind = kind;
  plan.bodies = bodies;
  plan.sites = sites;
  plan.row.id = "018f3c1e-0000-7000-8000-000000000001";
  training::LumpSession session(plan, {});
  Screens screens;
  std::set<std::string> seen;
  double s = 0.0;
  while (session.screen() != Screen::finished && s < 1000.0) {
    const training::Moment now{.s = s += 1.0};
    const auto named = session.named().size();
    const bool on_body = session.screen() == Screen::trial || session.screen() == Screen::feedback;
    TrainingView view{.stage = TrainingStage::session, .code = kCodeOfSomebody, .by_mouse = true, .lumps = &session};
    view.touched = true;
    view.named = named;
    view.marks = !on_body ? 0 : std::max(named + session.shown().size(), std::size_t{1});
    if (seen.insert(session.said().text).second) {
      screens.push_back({fmt::format("{}, {}", wordFor(kind), session.said().text), makeTrainingScreen(view)});
    }
    if (session.screen() != Screen::trial) {
      session.next(now);
    } else if (session.question() != lumps::LumpQuestion::place) {
      session.answer(session.bodyNumber() % 3 == 0 ? 0 : 1, now);
    } else if (named == 2 && session.isExam()) {
      session.noMore(now);
    } else {
      const bool right = session.bodyNumber() % 2 == 0 && named < session.hidden().size();
      session.answer(right ? Vec2(session.hidden()[named].place_mm) : Vec2(900.0, 900.0), now);
    }
  }
  EXPECT_EQ(session.screen(), Screen::finished);
  return screens;
}

class TrainingTranslations : public testing::TestWithParam<const char*> {
 protected:
  TrainingTranslations() { gui_.useLargeLetters(); }
  void SetUp() override { useLanguage(GetParam()); }
  void TearDown() override { useLanguage("en"); }

  void expectFit(const Screens& screens) {
    EXPECT_GT(screens.size(), 3u);
    for (const NamedScreen& screen : screens) {
      for (int i = 0; i < 3; ++i) paint(screen.screen);  // a card knows its height after a frame
      expectTextsFit(GetParam(), screen.name);
      if (screen.screen.place == TrainingPlace::body) expectWordsBesideTheColumn(screen.name);
    }
  }

 private:
  void paint(const TrainingScreen& screen) {
    gui_.begin(Vec2(kSeatWidth, kSeatHeight), 1.0, 1.0 / 60.0, {});
    std::vector<SeenSite> seen;
    for (int i = 0; i < 12; ++i) seen.push_back({.at = placeOf(i), .tag_left = i < 6});
    paintTraining(screen, seen);
    gui_.end();
  }
  /// As the camera sees the twelve in a window of this size.
  static Vec2 placeOf(int i) { return {i < 6 ? 155.0 : 185.0, 140.0 + 50.0 * (i % 6)}; }

  /// What is written over the body is not covered by the column of buttons.
  static void expectWordsBesideTheColumn(const std::string& name) {
    for (const DrawnText& text : collectDrawnTexts(*ImGui::GetBackgroundDrawList())) {
      const bool fits = text.low.x >= 0.0f && text.high.x <= kRoomOfBody;
      if (!fits) std::cout << "overflow: " << GetParam() << ", " << name << ", mark: \"" << text.words << "\" is cut\n";
      EXPECT_TRUE(fits) << name << ": " << text.words;
    }
  }

  const view::OffscreenContext context_;
  window::Gui gui_;
};

TEST_P(TrainingTranslations, OfSignInOffersAndQuestionsFit) { expectFit(frontDeskScreens()); }

TEST_P(TrainingTranslations, OfEverySittingFit) {
  for (const SessionKind kind : {SessionKind::practice, SessionKind::mastery, SessionKind::pre_test, SessionKind::exam,
                                 SessionKind::retention, SessionKind::free}) {
    expectFit(sessionScreens(kind));
  }
}

TEST_P(TrainingTranslations, OfSittingsWithLumpsFit) {
  for (const SessionKind kind : {SessionKind::lump, SessionKind::lump_exam}) expectFit(lumpScreens(kind));
}

INSTANTIATE_TEST_SUITE_P(Of, TrainingTranslations, testing::Values("en", "de", "es"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace palpate::viewer
