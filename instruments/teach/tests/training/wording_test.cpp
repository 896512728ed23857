#include "palpate/training/wording.h"

#include <gtest/gtest.h>

#include <sstream>

#include "palpate/trace/sample.h"
#include "teach/tests/training/twelve.h"

namespace palpate::training {
namespace {

const Site& site(int number) {
  static const SiteSet sites = flatTwelve();
  return *sites.numbered(number);
}

TEST(Wording, SaysTheSitesAsTeachersDo) {
  EXPECT_EQ(rightAnswer(site(4)), "Correct. Site 4, left.");
  EXPECT_EQ(wrongAnswer(site(9)), "It was site 9, right. Feel it now; press Next when ready.");
  EXPECT_EQ(notPressedYet(2), "Two places have not been pressed yet.");
  EXPECT_EQ(notPressedYet(1), "One place has not been pressed yet.");
  EXPECT_EQ(instruction(builtInProtocol(), SessionKind::practice),
            "One of the twelve places is stiffer. Press each, then answer.");
}

TEST(Wording, NoSentenceIsLongerThanTwelveWords) {
  std::vector<std::string> all = {rightAnswer(site(4)),
                                  wrongAnswer(site(9)),
                                  notPressedYet(11),
                                  answerSaved(),
                                  familiarisation(site(12), site(6)),
                                  feelBoth(),
                                  stifferQuestion(),
                                  familiarFeedback(site(12)),
                                  wrongAnswerReview(site(12)),
                                  timeIsUp(true, site(12)),
                                  timeIsUp(false, site(12)),
                                  deviceCheck(true),
                                  deviceCheck(false),
                                  breakOfferText(),
                                  pausedNotice(),
                                  goodbye(true),
                                  goodbye(false)};
  for (const auto& word : WordsOf<SessionKind>::kAll) {
    all.push_back(greeting(word.value));
    all.push_back(instruction(builtInProtocol(), word.value));
  }
  for (const std::string& text : all) {
    std::istringstream words(text);
    const auto count = std::distance(std::istream_iterator<std::string>(words), {});
    EXPECT_GT(count, 0);
    EXPECT_LE(count, 12) << text;
  }
}

TEST(Wording, ATestEndsWithItsThresholdAndTheOneBefore) {
  BlockResult result;
  result.threshold = {.median = 0.18, .low = 0.13, .high = 0.25};
  EXPECT_EQ(blockSummary(result, SessionKind::post_test, {}), "Your smallest reliable change: about 18 % (13–25 %).");
  EXPECT_EQ(blockSummary(result, SessionKind::post_test, ShownThreshold{.median = 0.45, .low = 0.35, .high = 0.57}),
            "Your smallest reliable change: about 18 % (13–25 %). Last time: 45 %.");
}

TEST(Wording, AnIntervalThatSaysNothingIsNotShown) {
  BlockResult result;
  result.threshold = {.median = 0.49, .low = 0.102, .high = 1.57};
  EXPECT_EQ(blockSummary(result, SessionKind::pre_test, ShownThreshold{.median = 0.45, .low = 0.35, .high = 0.57}),
            "More trials are needed to measure your smallest change.");
  result.threshold = {.median = 0.18, .low = 0.13, .high = 0.25};
  EXPECT_EQ(blockSummary(result, SessionKind::post_test, ShownThreshold{.median = 0.22, .low = 0.05, .high = 1.04}),
            "Your smallest reliable change: about 18 % (13–25 %).")
      << "nothing of a test before that said nothing";
}

TEST(Wording, ATestOfTwentyAnswersSaysSomethingAndOneAnswerDoesNot) {
  Posterior posterior;
  posterior.add({.change = 0.5, .correct = true});
  EXPECT_FALSE(posterior.summary().isConclusive());
  Block block({.stop = {.least = 20, .most = 20}}, 3);
  while (!block.finished()) {
    const double change = block.next().change;
    block.answer({.answer = 1, .correct = change > 0.2});
  }
  EXPECT_TRUE(block.result().threshold.isConclusive());
  EXPECT_FALSE((ThresholdSummary{.median = 0.2, .low = 0.0, .high = 0.3}.isConclusive())) << "none was measured";
}

TEST(Wording, ACloseCallIsNotCalled) {
  BlockResult result;
  result.threshold = {.median = 0.18, .low = 0.13, .high = 0.25};
  const std::string text =
      blockSummary(result, SessionKind::post_test, ShownThreshold{.median = 0.24, .low = 0.17, .high = 0.33});
  EXPECT_NE(text.find("Too early to call a change."), std::string::npos) << text;
}

TEST(Wording, AnExaminationSaysItsVerdictAndNoNumber) {
  BlockResult result;
  result.threshold = {.median = 0.18, .low = 0.13, .high = 0.25};
  for (const Verdict verdict : {Verdict::pass, Verdict::not_yet, Verdict::repeat}) {
    result.verdict = verdict;
    const std::string text = blockSummary(result, SessionKind::exam, {});
    EXPECT_EQ(text.find_first_of("0123456789"), std::string::npos) << text;
  }
}

TEST(Wording, PracticeTellsHowManyWereRight) {
  BlockResult result;
  result.trials = 20;
  result.correct = 13;
  EXPECT_EQ(blockSummary(result, SessionKind::practice, {}), "Block finished. 13 of 20 were right.");
  result.level = 0.28;
  EXPECT_EQ(blockSummary(result, SessionKind::mastery, {}),
            "Block finished. 13 of 20 were right. Smallest level mastered: 28 %.");
}

TEST(Wording, PracticeSaysWhyAnswersDoNotCount) {
  BlockResult result;
  result.trials = 3;
  result.correct = 2;
  result.excluded = 1;
  EXPECT_EQ(blockSummary(result, SessionKind::practice, {}),
            "Block finished. 2 of 3 were right. 1 answer does not count: the place to find was never touched.");
  result.trials = result.correct = 0;
  result.excluded = 12;
  EXPECT_EQ(blockSummary(result, SessionKind::practice, {}),
            "Block finished. 12 answers do not count: the place to find was never touched.");
}

}  // namespace
}  // namespace palpate::training
