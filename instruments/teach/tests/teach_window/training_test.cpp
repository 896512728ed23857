// The training window: its words, its keys, its door, and sessions in a viewer without a window.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>

#include "palpate/base/error.h"
#include "palpate/scene/scene_file.h"
#include "palpate/trace/database.h"
#include "palpate/trace/recording_reader.h"
#include "palpate/training/records/recording_files.h"
#include "palpate/training/records/trainee_code.h"
#include "palpate/view/offscreen.h"
#include "session_words.h"
#include "support/temporary_folder.h"
#include "support/wait_for.h"
#include "teach/window/sign_in.h"
#include "teach/window/training_keys.h"
#include "teach/window/training_mode.h"
#include "teach/window/training_words.h"
#include "teach/window/voice.h"
#include "training_seat.h"
#include "view/viewer/panels/widgets.h"
#include "view/viewer/viewer.h"

namespace palpate::viewer {
namespace {

using training::Screen;
using training::SessionKind;
using window::Key;

constexpr std::array kTests = {SessionKind::pre_test, SessionKind::post_test, SessionKind::exam,
                               SessionKind::retention};

// --- words

bool saysSomewhere(const TrainingScreen& screen, const std::string& what) {
  const std::vector<std::string> words = wordsOf(screen);
  return std::ranges::any_of(words, [&](const std::string& w) { return w.find(what) != w.npos; });
}

bool hasDigit(const std::string& words) { return words.find_first_of("0123456789") != std::string::npos; }

/// Whatever is no number of a site may have no digit.
void expectNoNumbers(const TrainingScreen& screen, int picked) {
  std::vector<std::string> words = wordsOf(screen);
  for (const SiteMark& mark : screen.sites) {
    std::erase(words, std::to_string(mark.number));
    EXPECT_FALSE(mark.is_true);
    EXPECT_FALSE(mark.is_own);
    EXPECT_TRUE(mark.word.empty()) << mark.word;
  }
  for (std::string part : words) {
    if (const auto at = part.find("site " + std::to_string(picked)); picked != 0 && at != std::string::npos) {
      part.erase(at, std::string("site ").size() + std::to_string(picked).size());
    }
    EXPECT_FALSE(hasDigit(part)) << part;
    for (const char* telling :
         {"%", "level", "Level", "correct", "Correct", "right of", "wrong", "N/mm", "threshold"}) {
      EXPECT_EQ(part.find(telling), std::string::npos) << part;
    }
  }
  EXPECT_TRUE(screen.progress.empty());
  EXPECT_EQ(screen.outcome, TrainingScreen::Outcome::none);
}

TEST(TrainingWords, ATestShowsNoNumberNoLevelAndNoPlaceOnAnyScreenUntilItIsOver) {
  for (const SessionKind kind : kTests) {
    WordsOfSession somebody(kind);
    expectNoNumbers(somebody.screen(), 0);
    somebody.session.next({});
    for (int trial = 0; trial < 12 && somebody.session.screen() == Screen::trial; ++trial) {
      expectNoNumbers(somebody.screen(), 0);
      expectNoNumbers(somebody.screen(5), 5);
      somebody.pressAll(trial % 3);
      expectNoNumbers(somebody.screen(), 0);
      somebody.answer(trial % 2 == 0);
      expectNoNumbers(somebody.screen(), 0);
      if (trial % 3 == 0) continue;
      somebody.answer(trial % 2 == 0);
    }
  }
}

TEST(TrainingWords, ADeviceThatGivesLessThanTheForcesSaysSoBeforeTheFirstTrial) {
  const WordsOfSession somebody(SessionKind::practice, false);
  ASSERT_EQ(somebody.session.screen(), Screen::device_check);
  EXPECT_TRUE(saysSomewhere(somebody.screen(0, 0.52), "52 % of every force"));
  EXPECT_FALSE(saysSomewhere(somebody.screen(0, 0.52), "Above"));
  EXPECT_TRUE(saysSomewhere(somebody.screen(0, 0.52, 2.0), "Above 2 N"));
  EXPECT_FALSE(saysSomewhere(somebody.screen(0, 1.0), "of every force"));
}

TEST(TrainingWords, TheScreenOfATestIsTheSameWhereverThePlaceIsHidden) {
  std::set<std::string> different;
  std::set<int> places;
  WordsOfSession somebody(SessionKind::pre_test);
  somebody.session.next({});
  for (int trial = 0; trial < 10; ++trial) {
    places.insert(somebody.session.hidden()->site);
    std::string all;
    for (const std::string& part : wordsOf(somebody.screen(2))) all += part + "|";
    if (trial > 0) different.insert(all);  // the first has no "Answer saved."
    somebody.pressAll();
    somebody.answer(trial % 2 == 0);
  }
  EXPECT_GT(places.size(), 3u);
  EXPECT_EQ(different.size(), 1u);
}

TEST(TrainingWords, PracticeSaysWhatWasRightAndMarksThePlace) {
  WordsOfSession somebody(SessionKind::practice);
  somebody.session.next({});
  const int truth = somebody.session.hidden()->site;
  for (const SiteMark& mark : somebody.screen().sites) EXPECT_FALSE(mark.is_true);
  somebody.pressAll();
  somebody.answer(true);
  const TrainingScreen right = somebody.screen();
  EXPECT_EQ(right.outcome, TrainingScreen::Outcome::right);
  EXPECT_TRUE(right.sites[static_cast<std::size_t>(truth) - 1].is_true);
  EXPECT_EQ(right.sites[static_cast<std::size_t>(truth) - 1].word, "your answer: right");
  EXPECT_NE(right.progress.find("1 of 1 right"), std::string::npos) << right.progress;
  somebody.session.next({});
  somebody.pressAll();
  somebody.answer(false);
  EXPECT_EQ(somebody.screen().outcome, TrainingScreen::Outcome::wrong);
}

TEST(TrainingWords, AfterAWrongAnswerBothTheOwnAndTheTruePlaceAreMarked) {
  WordsOfSession somebody(SessionKind::practice);
  somebody.session.next({});
  const int truth = somebody.session.hidden()->site;
  somebody.pressAll();
  somebody.answer(false);
  const TrainingScreen screen = somebody.screen();
  for (const SiteMark& mark : screen.sites) {
    EXPECT_EQ(mark.is_true, mark.number == truth);
    EXPECT_EQ(mark.is_own, mark.number == truth % 12 + 1);
    EXPECT_EQ(mark.word, mark.is_true ? "feel it here" : mark.is_own ? "your answer" : "");
  }
  EXPECT_TRUE(somebody.session.hidden()) << "both can be felt";
  EXPECT_TRUE(saysSomewhere(screen, "Your answer was site"));
}

TEST(TrainingWords, TheEyeIsToldWhatToWatchWhereTheMousePressesAndNobodyElse) {
  for (const SessionKind kind : {SessionKind::practice, SessionKind::pre_test, SessionKind::free}) {
    WordsOfSession somebody(kind);
    if (kind != SessionKind::free) somebody.session.next({});
    EXPECT_TRUE(somebody.screen().shows_sink);
    EXPECT_TRUE(saysSomewhere(somebody.screen(), "Right-drag turns the body"));
    somebody.by_mouse = false;
    EXPECT_FALSE(somebody.screen().shows_sink) << "a hand that feels must not be helped by the eye";
    EXPECT_FALSE(saysSomewhere(somebody.screen(), "Right-drag"));
  }
}

TEST(TrainingWords, FamiliarisationShowsTwoPlacesAndThenAsks) {
  WordsOfSession somebody(SessionKind::practice, false);
  somebody.pressAll();
  somebody.session.next({});
  const TrainingScreen shown = somebody.screen();
  ASSERT_EQ(shown.sites.size(), 2u);
  EXPECT_EQ(shown.sites[0].word, "stiffer");
  EXPECT_EQ(shown.sites[1].word, "normal");
  somebody.pressAll();
  somebody.session.next({});
  const TrainingScreen asked = somebody.screen(10);
  EXPECT_TRUE(asked.picks_sites);
  EXPECT_EQ(asked.buttons.front().label, "Answer: site 10, right");
  for (const SiteMark& mark : asked.sites) {
    EXPECT_FALSE(mark.is_true);
    EXPECT_TRUE(mark.word.empty());
  }
}

TEST(TrainingWords, AFilledDotMeansThatAPlaceWasPressedEnough) {
  WordsOfSession somebody(SessionKind::pre_test);
  somebody.session.next({});
  somebody.pressAll(4);
  for (const SiteMark& mark : somebody.screen().sites) EXPECT_EQ(mark.pressed, mark.number != 4);
}

TEST(TrainingWords, WhileTheBodyOfATrialIsMadeNothingCanBeAnswered) {
  WordsOfSession somebody(SessionKind::pre_test);
  somebody.session.next({});
  TrainingView view;
  view.stage = TrainingStage::session;
  view.session = &somebody.session;
  view.picked = 3;
  view.waiting = true;
  const TrainingScreen screen = makeTrainingScreen(view);
  EXPECT_EQ(screen.notice, kOneMoment);
  EXPECT_FALSE(screen.picks_sites);
  EXPECT_FALSE(screen.time_left);
  EXPECT_FALSE(screen.buttons.front().enabled);
}

TEST(TrainingWords, SentencesAreShort) {
  for (const SessionKind kind : {SessionKind::practice, SessionKind::pre_test}) {
    for (const Offer& offer : offersFor({}, training::builtInProtocol(), 0)) {
      EXPECT_LE(std::ranges::count(offer.line, ' '), 11) << offer.line;
    }
    WordsOfSession somebody(kind);
    EXPECT_LE(std::ranges::count(somebody.screen().title, ' '), 11);
  }
}

// --- what comes next

const Offer& suggested(const std::vector<Offer>& offers) {
  return *std::ranges::find_if(offers, [](const Offer& offer) { return offer.suggested; });
}

TEST(TrainingOffers, FollowTheCourseFromTheFirstTestToWhatHasStayed) {
  const training::Protocol protocol = training::builtInProtocol();
  constexpr std::int64_t kDay = 86'400'000;
  TrainingPast past;
  const auto next = [&](std::int64_t now_ms) { return suggested(offersFor(past, protocol, now_ms)).kind; };
  EXPECT_EQ(next(0), SessionKind::pre_test);
  past.kinds[SessionKind::pre_test].finished = 1;
  EXPECT_EQ(next(0), SessionKind::practice);
  past.kinds[SessionKind::practice] = {.finished = kPracticesOfCourse - 1};
  EXPECT_EQ(next(0), SessionKind::practice);
  past.kinds[SessionKind::practice].interrupted = true;
  past.kinds[SessionKind::practice].finished = kPracticesOfCourse;
  EXPECT_EQ(next(0), SessionKind::practice) << "what was interrupted goes on";
  past.kinds[SessionKind::practice].interrupted = false;
  EXPECT_EQ(next(0), SessionKind::post_test);
  past.kinds[SessionKind::post_test] = {.finished = 1, .last_ms = 10 * kDay};
  EXPECT_EQ(next(11 * kDay), SessionKind::exam);
  EXPECT_EQ(next(18 * kDay), SessionKind::retention);
}

TEST(TrainingOffers, WhatHasStayedCannotBeTestedBeforeItsTime) {
  const training::Protocol protocol = training::builtInProtocol();
  constexpr std::int64_t kDay = 86'400'000;
  TrainingPast past;
  const auto retention = [&](std::int64_t now_ms) {
    const auto offers = offersFor(past, protocol, now_ms);
    return *std::ranges::find(offers, SessionKind::retention, &Offer::kind);
  };
  EXPECT_FALSE(retention(100 * kDay).enabled);
  past.kinds[SessionKind::post_test] = {.finished = 1, .last_ms = 10 * kDay};
  EXPECT_FALSE(retention(16 * kDay).enabled);
  EXPECT_EQ(retention(16 * kDay).line, "Tomorrow: a week after the last test.");
  EXPECT_TRUE(retention(17 * kDay).enabled);
}

// --- the door

class TrainingDoor : public testing::Test {
 protected:
  SignIn signIn(SignInSettings settings = {}) { return {store, training::builtInProtocol(), std::move(settings)}; }
  static TrainingView seen(const SignIn& sign_in) {
    TrainingView view;
    sign_in.describe(view);
    return view;
  }
  static void agree(SignIn& sign_in) {
    sign_in.act(TrainingAct::yes, 0);
    sign_in.act(TrainingAct::yes, 0);
    sign_in.act(TrainingAct::choose, 1);
  }

  const support::TemporaryFolder folder;
  training::Store store{folder / "door.results", training::Store::Open::create_too};
};

TEST_F(TrainingDoor, TellsATypingErrorAndLetsItBeMended) {
  SignIn door = signIn();
  std::string wrong = someCode();
  wrong.back() = wrong.back() == '0' ? '1' : '0';
  door.type(wrong);
  door.act(TrainingAct::sign_in, 0);
  EXPECT_EQ(door.stage(), TrainingStage::sign_in);
  EXPECT_EQ(seen(door).notice, "This is not a code. Check each letter, then try again.");
  EXPECT_EQ(seen(door).typed, wrong);
  for (std::size_t i = 0; i < wrong.size(); ++i) door.erase();
  std::string lower = someCode();
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  door.type(lower);
  door.act(TrainingAct::sign_in, 0);
  EXPECT_EQ(door.stage(), TrainingStage::new_code);
  EXPECT_EQ(seen(door).code, someCode());
}

TEST_F(TrainingDoor, AsksAboutANewCodeAndForConsentOnce) {
  SignIn first = signIn({.code = someCode()});
  EXPECT_EQ(first.stage(), TrainingStage::new_code);
  EXPECT_TRUE(store.trainees().empty()) << "nothing is kept before there is consent";
  agree(first);
  EXPECT_EQ(first.stage(), TrainingStage::choice);
  ASSERT_EQ(store.trainees().size(), 1u);
  EXPECT_TRUE(store.trainees().front().consent);
  EXPECT_EQ(store.trainees().front().dominant_hand, "right");
  EXPECT_EQ(signIn({.code = someCode()}).stage(), TrainingStage::choice);
}

TEST_F(TrainingDoor, KeepsNothingOfWhoeverDoesNotAgree) {
  SignIn door = signIn({.code = someCode()});
  door.act(TrainingAct::yes, 0);
  EXPECT_EQ(door.stage(), TrainingStage::consent);
  door.act(TrainingAct::no, 0);
  EXPECT_EQ(door.stage(), TrainingStage::sign_in);
  EXPECT_TRUE(store.trainees().empty());
  EXPECT_TRUE(seen(door).typed.empty());
}

TEST_F(TrainingDoor, MakesACodeForWhoeverHasNone) {
  SignIn door = signIn();
  door.act(TrainingAct::make_code, 0);
  EXPECT_EQ(door.stage(), TrainingStage::own_code);
  EXPECT_EQ(training::codeTyped(seen(door).code), seen(door).code);
  door.act(TrainingAct::yes, 0);
  EXPECT_EQ(door.stage(), TrainingStage::consent);
}

TEST_F(TrainingDoor, GoesStraightToWhatWasAskedFor) {
  SignIn door = signIn({.code = someCode(), .kind = SessionKind::exam});
  agree(door);
  EXPECT_EQ(door.consumeChoice(false), SessionKind::exam);
  EXPECT_EQ(door.consumeChoice(false), std::nullopt);
  door.returnToChoice();
  EXPECT_EQ(door.stage(), TrainingStage::choice);
}

// --- keys

TEST(TrainingKeys, NoKeyOfTheWindowThatTellsSomethingGetsThrough) {
  WordsOfSession somebody(SessionKind::exam);
  somebody.session.next({});
  const std::set<window::Action> harmless = {
      window::Action::full_screen, window::Action::screenshot, window::Action::screenshot_with_pop_ups,
      window::Action::deeper,      window::Action::lighter,    window::Action::home};
  for (const window::KeyBinding& binding : window::keyTable()) {
    for (const window::Chord& chord : {binding.chord, binding.also}) {
      if (chord.key == Key::none) continue;
      const auto stroke = interpretInput(pressOf(chord.key, chord.modifiers), somebody.screen());
      if (stroke.kind != TrainingStroke::Kind::pass) continue;
      EXPECT_TRUE(harmless.contains(binding.action)) << binding.name;
    }
  }
}

TEST(TrainingKeys, EveryButtonOfEveryScreenCanBePressedWithoutAMouse) {
  for (const SessionKind kind : {SessionKind::practice, SessionKind::exam, SessionKind::free}) {
    WordsOfSession somebody(kind);
    for (int step = 0; step < 4; ++step) {
      TrainingScreen screen = somebody.screen(3);
      std::set<TrainingAct> reached;
      for (const Key key : {Key::enter, Key::space, Key::escape, window::key('P')}) {
        reached.insert(interpretInput(pressOf(key), screen).click.act);
      }
      for (const TrainingButton& button : screen.buttons) EXPECT_TRUE(reached.contains(button.act)) << button.label;
      if (somebody.session.screen() == Screen::trial) {
        somebody.pressAll();
        somebody.answer(true);
      } else {
        somebody.session.next({});
      }
    }
  }
}

TEST(TrainingKeys, EscAtTheSignInLeadsBackWhereAStartPageIs) {
  TrainingView view;
  EXPECT_EQ(interpretInput(pressOf(Key::escape), makeTrainingScreen(view)).kind, TrainingStroke::Kind::nothing);
  view.leads_back = true;
  EXPECT_EQ(interpretInput(pressOf(Key::escape), makeTrainingScreen(view)).click.act, TrainingAct::no);
}

TEST(TrainingKeys, ArrowsWalkFromPlaceToPlaceOnBothSides) {
  const training::SiteSet sites = training::flatTwelve();
  EXPECT_EQ(siteTowards(sites, 0, Vec2(0, -1)), 1);
  EXPECT_EQ(siteTowards(sites, 1, Vec2(0, -1)), 2);
  EXPECT_EQ(siteTowards(sites, 1, Vec2(0, 1)), 1) << "there is nothing above";
  EXPECT_EQ(siteTowards(sites, 3, Vec2(1, 0)), 9);
  EXPECT_EQ(siteTowards(sites, 9, Vec2(-1, 0)), 3);
  EXPECT_EQ(siteTowards(sites, 12, Vec2(0, 1)), 11);
}

TEST(TrainingKeys, FocusSkipsWhatCannotBeChosen) {
  TrainingScreen screen;
  screen.buttons = {{.act = TrainingAct::choose, .value = 0},
                    {.act = TrainingAct::choose, .value = 1, .enabled = false},
                    {.act = TrainingAct::choose, .value = 2}};
  EXPECT_EQ(interpretInput(pressOf(Key::down), screen).index, 2u);
  EXPECT_EQ(interpretInput(pressOf(Key::up), screen).index, 2u);
  screen.focus = 1;
  EXPECT_EQ(interpretInput(pressOf(Key::enter), screen).kind, TrainingStroke::Kind::nothing);
}

// --- speech

class TrainingVoice : public testing::Test {
 protected:
  /// Takes its time and writes down its last argument.
  std::string speaker(double seconds) const {
    const auto file = folder / "speaker";
    std::ofstream(file) << "#!/bin/sh\nsleep " << seconds << "\nfor last; do :; done\nprintf '%s\\n' \"$last\" >> '"
                        << (folder / "said").string() << "'\n";
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    return file.string();
  }
  std::vector<std::string> said() const {
    std::ifstream file(folder / "said");
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
  }
  static bool falls(Voice& voice) {
    return support::waitFor([&] {
      voice.advance();
      return !voice.speaks();
    });
  }

  const support::TemporaryFolder folder;
};

TEST_F(TrainingVoice, NeverWaitsAndSaysTheNewestNext) {
  Voice voice(speaker(0.3));
  const auto began = std::chrono::steady_clock::now();
  for (const char* sentence : {"one", "two", "three"}) voice.say(sentence);
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::milliseconds(200));
  ASSERT_TRUE(falls(voice));
  EXPECT_EQ(said(), (std::vector<std::string>{"one", "three"}));
}

TEST_F(TrainingVoice, GivesASentenceToNoShell) {
  Voice voice(speaker(0.0));
  voice.say("$(touch stolen); `touch stolen` \"quoted\"");
  ASSERT_TRUE(falls(voice));
  EXPECT_EQ(said(), (std::vector<std::string>{"$(touch stolen); `touch stolen` \"quoted\""}));
}

TEST_F(TrainingVoice, IsSilentWithoutAProgramAndWhenSwitchedOff) {
  Voice silent(std::nullopt);
  silent.say("nothing");
  EXPECT_FALSE(silent.speaks());
  ::setenv("PALPATE_SPEECH", "off", 1);
  EXPECT_EQ(speechProgram(), std::nullopt);
  ::setenv("PALPATE_SPEECH", "/no/such/program", 1);
  EXPECT_EQ(speechProgram(), std::nullopt);
  ::setenv("PALPATE_SPEECH", speaker(0.0).c_str(), 1);
  EXPECT_EQ(speechProgram(), (folder / "speaker").string());
  ::unsetenv("PALPATE_SPEECH");
}

TEST(TrainingSpeech, SaysSignsInWords) {
  EXPECT_EQ(asSpoken("about 18 % (13–25 %)."), "about 18 per cent (13 to 25 per cent).");
}

// --- in the window

class TrainingWindow : public testing::Test {
 protected:
  std::vector<training::TrialRow> keptTrials() const { return trialsIn(records); }

  const support::TemporaryFolder folder;
  const std::filesystem::path records = folder / "class.results";
};

TEST_F(TrainingWindow, HidesThePlaceInTheBodyBeforeTheClockOfTheTrialBegins) {
  TrainingSeat stage(records, SessionKind::practice);
  stage.comeIn();
  ASSERT_TRUE(stage.begin());
  const auto hidden = stage.session().hidden();
  const auto& dysfunctions = stage.viewer->world().scene.dysfunctions;
  ASSERT_EQ(dysfunctions.size(), 1u);
  const training::Site* site = stage.session().plan().sites.numbered(hidden->site);
  EXPECT_NEAR(dysfunctions.front().x_mm, site->place_mm.x(), 1e-9);
  EXPECT_NEAR(dysfunctions.front().y_mm, site->place_mm.y(), 1e-9);
  ASSERT_TRUE(stage.press(2));
  stage.answer(hidden->site);
  ASSERT_EQ(stage.session().screen(), Screen::feedback);
  stage.frame({pressOf(Key::space)});  // no more: the next one may have the new body
  ASSERT_TRUE(stage.training->waiting()) << "each trial has a body of its own";
  EXPECT_NE(stage.words().find(kOneMoment), std::string::npos);
  EXPECT_FALSE(stage.training->screen().time_left);
  ASSERT_TRUE(stage.settled());
  EXPECT_GT(stage.training->screen().time_left.value_or(0.0), 0.98);
}

TEST_F(TrainingWindow, InASmallWindowEverySiteAndEveryWordAboutKeysIsInSight) {
  TrainingSeat stage(records, SessionKind::practice);
  stage.comeIn();
  ASSERT_TRUE(stage.begin());
  stage.frame();
  const WidgetPlaces& places = widgetPlaces();
  constexpr float kColumnLeft = kSeatWidth - 300.0f;
  for (int site = 1; site <= 12; ++site) {
    const auto tag = places.at(fmt::format("training/tag/{}", site));
    EXPECT_GE(tag[0], 0.0f) << site;
    EXPECT_LE(tag[2], kColumnLeft) << site;
    EXPECT_GE(places.at(fmt::format("training/site/{}", site))[0], kColumnLeft) << site;
  }
  EXPECT_LE(places.at("training/keys")[3], kSeatHeight);
  EXPECT_LE(places.at("training/button/2")[3], places.at("training/keys")[1]);
}

TEST_F(TrainingWindow, KeepsEachAnswerAtOnceWithItsTicksInTheRecordingFile) {
  training::TrialRow kept;
  training::Uuid session;
  {
    TrainingSeat stage(records, SessionKind::practice);
    stage.comeIn();
    ASSERT_TRUE(stage.begin());
    ASSERT_TRUE(stage.press(2));
    stage.answer(2);
    ASSERT_EQ(keptTrials().size(), 1u) << "before the next screen, not at the end";
    kept = keptTrials().front();
    session = kept.session_id;
    stage.viewer->finish();
  }
  EXPECT_EQ(kept.site_answer, 2);
  ASSERT_EQ(kept.visits.size(), 1u);
  EXPECT_EQ(kept.visits.front().site, 2);
  training::Store store(records, training::Store::Open::existing);
  const auto row = store.sessions().front();
  EXPECT_TRUE(row.file.ends_with(".locked")) << row.file;
  EXPECT_EQ(row.device, "mouse");
  EXPECT_GT(row.end_ms, row.start_ms);
  const training::OpenedRecording opened = training::RecordingFiles(store).open(row);
  trace::RecordingReader reader(opened.file());
  EXPECT_LT(kept.file_tick_first, kept.file_tick_last);
  double peak_n = 0.0;
  reader.forEachTick({kept.file_tick_first, kept.file_tick_last}, [&](std::span<const trace::Sample> fingers) {
    for (const trace::Sample& sample : fingers) peak_n = std::max(peak_n, sample.contact.force.norm());
    return true;
  });
  EXPECT_NEAR(peak_n, kept.peak_force_n, 1e-6) << "the file has what the trial was about";
}

/// A class that notes what it is told, and whose instructor says what is put in `commands`.
struct SilentClass {
  training::ClassStation station = {
      .of = {.id = "osteo-1", .label = "osteo-1"},
      .row = {.id = training::makeUuidV7(1, {2, 3}), .name = "s01"},
      .trainee_key = {},
      .connect = [this](training::Store& store, const std::string&, const std::string&) {
        store.fillOutbox(true);
        return training::ClassLink{.felt = [](const trace::Sample&) {},
                                   .follow = [this](const training::Session* session) { follows = session != nullptr; },
                                   .publish_safety = [](const std::string&) {},
                                   .pop_command = [this]() -> std::optional<training::InstructorCommand> {
                                     if (commands.empty()) return std::nullopt;
                                     const training::InstructorCommand oldest = commands.front();
                                     commands.erase(commands.begin());
                                     return oldest;
                                   }};
      }};
  std::vector<training::InstructorCommand> commands;
  bool follows = false;
};

TEST_F(TrainingWindow, OfAClassDoesWhatItsInstructorAsks) {
  SilentClass silent;
  TrainingSeat stage(records, SessionKind::practice, training::builtInProtocol(), silent.station);
  stage.comeIn();
  ASSERT_TRUE(stage.begin());
  stage.frame();
  EXPECT_TRUE(silent.follows);
  using training::InstructorAct;
  silent.commands = {{InstructorAct::pause, ""}};
  stage.frames(2);
  EXPECT_TRUE(stage.session().paused());
  silent.commands = {{InstructorAct::go_on, ""}};
  stage.frames(2);
  EXPECT_FALSE(stage.session().paused());
  silent.commands = {{InstructorAct::message, "more slowly, please"}};
  stage.frames(2);
  EXPECT_NE(stage.words().find("more slowly, please"), std::string::npos) << stage.words();
  silent.commands = {{InstructorAct::next_block, ""}};
  stage.frames(2);
  EXPECT_EQ(stage.training->session(), nullptr);
  EXPECT_FALSE(silent.follows);
}

TEST_F(TrainingWindow, OfAClassSaysAnewWhoSitsAndForHowLongThingsAreKept) {
  SilentClass silent;
  silent.station.of.retain_days = 30;
  silent.station.of.retain_samples_days = 10;
  const training::TraineeRow known{training::derivePseudonym("osteo-1", someCode()), "osteo-1", 1, "left", true, ""};
  {  // was here years ago, and the class knows all of it
    training::Store store(records, training::Store::Open::create_too);
    store.save(known);
    store.fillOutbox(true);
    for (const training::OutboxEntry& entry : store.waiting(100)) store.acknowledged({&entry.row, 1});
  }
  {
    TrainingSeat stage(records, SessionKind::practice, training::builtInProtocol(), silent.station);
    ASSERT_TRUE(stage.settled());
    stage.viewer->finish();
  }
  training::Store store(records, training::Store::Open::existing);
  const training::ClassRow kept = store.classes().at(0);
  EXPECT_EQ(kept.retain_days, 30);
  EXPECT_EQ(kept.retain_samples_days, 10);
  std::vector<std::string> waiting;
  for (const training::OutboxEntry& entry : store.waiting(100)) waiting.push_back(entry.kind);
  const auto trainee = std::ranges::find(waiting, "trainee");
  EXPECT_NE(trainee, waiting.end());
  EXPECT_LT(trainee, std::ranges::find(waiting, "session")) << "before what refers to it";
}

TEST_F(TrainingWindow, GoesOnWithABlockWhereItStopped) {
  {
    TrainingSeat stage(records, SessionKind::practice);
    stage.comeIn();
    ASSERT_TRUE(stage.begin());
    stage.answer(1);
    stage.key(Key::space);
    ASSERT_TRUE(stage.settled());
    EXPECT_EQ(stage.session().trialNumber(), 2);
    stage.viewer->finish("SIGTERM");
  }
  TrainingSeat again(records);
  EXPECT_NE(again.words().find("Continues where it stopped."), std::string::npos);
  again.key(Key::enter);  // it is what is suggested
  ASSERT_TRUE(again.begin());
  EXPECT_EQ(again.session().trialNumber(), 2);
}

TEST_F(TrainingWindow, NothingIsLostWhileTheRecordCannotBeWritten) {
  TrainingSeat stage(records, SessionKind::pre_test);
  stage.comeIn();
  ASSERT_TRUE(stage.begin());
  {
    trace::Database other(records, trace::Database::Mode::write);
    other.run("BEGIN IMMEDIATE");
    stage.answer(3);
    EXPECT_TRUE(stage.training->screen().trouble);
    const auto began = Clock::now();
    stage.frame();
    EXPECT_LT(Clock::now() - began, std::chrono::milliseconds(2500)) << "the window stands still meanwhile";
    stage.key(Key::enter);
    EXPECT_TRUE(stage.training->screen().trouble) << "nothing goes on";
    other.run("COMMIT");
  }
  stage.key(Key::enter);
  EXPECT_FALSE(stage.training->screen().trouble) << stage.words();
  ASSERT_EQ(keptTrials().size(), 1u);
  EXPECT_EQ(keptTrials().front().site_answer, 3);
}

TEST_F(TrainingWindow, NothingOfTheWindowCanBeReachedThatWouldTellMoreThanTheFinger) {
  TrainingSeat stage(records, SessionKind::pre_test);
  stage.comeIn();
  ASSERT_TRUE(stage.begin());
  const std::string before = stage.words();
  for (const window::KeyBinding& binding : window::keyTable()) {
    using window::Action;
    if (binding.action == Action::cancel || binding.action == Action::quit ||
        binding.action == Action::emergency_stop || binding.action == Action::hold ||
        binding.action == Action::show_planes || binding.action == Action::show_pressure ||
        binding.action == Action::screenshot || binding.action == Action::screenshot_with_pop_ups) {
      continue;  // leaving, answering, pausing, stopping: tested by themselves
    }
    stage.key(binding.chord.key, binding.chord.modifiers);
  }
  window::InputEvent drop;
  drop.kind = window::InputEvent::Kind::drop;
  drop.text = "another.toml";
  stage.frame({drop});
  stage.frames(3);
  const ViewerState& viewer = stage.viewer->state();
  EXPECT_EQ(viewer.state.look.overlays.count(), 0u);
  EXPECT_EQ(viewer.state.look.colouring, view::Colouring::plain);
  EXPECT_FALSE(viewer.editor.active);
  EXPECT_EQ(stage.shut->reached, 0);
  EXPECT_FALSE(viewer.state.shown.help);
  EXPECT_FALSE(viewer.replay.frozen);
  EXPECT_FALSE(viewer.opening);
  for (const auto& [path, place] : widgetPlaces()) EXPECT_TRUE(path.starts_with("training/")) << path;
  EXPECT_EQ(stage.session().screen(), Screen::trial);
}

TEST_F(TrainingWindow, ShowsNoOverlayWhateverTheLookSaysNeitherLumpsNorMuscles) {
  TrainingSeat stage(records, SessionKind::pre_test);
  stage.comeIn();
  ASSERT_TRUE(stage.begin());
  view::PictureSettings picture;
  picture.look.overlays.set();
  picture.look.skin_opacity = 0.3;
  stage.training->adjust(picture);
  EXPECT_TRUE(picture.look.overlays.none());
  EXPECT_FALSE(picture.labels.beneath) << "nor a plate that says what lies there";
  EXPECT_EQ(picture.look.skin_opacity, 1.0);
}

TEST_F(TrainingWindow, InFamiliarisationTheTwoPlacesAreReachedByKeysAndTheEyeSeesTheSink) {
  TrainingSeat stage(records, SessionKind::practice);
  stage.comeIn();
  ASSERT_TRUE(stage.checkDevice());
  const auto picked = [&] {
    for (const SiteMark& mark : stage.training->screen().sites) {
      if (mark.picked) return mark.number;
    }
    return 0;
  };
  const auto shapes = [&] { return stage.training->marks(stage.viewer->world(), stage.viewer->state()).size(); };
  stage.pick(10);
  EXPECT_EQ(picked(), 10);
  stage.key(Key::left);
  EXPECT_EQ(picked(), 4) << "arrows go to the other of the two";
  stage.pick(7);
  EXPECT_EQ(picked(), 0) << "any other place is none of them";
  EXPECT_TRUE(stage.until([&] { return shapes() == 0; })) << "once the finger is up";
  stage.pick(10);
  stage.key(window::key('T'));
  ASSERT_TRUE(stage.until([&] { return stage.viewer->state().fingers[0].depth_mm > 3.0; }));
  EXPECT_EQ(shapes(), 3u) << "rings";
  view::PictureSettings picture;
  stage.training->adjust(picture);
  EXPECT_TRUE(picture.look.lens);
}

TEST_F(TrainingWindow, WhileItIsPausedThereIsNothingToBeFound) {
  TrainingSeat stage(records, SessionKind::pre_test);
  stage.comeIn();
  ASSERT_TRUE(stage.begin());
  ASSERT_TRUE(stage.until([&] { return stage.training->screen().time_left.value_or(1.0) < 0.98; }));
  const double left = *stage.training->screen().time_left;
  stage.key(window::key('P'));
  ASSERT_TRUE(stage.settled());
  EXPECT_TRUE(stage.viewer->world().scene.dysfunctions.empty());
  stage.key(window::key('P'));
  ASSERT_TRUE(stage.settled());
  EXPECT_EQ(stage.viewer->world().scene.dysfunctions.size(), 1u);
  EXPECT_FALSE(stage.session().paused());
  EXPECT_LE(stage.training->screen().time_left.value_or(1.0), left) << "a pause gives no time back";
}

TEST_F(TrainingWindow, ClosingItInABlockAsksFirst) {
  TrainingSeat stage(records, SessionKind::practice);
  stage.comeIn();
  ASSERT_TRUE(stage.begin());
  stage.viewer->state().request(Quit{});
  stage.frames(2);
  EXPECT_FALSE(stage.viewer->wantsToQuit());
  EXPECT_NE(stage.words().find("Leave now?"), std::string::npos);
  stage.key(Key::enter);  // stay
  EXPECT_EQ(stage.session().screen(), Screen::trial);
  stage.key(Key::escape);
  stage.key(Key::right);
  stage.key(Key::enter);
  EXPECT_FALSE(stage.viewer->wantsToQuit()) << "to leave a session is not to close the window";
  EXPECT_EQ(stage.training->session(), nullptr);
  stage.viewer->state().request(Quit{});
  stage.frames(2);
  EXPECT_TRUE(stage.viewer->wantsToQuit());
}

TEST_F(TrainingWindow, NeedsABodyThatHasThePlacesOfItsProtocol) {
  training::Protocol protocol = training::builtInProtocol();
  protocol.sites = {"no such place", "T6"};
  ASSERT_NE(smallTorso(), nullptr);
  EXPECT_THROW(TrainingSeat(records, SessionKind::practice, protocol), Error);
}

}  // namespace
}  // namespace palpate::viewer
