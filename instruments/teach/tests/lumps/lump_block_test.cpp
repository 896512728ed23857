// Bodies with lumps as they are drawn, asked about and judged: without any body, the cue is what a test says it is.
#include "palpate/lumps/lump_block.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "palpate/base/error.h"
#include "palpate/base/random.h"

namespace palpate::lumps {
namespace {

std::vector<Vec2> grid() {
  std::vector<Vec2> places;
  for (int y = 0; y <= 240; y += 4) {
    for (int x = -40; x <= 40; x += 4) places.emplace_back(x, y);
  }
  return places;
}

/// Plainer by a factor of 4 a grade of size, of 2 a grade of hardness, less by 3 a grade of depth.
double madeCue(const HiddenLump& lump) {
  return std::pow(4.0, lump.size) * std::pow(2.0, lump.hardness) / std::pow(3.0, lump.depth);
}

LumpBlockSettings made(bool exam) { return {.task = {}, .exam = exam, .places = grid(), .cue_of = madeCue}; }

/// Answers whatever is asked: finds a lump, or not, and describes it rightly.
void answerBody(LumpBlock& block, bool finds) {
  const std::vector<HiddenLump> hidden = block.trial().hidden;
  std::size_t named = 0;
  while (!block.trial().over) {
    const HiddenLump* lump = hidden.empty() ? nullptr : &hidden[std::min(named, hidden.size() - 1)];
    switch (block.question()) {
      case LumpQuestion::there:
        block.answer(finds && lump != nullptr ? 1 : 0);
        break;
      case LumpQuestion::place:
        if (!finds || named == hidden.size()) {
          block.noMore();
        } else {
          block.answer(Vec2(hidden[named].place_mm + Vec2(3.0, 0.0)));
        }
        break;
      case LumpQuestion::size:
        block.answer(lump->size);
        break;
      case LumpQuestion::depth:
        block.answer(lump->depth);
        break;
      case LumpQuestion::hardness:
        block.answer(lump->hardness);
        break;
      case LumpQuestion::mobile:
        block.answer(lump->mobile ? 1 : 0);
        ++named;
        break;
      case LumpQuestion::none:
        return;
    }
  }
}

TEST(LumpBlock, AnExaminationHidesEveryKindOnceInSixBodies) {
  LumpBlock block(made(true), 7);
  std::set<std::array<int, 3>> kinds;
  while (true) {
    const std::vector<HiddenLump> hidden = block.trial().hidden;
    ASSERT_EQ(hidden.size(), 3U);
    std::set<int> sizes, hardnesses;
    for (std::size_t i = 0; i < hidden.size(); ++i) {
      kinds.insert({hidden[i].size, hidden[i].depth, hidden[i].hardness});
      sizes.insert(hidden[i].size);
      hardnesses.insert(hidden[i].hardness);
      for (std::size_t k = 0; k < i; ++k) EXPECT_GE((hidden[i].place_mm - hidden[k].place_mm).norm(), 45.0);
    }
    EXPECT_EQ(sizes.size(), 3U) << "one of each size in every body";
    EXPECT_EQ(hardnesses.size(), 3U);
    answerBody(block, true);
    if (block.finished()) break;
    block.next();
  }
  EXPECT_EQ(block.number(), kExamBodies);
  EXPECT_EQ(kinds.size(), static_cast<std::size_t>(kExamLumps)) << "three sizes, three hardnesses, two depths";
  for (const auto& kind : kinds) EXPECT_NE(kind[1], 1) << "the least and the greatest depth alone";
  EXPECT_EQ(block.counts().found, kExamLumps);
  EXPECT_TRUE(block.counts().passed);
}

TEST(LumpBlock, GoesOnFromEveryAnswerAsIfNothingHadHappened) {
  for (const bool exam : {false, true}) {
    LumpBlock whole(made(exam), 11);
    LumpBlock again(made(exam), 11);
    Random random(3);
    for (int i = 0; i < 60 && !whole.finished(); ++i) {
      again = LumpBlock::resumed(made(exam), again.state());
      ASSERT_EQ(again.question(), whole.question());
      ASSERT_EQ(again.trials(), whole.trials());
      const auto choice = static_cast<int>(random.below(2));
      const Vec2 place = grid()[random.below(grid().size())];
      for (LumpBlock* block : {&whole, &again}) {
        if (block->question() == LumpQuestion::none) {
          block->next();
        } else if (block->question() != LumpQuestion::place) {
          block->answer(choice);
        } else if (exam && choice == 1) {
          block->noMore();
        } else {
          block->answer(place);
        }
      }
    }
    EXPECT_GT(whole.number(), 3);
  }
}

TEST(LumpBlock, PracticeWalksAlongTheCueAndNotAlongAPercentage) {
  LumpBlock good(made(false), 5);
  LumpBlock poor(made(false), 5);
  double last_good = 0.0, last_poor = 0.0;
  for (int i = 0; i < 20; ++i) {
    if (!good.trial().hidden.empty()) last_good = good.trial().hidden.front().cue;
    if (!poor.trial().hidden.empty()) last_poor = poor.trial().hidden.front().cue;
    answerBody(good, true);
    answerBody(poor, false);
    good.next();
    poor.next();
  }
  EXPECT_LT(last_good, 2.0) << "who finds everything is given what is hardly felt";
  EXPECT_GT(last_poor, 16.0) << "who finds nothing is given the plainest";
  EXPECT_LT(good.counts().threshold.median, poor.counts().threshold.median);
}

TEST(LumpBlock, SomeBodiesOfPracticeHoldNothing) {
  LumpBlockSettings settings = made(false);
  settings.task.bodies = 200;
  LumpBlock block(settings, 1);
  while (!block.finished()) {
    answerBody(block, true);
    block.next();
  }
  EXPECT_NEAR(block.counts().without, 60, 20);  // 30 %, three standard deviations
  EXPECT_EQ(block.counts().said_without, 0);
}

LumpTrial makeTrial(std::vector<HiddenLump> hidden, const std::vector<Vec2>& named) {
  LumpTrial trial{.hidden = std::move(hidden), .findings = {}, .over = true};
  for (const Vec2& place : named) trial.findings.push_back({.place_mm = place});
  return trial;
}

TEST(LumpBlock, AFindingBelongsToOneLumpWithinAFingertip) {
  const LumpTask task;
  const LumpTrial two = makeTrial({{.place_mm = {0, 0}}, {.place_mm = {50, 0}}}, {{9.9, 0}, {2, 0}, {50, 10.1}});
  const auto judgements = matchFindings(two, task);
  EXPECT_FALSE(judgements[0].lump) << "the nearer one has it";
  EXPECT_EQ(judgements[1].lump, 0U);
  EXPECT_FALSE(judgements[2].lump) << "10.1 mm beside";
  EXPECT_NEAR(*judgements[2].error_mm, 10.1, 1e-12);
  EXPECT_FALSE(isRight(two, task));
  const LumpCounts counts = countLumps({two}, task);
  EXPECT_EQ(counts.found, 1);
  EXPECT_EQ(counts.false_places, 2);
}

TEST(LumpBlock, ALargeLumpMayBeNamedAnywhereOverIt) {
  LumpTask task;
  task.diameters_mm = {3.0, 5.0, 24.0};
  EXPECT_TRUE(isRight(makeTrial({{.size = 2}}, {{11.5, 0}}), task));
  EXPECT_FALSE(isRight(makeTrial({{.size = 1}}, {{11.5, 0}}), task));
}

TEST(LumpBlock, AsksOnlyWhatCanBeAnswered) {
  LumpBlockSettings settings = made(false);
  settings.task.empty_share = 0.0;
  LumpBlock block(settings, 2);
  EXPECT_EQ(block.question(), LumpQuestion::there);
  EXPECT_FALSE(block.answer(2)) << "yes or no";
  EXPECT_FALSE(block.answer(Vec2(0, 0)));
  EXPECT_FALSE(block.noMore()) << "of examinations alone";
  EXPECT_TRUE(block.answer(1));
  EXPECT_TRUE(block.answer(Vec2(block.trial().hidden.front().place_mm + Vec2(0, 60.0))));
  EXPECT_EQ(block.question(), LumpQuestion::none) << "of a place without a lump nothing is asked";
  EXPECT_FALSE(isRight(block.trial(), settings.task));
}

TEST(LumpBlock, AnExaminationIsMarkedByWhatIsFoundAndWhatIsNamedInVain) {
  LumpTask task;
  std::vector<LumpTrial> trials;
  for (int i = 0; i < 9; ++i) trials.push_back(makeTrial({{}}, {{0, 0}}));
  for (int i = 0; i < 9; ++i) trials.push_back(makeTrial({{}}, {}));
  EXPECT_TRUE(countLumps(trials, task).passed) << "half of them";
  trials.push_back(makeTrial({{}}, {}));
  EXPECT_FALSE(countLumps(trials, task).passed);
  trials.pop_back();
  trials.back().findings.resize(5, {.place_mm = Vec2(90, 0)});
  EXPECT_FALSE(countLumps(trials, task).passed) << "whoever names every place has found nothing";
}

TEST(LumpBlock, ReadsNoStateThatIsDamaged) {
  const LumpBlock block(made(false), 1);
  const std::string state = block.state();
  EXPECT_EQ(parseLumpState(state).trials, block.trials());
  for (const auto& [from, to] : {std::pair<std::string, std::string>{"\"lump_version\":1", "\"lump_version\":9"},
                                 {"\"exam\":false", "\"exam\":7"},
                                 {"\"over\":false", "\"over\":\"no\""},
                                 {"\"bodies\":[", "\"bodies\":[7,"}}) {
    std::string damaged = state;
    const std::size_t at = damaged.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    damaged.replace(at, from.size(), to);
    EXPECT_THROW(parseLumpState(damaged), Error) << damaged;
  }
  EXPECT_THROW(parseLumpState("nothing"), Error);
  EXPECT_THROW(LumpBlock::resumed(made(true), state), Error) << "practice is no examination";
}

}  // namespace
}  // namespace palpate::lumps
