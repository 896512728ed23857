// `palpate train --trainee` as a user runs it: what it prints, what it keeps, and what becomes of it when it is killed.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "palpate/training/protocol.h"
#include "palpate/training/records/store.h"
#include "support/places.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"
#include "support/wait_for.h"

namespace palpate {
namespace {

using nlohmann::json;
using support::runPalpate;

class TrainTrainee : public testing::Test {
 protected:
  TrainTrainee() {
    std::ofstream(folder_ / "small.toml") << "[body]\nkind = \"trunk\"\ntriangles = 14000\n";
    training::Protocol protocol = training::builtInProtocol();
    protocol.id = "short";
    protocol.pre_test.block.warm_up = 1;
    protocol.pre_test.block.easy = 1;
    protocol.pre_test.block.stop = {.least = 11, .most = 11};
    std::ofstream(folder_ / "short.toml") << training::protocolText(protocol);
  }

  json trained(const std::string& arguments) const {
    const auto result = runPalpate("train --json " + arguments, folder_.path());
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(result.out, nullptr, false);
  }

  /// Starts it on the small body and ends it by this signal once so many trials were told; how it ended.
  int endedAfter(int trials, int number) const {
    const pid_t child = fork();
    if (child == 0) {
      if (chdir(folder_.path().c_str()) != 0) _exit(99);
      ::signal(SIGINT, SIG_DFL);
      dup2(open("out", O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
      dup2(open("err", O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
      execl(support::builtProgram().c_str(), "palpate", "train", "small.toml", "--trainee", "weber=0.2", "--protocol",
            "short.toml", "--records", "r.results", "--verbose", nullptr);
      _exit(99);
    }
    const std::string told = "trial " + std::string(trials < 10 ? " " : "") + std::to_string(trials) + ":";
    EXPECT_TRUE(support::waitFor([&] { return support::contentOf(folder_ / "out").find(told) != std::string::npos; }))
        << support::contentOf(folder_ / "err");
    kill(child, number);
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  support::TemporaryFolder folder_;
};

TEST_F(TrainTrainee, TellsItsThresholdAndKeepsIt) {
  const auto result = runPalpate("train small.toml --trainee weber=0.2 --fast --records r.results", folder_.path());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("pre_test: 43 trials"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("; T "), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("kept in r.results"), std::string::npos) << result.out;
  training::Store store(folder_ / "r.results", training::Store::Open::read_only);
  ASSERT_EQ(store.sessions().size(), 1u);
  EXPECT_EQ(store.sessions().front().device, "simulated, no body");
  EXPECT_EQ(store.blocks(store.sessions().front().id).front().trials, 40);
}

TEST_F(TrainTrainee, SaysTheSameFromTheSameSeed) {
  const std::string words = "small.toml --trainee weber=0.2 --fast ";
  json one = trained(words + "--seed 3 --records a.results");
  json two = trained(words + "--seed 3 --records b.results");
  for (json* said : {&one, &two}) said->erase("records");
  EXPECT_EQ(one, two);
}

TEST_F(TrainTrainee, NamesAWrongWordInOneLine) {
  for (const std::string words : {"--trainee webber=0.2", "--trainee weber=0.2 --hand thimbel",
                                  "--trainee weber=0.2 --start yesterday", "--trainee weber=0.2 --code 1234"}) {
    const auto result = runPalpate("train small.toml --fast --records r.results " + words, folder_.path());
    EXPECT_EQ(result.exit_code, 2) << words;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_TRUE(result.out.empty()) << result.out;
  }
}

TEST_F(TrainTrainee, PutsTwoThroughTheWholeCourse) {
  const json said =
      trained("small.toml --trainee weber=0.2 --fast --programme --trainees 2 --class osteo-1 --records r.results");
  ASSERT_EQ(said["trainees"].size(), 2u);
  EXPECT_NE(said["trainees"][0]["code"], said["trainees"][1]["code"]);
  for (const json& trainee : said["trainees"]) {
    ASSERT_EQ(trainee["sittings"].size(), 8u);
    EXPECT_EQ(trainee["sittings"][0]["kind"], "pre_test");
    EXPECT_EQ(trainee["sittings"][7]["kind"], "post_test");
  }
  training::Store store(folder_ / "r.results", training::Store::Open::read_only);
  EXPECT_EQ(store.trainees().size(), 2u);
  EXPECT_EQ(store.sessions().size(), 16u);
}

TEST_F(TrainTrainee, LeavesASessionThatCanBeReplayedToTheBit) {
  const json said = trained("small.toml --trainee weber=0.2 --most-trials 2 --records r.results");
  const json& session = said["trainees"][0]["sittings"][0];
  EXPECT_EQ(session["trials"], 2);
  EXPECT_EQ(session["finished"], false);
  EXPECT_EQ(session["device"], "simulated thimble on touch_x");
  const auto replayed = runPalpate("recording replay --verify " + session["file"].get<std::string>(), folder_.path());
  EXPECT_EQ(replayed.exit_code, 0) << replayed.out << replayed.err;
}

TEST_F(TrainTrainee, KilledInTheMiddleGoesOnWithTheSameBlock) {
  EXPECT_EQ(endedAfter(4, SIGKILL), -SIGKILL);
  const json said = trained("small.toml --trainee weber=0.2 --protocol short.toml --records r.results");
  const json& session = said["trainees"][0]["sittings"][0];
  EXPECT_EQ(session["resumed"], true);
  EXPECT_EQ(session["finished"], true);
  training::Store store(folder_ / "r.results", training::Store::Open::read_only);
  const auto trials = store.trials(session["block"]);
  ASSERT_EQ(trials.size(), 12u);
  for (std::size_t i = 0; i < trials.size(); ++i) EXPECT_EQ(trials[i].number, static_cast<int>(i) + 1);
  EXPECT_GE(trials.size() - session["trials"].get<std::size_t>(), 4u);  // whatever was told was kept
}

TEST_F(TrainTrainee, AskedToEndPutsItsBlockDown) {
  EXPECT_EQ(endedAfter(2, SIGINT), 128 + SIGINT);
  EXPECT_NE(support::contentOf(folder_ / "out").find("put down"), std::string::npos);
  training::Store store(folder_ / "r.results", training::Store::Open::read_only);
  ASSERT_EQ(store.sessions().size(), 1u);
  const training::SessionRow session = store.sessions().front();
  EXPECT_GT(session.end_ms, session.start_ms);
  EXPECT_FALSE(store.blocks(session.id).front().finished);
  EXPECT_TRUE(std::filesystem::exists(folder_ / session.file));
  EXPECT_EQ(session.file_sha256.size(), 64u);
}

using TrainClass = TrainTrainee;  // a class of twelve: in the second circle (tests/circles.tsv)

TEST_F(TrainClass, GoesThroughTheWholeCourseAndLearns) {
  const json said = trained(
      "small.toml --trainee weber=0.28,weber_end=0.14,learning_blocks=1.5 --fast --programme --trainees 12 "
      "--class osteo-1 --records r.results");
  ASSERT_EQ(said["trainees"].size(), 12u);
  double before = 0.0;
  double after = 0.0;
  std::set<std::string> codes;
  for (const json& trainee : said["trainees"]) {
    codes.insert(trainee["code"].get<std::string>());
    ASSERT_EQ(trainee["sittings"].size(), 8u);
    EXPECT_EQ(trainee["sittings"][0]["kind"], "pre_test");
    EXPECT_EQ(trainee["sittings"][7]["kind"], "post_test");
    before += trainee["sittings"][0]["threshold"].get<double>() / 12;
    after += trainee["sittings"][7]["threshold"].get<double>() / 12;
  }
  EXPECT_EQ(codes.size(), 12u);
  EXPECT_NEAR(before, 0.28, 0.08);
  EXPECT_NEAR(after, 0.15, 0.05);
  training::Store store(folder_ / "r.results", training::Store::Open::read_only);
  EXPECT_EQ(store.trainees().size(), 12u);
  EXPECT_EQ(store.sessions().size(), 96u);
  EXPECT_EQ(store.classes().front().id, "osteo-1");
}

}  // namespace
}  // namespace palpate
