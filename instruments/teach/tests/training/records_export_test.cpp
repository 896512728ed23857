// Exports that others can read and that tell no more than they may, and the check that finds what is wrong with
// records.
#include "palpate/training/records/export.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "palpate/base/text.h"
#include "palpate/training/records/recording_files.h"
#include "palpate/training/records/verify.h"
#include "support/temporary_folder.h"
#include "teach/tests/training/records_samples.h"

namespace palpate::training {
namespace {

/// RFC 4180, by a reader of its own.
std::vector<std::vector<std::string>> csvCells(const std::string& text) {
  std::vector<std::vector<std::string>> lines(1, {""});
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
        lines.back().back() += text[++i];
      } else if (c == '"') {
        quoted = false;
      } else {
        lines.back().back() += c;
      }
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',') {
      lines.back().emplace_back();
    } else if (c == '\r') {
      EXPECT_EQ(text[i + 1], '\n');
      ++i;
      if (i + 1 < text.size()) lines.emplace_back(1, "");
    } else {
      lines.back().back() += c;
    }
  }
  return lines;
}

/// A trainee's session as the program makes it: a protocol, a block that was answered, results that follow.
struct RealSession {
  Protocol protocol = builtInProtocol();
  TraineeRow trainee = samples::trainee();
  SessionRow session;
  BlockRow row;
  std::vector<AnyRow> rows;

  explicit RealSession(SessionKind kind, int answers) {
    session = samples::session(trainee, 1, kind);
    row = samples::block(session, 1);
    row.protocol_version = protocol.version;
    rows = {samples::station(), samples::aClass(), trainee, session,
            ProtocolRow{protocol.id, protocol.version, protocolText(protocol), protocolSha256(protocol)}};
    Block block(settingsOf(protocol, kind).block, 5);
    row.method = block.settings().method;
    Random random(4);
    std::vector<AnyRow> trials;
    for (int number = 1; number <= answers && !block.finished(); ++number) {
      TrialRow trial = samples::trial(row, static_cast<std::uint64_t>(number), number, random);
      trial.kind = block.next().kind;
      trial.change = block.next().change;
      trial.site_true = block.next().site;
      trial.site_answer = random.uniform() < 0.7 ? trial.site_true : 1 + trial.site_true % 12;
      trial.correct = trial.site_answer == trial.site_true;
      trial.timed_out = false;
      trial.excluded.clear();
      block.answer({trial.site_answer, trial.correct, 12, true});
      trials.emplace_back(trial);
    }
    row.copyStateFrom(block);
    rows.emplace_back(row);
    rows.insert(rows.end(), trials.begin(), trials.end());
    rows.emplace_back(EventRow{samples::id(5, 1), session.id, session.start_ms, "message", "Well done, Anna Smith!"});
  }
};

TEST(RecordsExport, TablesHoldEveryRowAndSayWhatTheyMean) {
  const support::TemporaryFolder folder;
  Store store(folder / "a.results", Store::Open::create_too);
  const samples::History history = samples::history(2, 2, 6);
  store.storeAnyRows(history.rows);
  std::map<std::string, std::vector<std::vector<std::string>>> files;
  for (const ExportedFile& file : csvFiles(store.rows())) files[file.name] = csvCells(file.text);
  EXPECT_EQ(files.at("trials.csv").size(), 1 + history.trials);
  EXPECT_EQ(files.at("sessions.csv").size(), 5u);
  std::set<std::string> meant;
  for (const auto& line : files.at("data_dictionary.csv")) meant.insert(line.at(0) + "." + line.at(1));
  const std::map<std::string, std::string> table_of = {
      {"trials.csv", "trial"},     {"sessions.csv", "session"},   {"blocks.csv", "block"},
      {"trainees.csv", "trainee"}, {"stations.csv", "station"},   {"site_visits.csv", "site_visit"},
      {"events.csv", "event"},     {"protocols.csv", "protocol"}, {"classes.csv", "class"}};
  for (const auto& [name, table] : table_of) {
    for (const auto& line : files.at(name)) EXPECT_EQ(line.size(), files.at(name).front().size()) << name;
    for (const std::string& column : files.at(name).front()) {
      EXPECT_TRUE(meant.contains(table + "." + column)) << table << '.' << column;
    }
  }
  // Numbers to the last bit, quotes and line ends as they were.
  const auto& trials = files.at("trials.csv");
  const auto change = std::ranges::find(trials.front(), "change") - trials.front().begin();
  const auto kept = store.rows().trial(trials[1][0]);
  EXPECT_EQ(std::stod(trials[1][static_cast<std::size_t>(change)]), kept->change);
  EXPECT_EQ(files.at("stations.csv")[1][1], "Room 3, \"left\"");
  EXPECT_NE(files.at("events.csv")[1][4].find('\n'), std::string::npos);
}

TEST(RecordsExport, OfABlockThatGoesOnNothingTellsWhatComes) {
  const support::TemporaryFolder folder;
  Store store(folder / "a.results", Store::Open::create_too);
  const RealSession real(SessionKind::pre_test, 10);
  ASSERT_FALSE(real.row.finished);
  store.storeAnyRows(real.rows);
  std::string all = jsonText(store.rows()) + xapiText(store.rows(), {});
  for (const ExportedFile& file : csvFiles(store.rows())) all += file.text;
  EXPECT_EQ(all.find(std::to_string(real.session.rng_seed)), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(jsonText(store.rows())).at("block").at(0).at("state_json"), "");
  EXPECT_EQ(all.find(real.row.state_json), std::string::npos);
  EXPECT_EQ(all.find("Anna"), std::string::npos);
  // Nothing that looks like a mail address or a computer's.
  EXPECT_FALSE(std::regex_search(all, std::regex(R"([\w.]+@[\w]+\.\w+)")));
  EXPECT_FALSE(std::regex_search(all, std::regex(R"(\b\d{1,3}\.\d{1,3}\.\d{1,3}\.\d{1,3}\b)")));
  // Of one that is over, the state is what makes it a result that can be computed again.
  const RealSession over(SessionKind::pre_test, 1000);
  Store other(folder / "b.results", Store::Open::create_too);
  other.storeAnyRows(over.rows);
  EXPECT_NE(jsonText(other.rows()).find(std::to_string(over.session.rng_seed)), std::string::npos);
}

TEST(RecordsExport, JsonHoldsTheRowsThemselves) {
  const support::TemporaryFolder folder;
  Store store(folder / "a.results", Store::Open::create_too);
  const samples::History history = samples::history(1, 1, 3);
  store.storeAnyRows(history.rows);
  const auto json = nlohmann::ordered_json::parse(jsonText(store.rows()));
  std::size_t rows = 0;
  for (const AnyRow& row : history.rows) {
    for (const auto& object : json.at(std::string(kindOf(row)))) rows += object.dump() == rowJson(row) ? 1 : 0;
  }
  EXPECT_EQ(rows, history.rows.size());
}

TEST(RecordsExport, StatementsAreOfTheShapeThatRecordStoresTake) {
  const support::TemporaryFolder folder;
  Store store(folder / "a.results", Store::Open::create_too);
  const RealSession real(SessionKind::exam, 1000);
  ASSERT_TRUE(real.row.finished);
  store.storeAnyRows(real.rows);
  const std::string text = xapiText(store.rows(), {"https://school.example/"});
  EXPECT_EQ(text, xapiText(store.rows(), {"https://school.example/"}));
  const auto list = nlohmann::json::parse(text);
  std::set<std::string> ids;
  std::map<std::string, int> verbs;
  for (const auto& statement : list) {
    EXPECT_TRUE(std::regex_match(statement.at("id").get<std::string>(),
                                 std::regex("[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}")));
    ids.insert(statement.at("id"));
    EXPECT_EQ(statement.at("version"), "1.0.3");
    EXPECT_FALSE(statement.at("actor").contains("mbox"));
    EXPECT_EQ(statement.at("actor").at("account").at("homePage"), "https://school.example");
    EXPECT_EQ(statement.at("actor").at("account").at("name"), real.trainee.id);
    EXPECT_EQ(statement.at("object").at("objectType"), "Activity");
    EXPECT_EQ(statement.at("object").at("id").get<std::string>().rfind("https://school.example/", 0), 0u);
    EXPECT_TRUE(std::regex_match(statement.at("timestamp").get<std::string>(),
                                 std::regex(R"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z)")));
    const std::string verb = statement.at("verb").at("display").at("en");
    EXPECT_EQ(statement.at("verb").at("id"), "http://adlnet.gov/expapi/verbs/" + verb);
    ++verbs[verb];
    const bool scored = statement.contains("result") && statement["result"].contains("score");
    EXPECT_EQ(scored, verb == "passed" || verb == "failed");  // of progress there is no score
    if (!scored) continue;
    const double scaled = statement["result"]["score"]["scaled"];
    EXPECT_TRUE(scaled >= 0.0 && scaled <= 1.0);
  }
  EXPECT_EQ(ids.size(), list.size());
  EXPECT_EQ(verbs["initialized"], 1);
  EXPECT_EQ(verbs["answered"], store.rows().trialCount());
  EXPECT_EQ(verbs["completed"], 1);
  const bool decided = real.row.verdict == Verdict::pass || real.row.verdict == Verdict::not_yet;
  EXPECT_EQ(verbs["passed"] + verbs["failed"], decided ? 1 : 0);
}

std::string faultsOf(Store& store) {
  std::string all;
  for (const std::string& fault : verifyRecords(store).faults) all += fault + "\n";
  return all;
}

TEST(RecordsVerify, FindsNothingWrongWithWhatWasKept) {
  const support::TemporaryFolder folder;
  Store store(folder / "a.results", Store::Open::create_too);
  const RealSession real(SessionKind::pre_test, 25);
  store.storeAnyRows(real.rows);
  const Verified found = verifyRecords(store);
  EXPECT_EQ(faultsOf(store), "");
  EXPECT_TRUE(found.ok());
  EXPECT_EQ(found.trials, 25u);
  EXPECT_EQ(found.recomputed, 1u);
  EXPECT_EQ(found.trainees, 1u);
}

TEST(RecordsVerify, FindsEachThingThatIsWrong) {
  const RealSession real(SessionKind::pre_test, 12);
  struct Wrong {
    const char* sql;
    const char* says;
  };
  const std::vector<Wrong> wrongs = {
      {"DELETE FROM trial WHERE number = 12", "has 12 answers and 11 trials"},
      {"DELETE FROM trial WHERE number = 5", "trial 5 is missing"},
      {"UPDATE block SET threshold = threshold + 0.001", "its result does not match its answers"},
      {"UPDATE block SET trials = trials - 1", "its result does not match its answers"},
      {"UPDATE block SET state_json = '{'", "block "},
      {"UPDATE trial SET correct = 1 - correct WHERE number = 3", "its verdict does not match its sites"},
      {"UPDATE trial SET end_ms = start_ms - 1 WHERE number = 3", "ends before it begins"},
      {"UPDATE protocol SET sha256 = replace(sha256, substr(sha256, 1, 1), 'g')", "was changed after it was used"},
      {"UPDATE session SET file = 'sessions/x', file_sha256 = 'y'", "sessions/x is missing"},
      {"PRAGMA foreign_keys = OFF; DELETE FROM station", "belongs to one of 'station' that is not there"},
      {"ALTER TABLE trial DROP COLUMN seconds", "trial.seconds is missing"},
  };
  for (const Wrong& wrong : wrongs) {
    const support::TemporaryFolder folder;
    std::filesystem::remove_all(folder.path());
    Store store(folder / "a.results", Store::Open::create_too);
    store.storeAnyRows(real.rows);
    store.rows().sql().run(wrong.sql);
    EXPECT_NE(faultsOf(store).find(wrong.says), std::string::npos) << wrong.sql << "\n" << faultsOf(store);
  }
}

TEST(RecordsVerify, FindsRecordingFilesThatAreMissingChangedOrNobodys) {
  const support::TemporaryFolder folder;
  Store store(folder / "a.results", Store::Open::create_too);
  RealSession real(SessionKind::pre_test, 5);
  store.storeAnyRows(real.rows);
  RecordingFiles files(store);
  writeFile(folder / "plain", "samples");
  std::filesystem::create_directories(files.folder());
  const std::string ref = files.keyOf(real.trainee.id);
  const std::string name = RecordingFiles::nameFor(real.session.id) + ".locked";
  lockFile(folder / "plain", files.pathOf(name), *files.vault().find(ref), ref);
  real.session.file = name;
  real.session.file_sha256 = sha256OfFile(files.pathOf(name));
  const Row row = real.session;
  store.save(std::span(&row, 1));
  EXPECT_EQ(faultsOf(store), "");
  EXPECT_EQ(verifyRecords(store).recording_files, 1u);
  writeFile(files.folder() / (samples::id(8, 8) + ".session.locked"), "x");
  EXPECT_NE(faultsOf(store).find("belongs to no session"), std::string::npos);
  std::string bytes = readFile(files.pathOf(name), 1u << 20);
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  writeFile(files.pathOf(name), bytes);
  EXPECT_NE(faultsOf(store).find("was changed"), std::string::npos);
  files.vault().destroy(ref);
  EXPECT_NE(faultsOf(store).find("the key of the recording"), std::string::npos);
}

}  // namespace
}  // namespace palpate::training
