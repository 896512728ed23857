#include "palpate/training/session/session.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "palpate/base/error.h"
#include "teach/tests/training/twelve.h"

namespace palpate::training {
namespace {

/// Somebody who sits down, presses and answers; a clock of their own.
class Somebody {
 public:
  explicit Somebody(SessionKind kind, const Protocol& protocol = builtInProtocol(),
                    const std::optional<BlockRow>& resumed = {}, bool familiar = true)
      : session_({.protocol = protocol,
                  .kind = kind,
                  .sites = sites_,
                  .seed = 7,
                  .row = {.id = "018f3c1e-0000-7000-8000-000000000001"},
                  .resumed = resumed,
                  .familiar = familiar},
                 moment()) {
    collect();
  }

  Moment moment() const {
    return {.s = s_,
            .utc_ms = 1'790'000'000'000 + std::llround(1000.0 * s_),
            .tick = static_cast<std::uint64_t>(1000.0 * s_)};
  }
  void wait(double seconds) {
    s_ += seconds;
    session_.tick(moment());
    collect();
  }
  void press(int site, double force_n = 1.0, double seconds = 0.3) {
    for (int i = 0; i < std::lround(1000.0 * seconds); ++i) {
      s_ += 0.001;
      session_.feel(pressAt(sites_.numbered(site)->point_mm, force_n), moment());
    }
  }
  void pressAll(int but = 0) {
    for (int site = 1; site <= 12; ++site) {
      if (site != but) press(site);
    }
  }
  /// The two of familiarisation.
  void feelTwo() {
    press(session_.familiarPlaces()->first);
    press(session_.familiarPlaces()->second);
  }
  void next() {
    session_.next(moment());
    collect();
  }
  bool answer(int site) {
    const bool taken = session_.answer(site, moment());
    collect();
    return taken;
  }
  /// Right as long as `right`.
  void trial(bool right) {
    pressAll();
    const int truth = session_.hidden()->site;
    answer(right ? truth : truth % 12 + 1);
    if (session_.screen() == Screen::feedback) next();
  }
  void collect() {
    for (Row& row : session_.drainRows()) rows_.push_back(std::move(row));
  }
  template <class Kind>
  std::vector<Kind> rows() const {
    std::vector<Kind> found;
    for (const Row& row : rows_) {
      if (const Kind* one = std::get_if<Kind>(&row)) found.push_back(*one);
    }
    return found;
  }
  Session& operator*() { return session_; }
  Session* operator->() { return &session_; }

 private:
  SiteSet sites_ = flatTwelve();
  double s_ = 100.0;
  std::vector<Row> rows_;
  Session session_;
};

TEST(Session, AFirstPracticeGoesFromTheDeviceToTheSummary) {
  Protocol protocol = builtInProtocol();
  protocol.practice.block.stop = {.least = 3, .most = 3};
  Somebody trainee(SessionKind::practice, protocol, {}, false);
  EXPECT_EQ(trainee->screen(), Screen::device_check);
  trainee.next();
  EXPECT_EQ(trainee->screen(), Screen::device_check) << "goes on without a touch";
  trainee.press(5);
  trainee.next();
  EXPECT_EQ(trainee->screen(), Screen::familiarisation);
  EXPECT_EQ(trainee->hidden()->site, 4);
  EXPECT_EQ(trainee->said().text, "Site 4, left, is much stiffer. Site 10, right, is normal.");
  trainee.feelTwo();
  trainee.next();
  trainee.answer(trainee->hidden()->site);
  EXPECT_EQ(trainee->screen(), Screen::instruction);
  EXPECT_FALSE(trainee->hidden());
  trainee.next();
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(trainee->screen(), Screen::trial);
    trainee.trial(true);
  }
  EXPECT_EQ(trainee->screen(), Screen::block_summary);
  EXPECT_EQ(trainee->result()->correct, 3);
  trainee.next();
  EXPECT_EQ(trainee->screen(), Screen::instruction) << "practice goes on";
  trainee->leave(trainee.moment());
  trainee.collect();
  EXPECT_EQ(trainee->screen(), Screen::finished);
  EXPECT_EQ(trainee.rows<TrialRow>().size(), 3U);
  EXPECT_EQ(trainee.rows<BlockRow>().back().number, 2);
  EXPECT_GT(trainee.rows<SessionRow>().back().end_ms, 0);
}

TEST(Session, FeedbackTellsTheSiteAndLetsItBeFelt) {
  Somebody trainee(SessionKind::practice);
  trainee.next();
  trainee.pressAll();
  const HiddenNow truth = *trainee->hidden();
  trainee.answer(truth.site % 12 + 1);
  EXPECT_EQ(trainee->screen(), Screen::feedback);
  EXPECT_EQ(trainee->hidden(), truth);
  EXPECT_TRUE(trainee->feelsTruth());
  EXPECT_EQ(trainee->said().text.find("It was site " + std::to_string(truth.site)), 0U);
  EXPECT_FALSE(trainee.rows<TrialRow>().back().correct);
}

TEST(Session, ATestSaysOnlyThatTheAnswerIsSaved) {
  Somebody trainee(SessionKind::pre_test);
  trainee.next();
  for (const bool right : {true, false, true, false}) {
    trainee.trial(right);
    EXPECT_EQ(trainee->screen(), Screen::trial);
    EXPECT_EQ(trainee->said().text, "Answer saved.");
    EXPECT_FALSE(trainee->feelsTruth());
  }
  EXPECT_FALSE(trainee->showsProgress());
}

TEST(Session, PlacesNotPressedAreToldOnceAndThenFlagged) {
  Somebody trainee(SessionKind::pre_test);
  trainee.next();
  const int truth = trainee->hidden()->site;
  const int left_out = truth % 12 + 1;
  trainee.pressAll(left_out);
  EXPECT_FALSE(trainee.answer(truth));
  EXPECT_EQ(trainee->said().text, "One place has not been pressed yet.");
  EXPECT_TRUE(trainee.answer(truth));
  const TrialRow row = trainee.rows<TrialRow>().back();
  EXPECT_EQ(row.sites_felt, 11);
  EXPECT_TRUE(row.excluded.empty());
  EXPECT_EQ(row.visits.size(), 11U);
  EXPECT_EQ(trainee.rows<EventRow>().back().kind, "warning");
}

TEST(Session, FamiliarisationGoesOnUntilTheStifferOfTwoPlacesIsFound) {
  Somebody trainee(SessionKind::pre_test, builtInProtocol(), {}, false);
  trainee.press(5);
  trainee.next();
  ASSERT_EQ(trainee->screen(), Screen::familiarisation);
  EXPECT_TRUE(trainee->feelsTruth());
  EXPECT_FALSE(trainee.answer(4)) << "it is shown, not asked for";
  trainee.next();
  EXPECT_FALSE(trainee->asks());
  EXPECT_EQ(trainee->said().text, "Press both places first, one after the other.");
  trainee.feelTwo();
  trainee.next();
  for (int wrong = 0; wrong < 3; ++wrong) {
    ASSERT_TRUE(trainee->asks());
    EXPECT_FALSE(trainee->feelsTruth());
    EXPECT_EQ(trainee->familiarPlaces()->stiffer, 0) << "while it is asked for";
    EXPECT_FALSE(trainee.answer(5)) << "another place is no answer";
    const int truth = trainee->hidden()->site;
    EXPECT_TRUE(trainee.answer(truth == 4 ? 10 : 4));
    ASSERT_EQ(trainee->screen(), Screen::familiarisation) << "and felt once more";
    EXPECT_EQ(trainee->familiarPlaces()->stiffer, truth);
    EXPECT_EQ(trainee->hidden()->site, truth);
    trainee.feelTwo();
    trainee.next();
  }
  EXPECT_TRUE(trainee.answer(trainee->hidden()->site));
  EXPECT_EQ(trainee->screen(), Screen::instruction);
  EXPECT_EQ(trainee.rows<EventRow>().back().text, "found at answer 4");
  EXPECT_FALSE(trainee->familiarPlaces());
}

TEST(Session, FamiliarisationAsksForEitherPlace) {
  std::set<int> stiffer;
  for (std::uint64_t seed = 1; seed < 12; ++seed) {
    Session session({.protocol = builtInProtocol(), .kind = SessionKind::pre_test, .sites = flatTwelve(), .seed = seed},
                    {});
    session.feel(pressAt(flatTwelve().numbered(5)->point_mm, 1.0), {});
    for (int i = 0; i < 3; ++i) session.next({});  // felt both or not: said once
    ASSERT_TRUE(session.asks());
    stiffer.insert(session.hidden()->site);
  }
  EXPECT_EQ(stiffer, (std::set<int>{4, 10}));
}

TEST(Session, ATrialWhoseTargetWasNeverFeltDoesNotCount) {
  Somebody trainee(SessionKind::pre_test);
  trainee.next();
  const int truth = trainee->hidden()->site;
  trainee.pressAll(truth);
  trainee.answer(truth);
  trainee.answer(truth);  // a lucky guess
  EXPECT_EQ(trainee.rows<TrialRow>().back().excluded, "target not felt");
}

TEST(Session, TheTimeRunsOutButNotInAPause) {
  Somebody trainee(SessionKind::pre_test);
  trainee.next();
  trainee.wait(40.0);
  EXPECT_NEAR(trainee->secondsLeft(trainee.moment()), 5.0, 1e-9);
  trainee->pause(trainee.moment());
  trainee.wait(600.0);
  EXPECT_EQ(trainee->trialNumber(), 1);
  trainee.press(3);  // nothing is felt in a pause
  EXPECT_FALSE(trainee->visited(3));
  EXPECT_FALSE(trainee->answer(3, trainee.moment()));
  trainee->goOn(trainee.moment());
  EXPECT_NEAR(trainee->secondsLeft(trainee.moment()), 5.0, 1e-9);
  trainee.wait(5.1);
  EXPECT_EQ(trainee->trialNumber(), 2);
  const TrialRow row = trainee.rows<TrialRow>().back();
  EXPECT_TRUE(row.timed_out);
  EXPECT_EQ(row.site_answer, 0);
  EXPECT_FALSE(row.correct);
  EXPECT_NEAR(row.seconds, 45.1, 1e-6);
}

TEST(Session, TheClockStartsWhenTheWorldIsReady) {
  Somebody trainee(SessionKind::pre_test);
  trainee.next();
  trainee.press(1);
  trainee.wait(3.0);
  trainee->ready(trainee.moment());
  EXPECT_EQ(trainee->secondsLeft(trainee.moment()), 45.0);
  EXPECT_FALSE(trainee->visited(1)) << "it was felt in the world before";
}

TEST(Session, AnInterruptedBlockGoesOnWhereItStopped) {
  Somebody whole(SessionKind::pre_test);
  whole.next();
  Somebody first(SessionKind::pre_test);
  first.next();
  for (int i = 0; i < 5; ++i) {
    whole.trial(i % 2 == 0);
    first.trial(i % 2 == 0);
  }
  first->leave(first.moment());
  first.collect();
  const BlockRow stopped = first.rows<BlockRow>().back();
  EXPECT_FALSE(stopped.finished);
  Somebody second(SessionKind::pre_test, builtInProtocol(), stopped);
  second.next();
  for (int i = 5; i < 12; ++i) {
    EXPECT_EQ(second->trialNumber(), whole->trialNumber());
    EXPECT_EQ(second->hidden(), whole->hidden());
    whole.trial(i % 2 == 0);
    second.trial(i % 2 == 0);
  }
  EXPECT_EQ(second.rows<TrialRow>().back().block_id, stopped.id);
}

TEST(Session, ARowOfEveryTrialFollowsTheBlocksNewState) {
  Somebody trainee(SessionKind::pre_test);
  trainee.next();
  trainee.trial(true);
  const auto blocks = trainee.rows<BlockRow>();
  ASSERT_EQ(blocks.size(), 2U);
  EXPECT_NE(blocks[0].state_json, blocks[1].state_json);
  EXPECT_EQ(blocks[0].id, blocks[1].id);
  const TrialRow row = trainee.rows<TrialRow>().back();
  EXPECT_LT(row.file_tick_first, row.file_tick_last);
  EXPECT_NEAR(row.mean_force_n, 1.0, 1e-9);
  EXPECT_NEAR(row.peak_force_n, 1.0, 1e-9);
}

TEST(Session, AnExaminationEndsWithAVerdict) {
  Somebody trainee(SessionKind::exam);
  trainee.next();
  while (trainee->screen() == Screen::trial) trainee.trial(true);
  EXPECT_EQ(trainee->result()->verdict, Verdict::pass);
  EXPECT_LT(trainee.rows<TrialRow>().size(), 60U);
  EXPECT_EQ(trainee.rows<BlockRow>().back().verdict, Verdict::pass);
  trainee.next();
  EXPECT_EQ(trainee->screen(), Screen::finished);
}

TEST(Session, ABreakIsOfferedOnce) {
  Somebody trainee(SessionKind::pre_test);
  trainee.next();
  trainee.trial(true);
  trainee.wait(10.0);
  trainee->pause(trainee.moment());
  trainee.wait(16.0 * 60.0);
  trainee->goOn(trainee.moment());
  trainee.trial(true);
  EXPECT_NE(trainee->said().text.find("You may take a break"), std::string::npos);
  trainee.trial(true);
  EXPECT_EQ(trainee->said().text, "Answer saved.");
}

TEST(Session, FreeExplorationAsksNothing) {
  Somebody trainee(SessionKind::free);
  EXPECT_EQ(trainee->screen(), Screen::free_exploration);
  EXPECT_FALSE(trainee->hidden());
  EXPECT_FALSE(trainee.answer(3));
  trainee.next();
  EXPECT_EQ(trainee->screen(), Screen::finished);
  EXPECT_TRUE(trainee.rows<BlockRow>().empty());
}

TEST(Session, AnotherNumberOfSitesThanTheProtocolsIsRefused) {
  Protocol protocol = builtInProtocol();
  protocol.exam.block.choices = 10;
  EXPECT_THROW(Somebody(SessionKind::exam, protocol), Error);
}

}  // namespace
}  // namespace palpate::training
