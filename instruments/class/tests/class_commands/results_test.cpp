// `palpate train results` of a class: in its database, and gathered from its stations.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "class/tests/support/postgres_server.h"
#include "palpate/classroom/class_store.h"
#include "palpate/classroom/collector.h"
#include "support/places.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"
#include "teach/tests/teach_commands/kept_records.h"

namespace palpate::app {
namespace {

using support::runPalpate;
using training::Store;

TEST(ResultsOfAClass, LieInPostgresAndAreReadWrittenAndForgottenAsInAFile) {
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

TEST(ResultsOfAClass, AreWholeWithoutTheRecordingFilesThatLieAtItsStations) {
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

TEST(ResultsOfAClass, NeedTheProgramOfClasses) {
  const support::TemporaryFolder folder;
  std::filesystem::copy_file(support::buildFolder() / "palpate-teach", folder / "palpate-teach");
  const auto refused = support::runProgram(folder / "palpate-teach", "train results list 'host=/nowhere dbname=x'");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("requires the package palpate-class"), std::string::npos) << refused.err;
}

}  // namespace
}  // namespace palpate::app
