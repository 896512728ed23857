// `palpate class` as a teacher uses it: made, started, checked, watched; and what it says when something is missing.
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "palpate/classroom/broker_process.h"
#include "palpate/training/records/store.h"
#include "palpate/training/records/trainee_code.h"
#include "support/places.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"
#include "support/wait_for.h"

namespace palpate {
namespace {

using support::runPalpate;
using support::TemporaryFolder;

/// The command beside the test, until it ends by itself.
void startPalpate(const std::string& arguments, const std::filesystem::path& in) {
  const std::string line =
      "cd '" + in.string() + "' && '" + support::builtProgram() + "' " + arguments + " >serve.log 2>&1 </dev/null &";
  ASSERT_EQ(std::system(line.c_str()), 0);
}

/// Likely free: of the ports that no service has; another each time, for what was started may run on for a while.
std::string somePort() {
  static int asked = 0;
  return std::to_string(20000 + (getpid() + 1000 * asked++) % 12000);
}

TEST(ClassCommand, InitMakesAFolderOnce) {
  const TemporaryFolder folder;
  const auto made = runPalpate("class init osteo --class osteo-1 --stations 2 --json", folder.path());
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(nlohmann::json::parse(made.out)["stations"], (nlohmann::json{"s01", "s02"}));
  const auto again = runPalpate("class init osteo --class osteo-1", folder.path());
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_NE(again.err.find("osteo: exists already"), std::string::npos) << again.err;
  const auto more = runPalpate("class add-station osteo", folder.path());
  EXPECT_EQ(more.exit_code, 0) << more.err;
  EXPECT_NE(more.out.find("s03"), std::string::npos) << more.out;
}

TEST(ClassCommand, NamesThatMakeNoSenseAreRefusedInOneLine) {
  const TemporaryFolder folder;
  for (const char* arguments : {"--class 'Osteo 1'", "--class osteo --host 'a b'", "--class a/b"}) {
    const auto refused = runPalpate(std::string("class init osteo ") + arguments, folder.path());
    EXPECT_EQ(refused.exit_code, 2) << arguments;
    EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "osteo")) << arguments;
  }
}

TEST(ClassCommand, CheckSaysNoWithoutABrokerAndOkWithOne) {
  if (classroom::brokerProgram().empty()) GTEST_SKIP() << "mosquitto is not installed (apt install mosquitto)";
  const TemporaryFolder folder;
  ASSERT_EQ(runPalpate("class init osteo --class osteo-1 --stations 3 --port " + somePort(), folder.path()).exit_code,
            0);
  const auto without = runPalpate("class check osteo", folder.path());
  EXPECT_EQ(without.exit_code, 1);
  EXPECT_NE(without.out.find("NO  checker connects"), std::string::npos) << without.out;

  startPalpate("class serve osteo --broker --seconds 25", folder.path());
  nlohmann::json found;
  EXPECT_TRUE(support::waitFor([&] {
    const auto with = runPalpate("class check osteo --json", folder.path());
    found = nlohmann::json::parse(with.out);
    return with.exit_code == 0;
  })) << found.dump(2)
      << support::contentOf(folder / "serve.log");
  EXPECT_EQ(found["steps"].size(), 13U);

  std::filesystem::create_directory(folder / "records");
  const auto load =
      runPalpate("class load osteo --records-folder records --stations 3 --seconds 3 --trial-every 0.5", folder.path());
  ASSERT_EQ(load.exit_code, 0) << load.err;
  EXPECT_EQ(nlohmann::json::parse(load.out)["rows_waiting"], 0);
  training::Store gathered(folder / "osteo/class.results", training::Store::Open::read_only);
  EXPECT_EQ(gathered.trainees().size(), 3U);
  EXPECT_GT(gathered.rows().trialCount(), 3);

  const auto watch = runPalpate("class watch osteo --json --seconds 1", folder.path());
  ASSERT_EQ(watch.exit_code, 0) << watch.err;
  const auto board = nlohmann::json::parse(watch.out.substr(0, watch.out.find('\n')));
  EXPECT_TRUE(board["connected"]);
  ASSERT_EQ(board["tiles"].size(), 3U);
  for (const auto& tile : board["tiles"]) EXPECT_FALSE(tile["online"]) << tile.dump();
}

TEST(ClassCommandWithPatience, AStationThatWasRemovedIsLetInNoLongerAndServeNoticesByItself) {
  if (classroom::brokerProgram().empty()) GTEST_SKIP() << "mosquitto is not installed (apt install mosquitto)";
  const TemporaryFolder folder;
  ASSERT_EQ(runPalpate("class init osteo --class osteo-1 --stations 2 --port " + somePort(), folder.path()).exit_code,
            0);
  std::filesystem::copy(folder / "osteo/stations/s02", folder / "lost", std::filesystem::copy_options::recursive);
  startPalpate("class serve osteo --broker --seconds 25", folder.path());
  const auto comes_in = [&](const char* who) {
    return runPalpate(std::string("class check ") + who, folder.path()).exit_code == 0;
  };
  ASSERT_TRUE(support::waitFor([&] { return comes_in("lost"); })) << support::contentOf(folder / "serve.log");

  const auto unsure = runPalpate("class remove-station osteo s02", folder.path());
  EXPECT_EQ(unsure.exit_code, 1) << "nobody typed yes";
  EXPECT_TRUE(std::filesystem::exists(folder / "osteo/stations/s02"));
  EXPECT_EQ(runPalpate("class remove-station osteo s07 --yes", folder.path()).exit_code, 2);
  const auto removed = runPalpate("class remove-station osteo s02 --yes", folder.path());
  EXPECT_EQ(removed.exit_code, 0) << removed.err;
  EXPECT_TRUE(support::waitFor([&] { return !comes_in("lost"); }));
  EXPECT_EQ(runPalpate("class add-station osteo s02", folder.path()).exit_code, 0);
  for (const char* who : {"osteo/stations/s01", "osteo/stations/s02", "osteo"}) {
    EXPECT_TRUE(support::waitFor([&] { return comes_in(who); })) << who << support::contentOf(folder / "serve.log");
  }
  EXPECT_FALSE(comes_in("lost"));
  EXPECT_NE(support::contentOf(folder / "serve.log").find("a station was removed"), std::string::npos);
}

TEST(ClassCommand, RenewMakesNewCertificatesAndCheckRefusesAKeyThatOthersMayRead) {
  const TemporaryFolder folder;
  ASSERT_EQ(runPalpate("class init osteo --class osteo-1 --stations 2 --port 1", folder.path()).exit_code, 0);
  const auto before = support::contentOf(folder / "osteo/stations/s01/station.crt");
  const auto renewed = runPalpate("class renew osteo s01 --days 30", folder.path());
  EXPECT_EQ(renewed.exit_code, 0) << renewed.err;
  EXPECT_NE(support::contentOf(folder / "osteo/stations/s01/station.crt"), before);
  std::filesystem::permissions(folder / "osteo/stations/s02/station.key", std::filesystem::perms::others_read,
                               std::filesystem::perm_options::add);
  const auto checked = runPalpate("class check osteo", folder.path());
  EXPECT_EQ(checked.exit_code, 1);
  // 29 once a second of the 30 has gone by; a certificate may begin a little before it is made.
  EXPECT_TRUE(std::regex_search(checked.out, std::regex("certificate of s01: valid for (29|30) days; `palpate class")))
      << checked.out;
  EXPECT_NE(checked.out.find("stations/s02/station.key can be used by others"), std::string::npos) << checked.out;
  EXPECT_EQ(runPalpate("class renew osteo s07", folder.path()).exit_code, 2);
}

TEST(ClassCommand, ACodeIsFoundByTheClassesSecret) {
  const TemporaryFolder folder;
  ASSERT_EQ(runPalpate("class init osteo --class osteo-1 --stations 1 --port 1", folder.path()).exit_code, 0);
  const auto made = runPalpate("train results codes --count 1 --class osteo --json", folder.path());
  const auto one = nlohmann::json::parse(made.out)["codes"][0];
  const std::string code = one["code"];
  EXPECT_NE(one["trainee"], training::derivePseudonym("osteo-1", code));
  {
    training::Store store(folder / "a.results", training::Store::Open::create_too);
    store.save(training::ClassRow{.id = "osteo-1"});
    store.save(training::TraineeRow{.id = one["trainee"], .class_id = "osteo-1"});
  }
  EXPECT_EQ(runPalpate("train results trainee " + code + " a.results", folder.path()).exit_code, 2);
  EXPECT_EQ(runPalpate("train results trainee " + code + " a.results --class osteo", folder.path()).exit_code, 0);
  EXPECT_EQ(runPalpate("train results trainee " + code + " a.results", folder.path()).exit_code, 0)
      << "it is remembered";
}

TEST(ClassCommand, AStationsFolderIsNoInstructors) {
  const TemporaryFolder folder;
  ASSERT_EQ(runPalpate("class init osteo --class osteo-1", folder.path()).exit_code, 0);
  const auto watch = runPalpate("class watch osteo/stations/s01 --json --seconds 1", folder.path());
  EXPECT_EQ(watch.exit_code, 2);
  EXPECT_NE(watch.err.find("must be the folder of a class or of its instructor"), std::string::npos) << watch.err;
}

}  // namespace
}  // namespace palpate
