// Which rows a class keeps, in a file and in PostgreSQL alike: a station's own, not those of another, none of tomorrow,
// none of somebody who was deleted, and no more than its share.
#include "palpate/classroom/row_keeper.h"

#include <gtest/gtest.h>

#include <memory>

#include "class/tests/support/postgres_server.h"
#include "palpate/base/error.h"
#include "palpate/classroom/class_settings.h"
#include "palpate/classroom/postgres_sql.h"
#include "palpate/training/records/deletion.h"
#include "palpate/training/records/schema.h"
#include "palpate/training/records/store.h"
#include "teach/tests/training/records_samples.h"

namespace palpate::classroom {
namespace {

namespace keeping = training::samples;
using training::AnyRow;
using training::Uuid;

/// With `true` in PostgreSQL.
class RowKeeperTest : public testing::TestWithParam<bool> {
 protected:
  static void SetUpTestSuite() { server_ = support::PostgresServer::started().release(); }
  static void TearDownTestSuite() {
    delete server_;
    server_ = nullptr;
  }
  void SetUp() override {
    if (GetParam()) {
      if (server_ == nullptr) GTEST_SKIP() << support::PostgresServer::kNotInstalled;
      sql_ = std::make_unique<PostgresSql>(server_->connection("keeper"));
      sql_->connect();
      sql_->run("DROP SCHEMA public CASCADE; CREATE SCHEMA public");
      training::migrateSchema(*sql_, "keeper");
      tables_ = std::make_unique<training::RowTables>(*sql_);
    } else {
      store_ = std::make_unique<training::Store>(training::Store::inMemory("keeper"));
    }
    keeper_ = std::make_unique<RowKeeper>(tables(), KeeperRules{"osteo-1", 1 << 20});
  }
  training::RowTables& tables() { return store_ ? store_->rows() : *tables_; }

  static SentRow from(const std::string& name, AnyRow row, std::size_t bytes = 500) {
    return {std::move(row), name.empty() ? Uuid() : deriveStationId("osteo-1", name), name, bytes};
  }
  KeptRows save(const std::string& name, const std::vector<AnyRow>& rows) {
    std::vector<SentRow> sent;
    for (const AnyRow& row : rows) sent.push_back(from(name, row));
    return keeper_->save(sent);
  }
  std::string why(const std::string& name, const AnyRow& row) {
    const KeptRows kept = save(name, {row});
    return kept.refused.empty() ? std::string() : kept.refused.front().why;
  }

  static training::StationRow station(const std::string& name) {
    return {deriveStationId("osteo-1", name), name, "", "Touch", keeping::kMonday};
  }
  static training::SessionRow session(const std::string& name, const training::TraineeRow& of, std::uint64_t number) {
    training::SessionRow row = keeping::session(of, number);
    row.station_id = deriveStationId("osteo-1", name);
    return row;
  }
  /// A trainee of this station with a session, a block and two trials.
  std::vector<AnyRow> day(const std::string& name, const std::string& code, std::uint64_t number) {
    const auto who = keeping::trainee(code);
    const auto sat = session(name, who, number);
    const auto block = keeping::block(sat, number);
    Random random(number);
    return {station(name),
            keeping::protocol(),
            who,
            sat,
            block,
            keeping::trial(block, number * 100 + 1, 1, random),
            keeping::trial(block, number * 100 + 2, 2, random),
            keeping::event(sat, number)};
  }
  std::vector<std::string> all() { return keeping::saidAll(tables().all()); }

  static support::PostgresServer* server_;
  std::unique_ptr<PostgresSql> sql_;
  std::unique_ptr<training::RowTables> tables_;
  std::unique_ptr<training::Store> store_;
  std::unique_ptr<RowKeeper> keeper_;
};
support::PostgresServer* RowKeeperTest::server_ = nullptr;
INSTANTIATE_TEST_SUITE_P(Both, RowKeeperTest, testing::Bool(),
                         [](const auto& tried) { return tried.param ? "PostgreSql" : "Sqlite"; });

const training::DeletionRow kOfA{training::deletedMark(keeping::trainee("A").id), 1};
/// A station has heard of it.
const training::DeletionRow kHeardOfA{training::deletedMark(keeping::trainee("A").id), 0};

TEST_P(RowKeeperTest, AStationWritesNoRowOfAnother) {
  const std::vector<AnyRow> theirs = day("s01", "A", 1);
  EXPECT_EQ(save("s01", theirs).keys.size(), theirs.size());
  save("s01", day("s01", "B", 5));
  const std::vector<std::string> before = all();
  auto station_row = std::get<training::StationRow>(theirs[0]);
  station_row.calibrated_ms += 1;
  station_row.name = "mine";
  EXPECT_EQ(why("s02", station_row), "another station's row");
  auto trainee = std::get<training::TraineeRow>(theirs[2]);
  trainee.class_id = "invented";
  EXPECT_EQ(why("s02", trainee), "another class for a trainee of another station");
  auto session_row = std::get<training::SessionRow>(theirs[3]);
  session_row.end_ms += 1;
  EXPECT_EQ(why("s02", session_row), "a session at another station");
  session_row.station_id = deriveStationId("osteo-1", "s02");
  save("s02", {station("s02")});
  EXPECT_EQ(why("s02", session_row), "a session of another station");
  auto block = std::get<training::BlockRow>(theirs[4]);
  block.threshold = 0.9;
  // What belongs to a row that was refused is answered alike.
  EXPECT_EQ(why("s02", block), "a session of another station");
  Random random(9);
  EXPECT_EQ(why("s02", keeping::trial(block, 999, 3, random)), "a session of another station");
  EXPECT_EQ(why("s02", keeping::event(std::get<training::SessionRow>(theirs[3]), 9)), "a session of another station");
  // Of one that was not asked about before: by itself.
  const std::vector<AnyRow> more = day("s01", "B", 5);
  EXPECT_EQ(why("s02", more[5]), "a trial of another station");
  EXPECT_EQ(why("s02", more[7]), "an event of another station");
  EXPECT_EQ(why("s02", more[4]), "a block of another station");
  // A block of theirs into a session of one's own.
  const auto own = session("s02", keeping::trainee("A"), 7);
  EXPECT_EQ(save("s02", {own}).keys.size(), 1u) << "the same trainee may sit elsewhere";
  block.session_id = own.id;
  EXPECT_EQ(why("s02", block), "a block of another station");
  std::vector<std::string> after = all();
  std::erase_if(after, [&](const std::string& text) { return std::ranges::find(before, text) == before.end(); });
  EXPECT_EQ(after, before);
}

TEST_P(RowKeeperTest, ARowThatIsRefusedDoesNotKeepOthersWaiting) {
  save("s01", day("s01", "A", 1));
  std::vector<AnyRow> copied = day("s01", "B", 2);  // another station's records, carried to s02
  const KeptRows kept = save("s02", copied);
  EXPECT_EQ(kept.refused.size(), 6u);  // station, session, and what belongs to it
  EXPECT_TRUE(kept.waits.empty()) << kept.waits.front().why;
  EXPECT_EQ(save("s02", day("s02", "C", 3)).keys.size(), 8u);
}

TEST_P(RowKeeperTest, ATraineeMaySitAtSeveralStationsAndStaysWhoTheyAre) {
  save("s01", day("s01", "A", 1));
  std::vector<AnyRow> second = day("s02", "A", 2);
  std::get<training::TraineeRow>(second[2]).dominant_hand = "left";
  EXPECT_EQ(save("s02", second).keys.size(), second.size());
  EXPECT_EQ(tables().trainee(keeping::trainee("A").id)->dominant_hand, "right");
  EXPECT_EQ(tables().sessions(keeping::trainee("A").id).size(), 2u);
}

TEST_P(RowKeeperTest, RowsOfBeforeAStationJoinedAreItsOwn) {
  std::vector<AnyRow> before = day("s01", "A", 1);
  const auto old = keeping::station();  // an id made at random
  before[0] = old;
  std::get<training::SessionRow>(before[3]).station_id = old.id;
  EXPECT_EQ(save("s01", before).keys.size(), before.size());
  EXPECT_EQ(why("s02", old), "another station's row");
  EXPECT_EQ(why("s02", before[3]), "a session at another station");
  EXPECT_EQ(save("s01", before).keys.size(), before.size());
}

TEST_P(RowKeeperTest, NothingIsDatedAfterNow) {
  const std::int64_t now_ms = training::utcMs();
  std::vector<AnyRow> rows = day("s01", "A", 1);
  save("s01", {rows[0]});
  auto trainee = std::get<training::TraineeRow>(rows[2]);
  trainee.created_ms = now_ms + kClockSkewMs + 90'000;
  EXPECT_EQ(why("s01", trainee).rfind("dated 3 min after now", 0), 0u) << why("s01", trainee);
  rows[2] = trainee;
  const KeptRows kept = save("s01", rows);
  EXPECT_EQ(kept.refused.size(), 6u) << "with all that belongs to it";
  EXPECT_TRUE(kept.waits.empty());
  trainee.created_ms = now_ms + kClockSkewMs / 2;
  rows[2] = trainee;
  EXPECT_EQ(save("s01", rows).keys.size(), rows.size()) << "clocks of a class differ a little";
}

TEST_P(RowKeeperTest, ClocksMayDifferByTwoMinutes) {
  auto trainee = std::get<training::TraineeRow>(day("s01", "A", 1)[2]);
  save("s01", {station("s01")});
  constexpr std::int64_t kSlowTestMs = 60'000;
  trainee.created_ms = training::utcMs() + 119'900;
  EXPECT_EQ(why("s01", trainee), "");
  trainee.id = keeping::trainee("B").id;
  trainee.created_ms = training::utcMs() + 120'000 + kSlowTestMs;
  EXPECT_EQ(why("s01", trainee).rfind("dated ", 0), 0u) << why("s01", trainee);
}

TEST_P(RowKeeperTest, AStationHasTwoHundredAndFiftySixMegabytes) {
  RowKeeper usual(tables(), KeeperRules{"osteo-1"});
  const auto refused = [&](const std::string& name, const AnyRow& row, std::size_t bytes) {
    const std::vector<SentRow> sent = {from(name, row, bytes)};
    return usual.save(sent).refused.size();
  };
  constexpr std::size_t kInTheDatabase = 200;  // each row takes so much more there
  constexpr std::size_t kShare = (std::size_t{256} << 20) - kInTheDatabase;
  EXPECT_EQ(refused("s01", station("s01"), kShare - 500), 0u);
  EXPECT_EQ(refused("s01", keeping::trainee("A"), 500), 0u) << "the last bytes of it";
  EXPECT_EQ(refused("s01", keeping::trainee("B"), 1), 1u);
  EXPECT_EQ(refused("s02", station("s02"), kShare - 500), 0u);
  EXPECT_EQ(refused("s02", keeping::trainee("C"), 501), 1u);
}

TEST_P(RowKeeperTest, AStationsNoticeTakesAwayItsOwnRowsAndSaysWhatIsLeft) {
  save("s01", day("s01", "A", 1));
  save("s02", day("s02", "A", 2));
  save("s02", day("s02", "B", 3));
  const KeptRows kept = save("s01", {kOfA});
  EXPECT_EQ(kept.keys.size(), 1u);
  ASSERT_EQ(kept.reports.size(), 1u);
  EXPECT_NE(kept.reports[0].find("s01 deleted a trainee: 1 of its sessions are gone; not deleted: 1 of s02"),
            std::string::npos)
      << kept.reports[0];
  ASSERT_EQ(tables().sessions(keeping::trainee("A").id).size(), 1u);
  EXPECT_EQ(save("s02", {kOfA}).reports.size(), 0u);
  EXPECT_FALSE(tables().trainee(keeping::trainee("A").id));
  EXPECT_TRUE(tables().trainee(keeping::trainee("B").id));
  // Of a notice that means nobody nothing is remembered.
  const auto notes = [&] { return tables().sql().number("SELECT count(*) FROM audit"); };
  const std::int64_t before = notes();
  save("s02", {training::DeletionRow{training::deletedMark("nobody"), 1}});
  EXPECT_EQ(notes(), before);
}

TEST_P(RowKeeperTest, DeletionGoesByArrivalAndNotByClocks) {
  std::vector<AnyRow> rows = day("s01", "A", 1);
  std::get<training::TraineeRow>(rows[2]).created_ms = training::utcMs() + 100'000;  // a clock that is ahead
  save("s01", rows);
  save("s01", {kOfA});  // dated 1970
  EXPECT_FALSE(tables().trainee(keeping::trainee("A").id));
  // A notice of the year 9999 says nothing about what comes later.
  save("s01", {training::DeletionRow{kOfA.trainee_sha256, 253402300799999}});
  const std::vector<AnyRow> later = day("s01", "A", 2);
  EXPECT_EQ(save("s01", later).keys.size(), later.size());
  EXPECT_EQ(tables().sessions(keeping::trainee("A").id).size(), 1u);
  // What was sent again of before stays away.
  rows.erase(rows.begin() + 2);
  EXPECT_EQ(save("s01", rows).keys.size(), rows.size());
  EXPECT_EQ(tables().sessions(keeping::trainee("A").id).size(), 1u);
}

TEST_P(RowKeeperTest, InOneBatchADeletionStandsWhereItArrived) {
  std::vector<AnyRow> batch = day("s01", "A", 1);
  batch.emplace_back(kOfA);
  for (const AnyRow& row : day("s01", "A", 2)) batch.push_back(row);
  EXPECT_EQ(save("s01", batch).keys.size(), batch.size());
  const auto left = tables().sessions(keeping::trainee("A").id);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left[0].id, keeping::session(keeping::trainee("A"), 2).id);
}

TEST_P(RowKeeperTest, ADeletionInTheClassHoldsForEachStationUntilItHasHeardOfIt) {
  save("s01", day("s01", "A", 1));
  save("s02", day("s02", "A", 2));
  {
    training::SqlTransaction transaction(tables().sql());
    EXPECT_TRUE(keeper_->erase(keeping::trainee("A").id, "palpate train results"));
    transaction.commit();
  }
  KeptRows late = save("s02", day("s02", "A", 3));
  EXPECT_EQ(late.keys.size(), 8u) << "acknowledged, so that it is not sent for ever";
  EXPECT_FALSE(tables().trainee(keeping::trainee("A").id));
  EXPECT_EQ(late.notices[deriveStationId("osteo-1", "s02")], std::vector{kOfA.trainee_sha256});
  EXPECT_TRUE(save("s02", {kHeardOfA}).notices.empty());
  EXPECT_EQ(save("s02", day("s02", "A", 4)).keys.size(), 8u);
  EXPECT_EQ(tables().sessions(keeping::trainee("A").id).size(), 1u) << "signed in after it was heard of";
  save("s02", {kHeardOfA});  // once more deletes nothing
  EXPECT_EQ(tables().sessions(keeping::trainee("A").id).size(), 1u);
  save("s01", day("s01", "A", 5));
  EXPECT_EQ(tables().sessions(keeping::trainee("A").id).size(), 1u) << "the other station has not heard yet";
}

TEST_P(RowKeeperTest, TheTeacherDeletesForAllStations) {
  save("s01", day("s01", "A", 1));
  save("s02", day("s02", "A", 2));
  EXPECT_TRUE(save("", {kOfA}).reports.empty());
  EXPECT_FALSE(tables().trainee(keeping::trainee("A").id));
  EXPECT_FALSE(save("s02", {station("s02")}).notices.empty());
}

TEST_P(RowKeeperTest, HowLongAClassKeepsThingsIsSaidByNoStation) {
  save("s01", {training::ClassRow{"invented", "x", 0, 0}, training::ClassRow{"osteo-1", "y", 0, 0}});
  const auto classes = tables().classes();
  ASSERT_EQ(classes.size(), 1u);
  EXPECT_EQ(classes[0].id, "invented");
  EXPECT_EQ(classes[0].retain_days, training::ClassRow().retain_days);
}

TEST_P(RowKeeperTest, AStationHasItsShareOfTheDiskAndOthersTheirs) {
  save("s01", {station("s01")});
  save("s02", {station("s02")});
  std::size_t kept = 0;
  std::string last;
  for (int version = 1; version <= 40; ++version) {
    auto protocol = keeping::protocol();
    protocol.version = version;
    const SentRow row = from("s02", protocol, 60'000);
    const KeptRows found = keeper_->save({&row, 1});
    kept += found.keys.size();
    if (!found.refused.empty()) last = found.refused.front().why;
  }
  EXPECT_EQ(kept, 17u);  // of 60 kB in a megabyte
  EXPECT_NE(last.find("1 MB since the last purge"), std::string::npos) << last;
  EXPECT_EQ(save("s01", day("s01", "A", 1)).keys.size(), 8u);
  EXPECT_EQ(save("s02", {kOfA}).keys.size(), 1u) << "who wants to be deleted is heard all the same";
  training::forgetSentBytes(tables().sql());
  EXPECT_EQ(save("s02", day("s02", "B", 2)).keys.size(), 8u);
}

}  // namespace
}  // namespace palpate::classroom
