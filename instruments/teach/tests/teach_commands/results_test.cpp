// `palpate train results` as a teacher uses it: from cards to a list, a table, a deletion.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "palpate/base/text.h"
#include "palpate/classroom/class_store.h"
#include "palpate/classroom/collector.h"
#include "palpate/trace/recording_reader.h"
#include "palpate/trace/recording_writer.h"
#include "palpate/training/records/recording_files.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"
#include "teach/tests/support/postgres_server.h"
#include "teach/tests/training/records_samples.h"

namespace palpate::app {
namespace {

namespace samples = training::samples;
using support::runPalpate;
using training::RecordingFiles;
using training::Store;

constexpr const char* kAnnasCode = "00000-00000";

/// Two trainees' records beside a locked session of each session.
struct Records {
  support::TemporaryFolder folder;
  training::TraineeRow anna = samples::trainee(kAnnasCode);
  std::string file = (folder / "a.results").string();

  Records() {
    Store store(file, Store::Open::create_too);
    std::vector<training::AnyRow> rows = samples::history(1, 2, 6).rows;
    rows.emplace_back(anna);
    const training::SessionRow session = samples::session(anna, 50);
    training::BlockRow block = samples::block(session, 50);
    Random random(3);
    training::TrialRow trial = samples::trial(block, 50, 1, random);
    trial.file_tick_first = 100;
    trial.file_tick_last = 199;
    rows.insert(rows.end(), {session, block, trial});
    store.storeAnyRows(rows);
    RecordingFiles files(store);
    std::filesystem::create_directories(files.folder());
    trace::RecordingWriter writer(files.pathOf(RecordingFiles::nameFor(session.id)),
                                  {"2026-11-22T10:00:00Z", "test", "test", 1000.0, "", ""}, {{"finger", "hand"}});
    trace::RecordingWorld world;
    world.scene = "scene";
    world.body = "torso";
    world.fingers = {{"", ""}};
    writer.add(world);
    for (std::uint64_t tick = 0; tick < 400; ++tick) {
      trace::Sample sample;
      sample.tick = tick;
      writer.add(sample);
    }
    writer.finish("done");
    files.lock(session.id);
  }
  support::CommandResult results(const std::string& arguments) const {
    return runPalpate("train results " + arguments, folder.path());
  }
};

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

TEST(Results, OfAClassLieInPostgresAndAreReadWrittenAndForgottenAsInAFile) {
  const auto server = support::PostgresServer::started();
  if (server == nullptr) GTEST_SKIP() << support::PostgresServer::kNotInstalled;
  const std::string address = server->connection("osteo");
  const Records records;
  {
    Store file(records.file, Store::Open::existing);
    classroom::ClassStore database(address);
    database.save(file.rows().all());
  }
  const std::string quoted = "'" + address + "'";
  for (const char* reading : {"list", "class", "trainee 00000-00000"}) {
    const auto file = records.results(std::string(reading) + " a.results");
    const auto database = records.results(std::string(reading) + " " + quoted);
    EXPECT_EQ(database.exit_code, 0) << database.err;
    EXPECT_EQ(database.out, file.out) << reading;
  }
  EXPECT_EQ(records.results("export a.results --csv one").exit_code, 0);
  EXPECT_EQ(records.results("export " + quoted + " --csv other").exit_code, 0);
  for (const auto& entry : std::filesystem::directory_iterator(records.folder / "one")) {
    EXPECT_EQ(support::contentOf(records.folder / "other" / entry.path().filename()), support::contentOf(entry.path()));
  }
  const auto page = runPalpate("train results report " + quoted, records.folder.path());
  EXPECT_EQ(page.exit_code, 0) << page.err;
  EXPECT_NE(page.out.find("database osteo -> class.html"), std::string::npos) << page.out;
  const auto verified = nlohmann::json::parse(records.results("verify --json " + quoted).out);
  EXPECT_EQ(verified.at("trials"), 13);
  EXPECT_EQ(verified.at("faults").size(), 0u) << "recordings are at the stations: " << verified.dump(2);

  EXPECT_EQ(records.results("delete --trainee 00000-00000 " + quoted).exit_code, 1) << "nobody typed yes";
  const auto deleted = records.results("delete --yes --json --trainee 00000-00000 " + quoted);
  EXPECT_EQ(deleted.exit_code, 0) << deleted.err;
  EXPECT_EQ(nlohmann::json::parse(deleted.out).at("trials"), 1);
  EXPECT_EQ(records.results("trainee 00000-00000 " + quoted).exit_code, 2);
  EXPECT_EQ(nlohmann::json::parse(records.results("purge --dry-run --json " + quoted).out).at("sittings"), 2);
  EXPECT_EQ(nlohmann::json::parse(records.results("class --json " + quoted).out).at("trainees").size(), 1u);
  EXPECT_EQ(nlohmann::json::parse(records.results("purge --json " + quoted).out).at("sittings"), 2);
  EXPECT_EQ(nlohmann::json::parse(records.results("class --json " + quoted).out).at("trainees").size(), 0u);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(records.folder.path())) {
    EXPECT_EQ(entry.path().string().find("osteo"), std::string::npos) << "no file is named after the address";
  }
}

TEST(Results, OfAClassAreWholeWithoutTheRecordingFilesThatLieAtItsStations) {
  const Records records;
  std::string trial;
  {
    Store station(records.file, Store::Open::existing);
    std::vector<classroom::SentRow> rows;
    for (training::AnyRow& row : station.rows().all()) rows.push_back({std::move(row)});
    classroom::fileSink(records.folder / "class.results")->save(rows);
    trial = station.trials(station.blocks(station.sessions(records.anna.id).front().id).front().id).front().id;
  }
  std::filesystem::remove_all(records.folder / "sessions");
  EXPECT_EQ(records.results("verify a.results").exit_code, 1) << "at the station they are missed";
  const auto whole = records.results("verify class.results");
  EXPECT_EQ(whole.exit_code, 0) << whole.out;
  EXPECT_NE(whole.out.find("at the stations"), std::string::npos) << whole.out;
  const auto replayed = records.results("replay " + trial + " class.results --out a.session");
  EXPECT_EQ(replayed.exit_code, 2);
  EXPECT_NE(replayed.err.find("stay at the station"), std::string::npos) << replayed.err;
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
