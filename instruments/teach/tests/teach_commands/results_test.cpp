// `palpate train results` as a teacher uses it: from cards to a list, a table, a deletion.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "kept_records.h"
#include "palpate/base/text.h"
#include "palpate/trace/recording_reader.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate::app {
namespace {

using support::runPalpate;
using training::Store;

TEST(Results, CodesBecomeCardsOrATable) {
  const auto cards = runPalpate("train results codes --count 3 --class osteo-1");
  EXPECT_EQ(cards.exit_code, 0) << cards.err;
  const std::regex code("[0-9A-HJKMNP-TV-Z]{5}-[0-9A-HJKMNP-TV-Z]{5}");
  EXPECT_EQ(std::distance(std::sregex_iterator(cards.out.begin(), cards.out.end(), code), std::sregex_iterator()), 3);
  const auto json = nlohmann::json::parse(runPalpate("train results codes --count 20 --class osteo-1 --json").out);
  std::set<std::string> codes;
  for (const auto& one : json.at("codes")) {
    codes.insert(one.at("code"));
    EXPECT_EQ(one.at("trainee"), training::derivePseudonym("osteo-1", one.at("code").get<std::string>()));
  }
  EXPECT_EQ(codes.size(), 20u);
  EXPECT_EQ(runPalpate("train results codes --count 0").exit_code, 2);
}

TEST(Results, ListsSessionsOfAllAndOfOne) {
  const Records records;
  const auto all = records.results("list a.results");
  EXPECT_EQ(all.exit_code, 0) << all.err;
  EXPECT_EQ(std::ranges::count(all.out, '\n'), 3);
  EXPECT_NE(all.out.find("pre-test"), std::string::npos);
  EXPECT_NE(all.out.find("10.3 % (7 to 14.3 %)"), std::string::npos);
  const auto json = nlohmann::json::parse(records.results("list a.results --json --trainee 0oooo00000").out);
  ASSERT_EQ(json.at("sittings").size(), 1u);
  EXPECT_EQ(json["sittings"][0]["trainee"], records.anna.id);
  EXPECT_EQ(json["sittings"][0]["trials"], 1);
}

TEST(Results, ShowsATraineeByCodeOrPseudonymAndTheClass) {
  const Records records;
  for (const std::string& who : {std::string(kAnnasCode), records.anna.id, records.anna.id.substr(0, 8)}) {
    const auto shown = records.results("trainee " + who + " a.results");
    EXPECT_EQ(shown.exit_code, 0) << shown.err;
    EXPECT_NE(shown.out.find(records.anna.id), std::string::npos);
    EXPECT_NE(shown.out.find("1 sessions, 1 trials"), std::string::npos);
  }
  EXPECT_EQ(nlohmann::json::parse(records.results("class a.results --json").out).at("trainees").size(), 2u);
  const auto nobody = records.results("trainee 11111-11111 a.results");
  EXPECT_EQ(nobody.exit_code, 2);
  EXPECT_EQ(std::ranges::count(nobody.err, '\n'), 1) << nobody.err;
}

TEST(Results, SaysWhereRecordsWouldBe) {
  const support::TemporaryFolder folder;
  const auto none = runPalpate("train results list nothing.results", folder.path());
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.err.find("nothing.results: no such file; `palpate train` creates records"), std::string::npos)
      << none.err;
}

TEST(Results, ExportsAndDoesNotReplaceUnasked) {
  const Records records;
  const auto done = records.results("export a.results --csv tables --json all.json --xapi statements.json");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  for (const char* name : {"tables/trials.csv", "tables/data_dictionary.csv", "all.json", "statements.json"}) {
    EXPECT_GT(std::filesystem::file_size(records.folder / name), 20u) << name;
  }
  EXPECT_EQ(nlohmann::json::parse(readFile(records.folder / "all.json", 1u << 24)).at("trial").size(), 13u);
  EXPECT_EQ(records.results("export a.results --json all.json").exit_code, 2);
  EXPECT_EQ(records.results("export a.results --json all.json --force").exit_code, 0);
  EXPECT_EQ(records.results("export a.results").exit_code, 2);
}

TEST(Results, ReplaysOneTrialOutOfALockedFile) {
  const Records records;
  const auto list = nlohmann::json::parse(records.results("list a.results --json --trainee 00000-00000").out);
  Store store(records.file, Store::Open::existing);
  const training::Uuid trial = store.trials(list["sittings"][0]["blocks"][0]["block"]).front().id;
  const auto done = records.results("replay " + trial + " a.results -o one.session --json");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  const trace::RecordingReader session(records.folder / "one.session");
  EXPECT_EQ(session.facts().last_tick, 199u);
  EXPECT_GE(session.facts().samples, 100u);
  EXPECT_LE(session.facts().samples, 200u);
  EXPECT_EQ(records.results("replay " + trial + " a.results -o one.session").exit_code, 2);  // is there
  EXPECT_EQ(records.results("replay nonsense a.results -o two.session").exit_code, 2);
}

TEST(Results, DeletesOneTraineeWhenToldTo) {
  const Records records;
  const auto asked = records.results("delete a.results --trainee 00000-00000");  // nobody there to say yes
  EXPECT_EQ(asked.exit_code, 1);
  EXPECT_NE(asked.err.find("nothing was deleted"), std::string::npos);
  const auto done = records.results("delete a.results --trainee 00000-00000 --yes --json");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  const auto json = nlohmann::json::parse(done.out);
  EXPECT_EQ(json.at("trials"), 1);
  EXPECT_EQ(json.at("session_files"), 1);
  EXPECT_EQ(records.results("trainee 00000-00000 a.results").exit_code, 2);
  EXPECT_EQ(nlohmann::json::parse(records.results("list a.results --json").out).at("sittings").size(), 2u);
}

TEST(Results, VerifyAnswersByItsExitCode) {
  const Records records;
  const auto whole = records.results("verify a.results --json");
  EXPECT_EQ(whole.exit_code, 0) << whole.out;
  const auto json = nlohmann::json::parse(whole.out);
  EXPECT_EQ(json.at("ok"), true);
  EXPECT_EQ(json.at("trials"), 13);
  EXPECT_EQ(json.at("session_files"), 1);
  Store(records.file, Store::Open::existing).rows().sql().run("DELETE FROM trial WHERE number = 2");
  const auto broken = records.results("verify a.results");
  EXPECT_EQ(broken.exit_code, 1);
  EXPECT_NE(broken.out.find("trial 2 is missing"), std::string::npos) << broken.out;
}

TEST(Results, OfADatabaseThatIsNotThereAreRefusedInOneLine) {
  const auto refused = runPalpate("train results list 'host=/nowhere/at/all dbname=x'");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(std::ranges::count(refused.err, '\n'), 1) << refused.err;
}

TEST(Results, PurgeCountsBeforeItForgets) {
  const Records records;
  const auto counted = nlohmann::json::parse(records.results("purge a.results --dry-run --json").out);
  EXPECT_EQ(counted.at("sittings"), 3);  // of 2023
  EXPECT_EQ(nlohmann::json::parse(records.results("list a.results --json").out).at("sittings").size(), 3u);
  EXPECT_EQ(records.results("purge a.results").exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(records.results("list a.results --json").out).at("sittings").size(), 0u);
}

}  // namespace
}  // namespace palpate::app
