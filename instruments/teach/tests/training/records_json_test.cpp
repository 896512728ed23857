// Rows as JSON: the same row again, and nothing that a stranger sends gets through that is not exactly a row.
#include "palpate/training/records/row_json.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "palpate/base/random.h"
#include "palpate/training/records/row_fields.h"
#include "support/error_message.h"
#include "teach/tests/training/records_samples.h"

namespace palpate::training {
namespace {

using RowObject = nlohmann::ordered_json;

TrialRow sentTrial() {
  Random random(5);
  return samples::trial(samples::block(samples::session(samples::trainee(), 1), 1), 1, 1, random);
}

std::string refusalOfRow(std::string_view kind, const RowObject& object) {
  return support::thrownMessage([&] { rowFromJson(kind, object.dump()); });
}

TEST(RowJson, EveryKindIsReadBackAsItWas) {
  std::vector<AnyRow> rows = samples::history(1, 1, 3).rows;
  rows.emplace_back(DeletionRow{deletedMark("x"), 17});
  std::set<std::string_view> kinds;
  for (const AnyRow& row : rows) {
    const AnyRow back = rowFromJson(kindOf(row), rowJson(row));
    EXPECT_EQ(back.index(), row.index());
    EXPECT_EQ(rowJson(back), rowJson(row));
    EXPECT_EQ(outboxKey(back), outboxKey(row));
    EXPECT_EQ(rowJson(row).find('\n'), std::string::npos);
    kinds.insert(kindOf(row));
  }
  EXPECT_EQ(kinds.size(), std::variant_size_v<AnyRow>);
}

TEST(RowJson, KeepsAllBitsOfNumbers) {
  TrialRow trial = sentTrial();
  trial.change = 0.1 + 0.2;
  trial.seconds = std::numeric_limits<double>::denorm_min();
  SessionRow session = samples::session(samples::trainee(), 1);
  session.rng_seed = std::numeric_limits<std::uint64_t>::max();
  const auto trial_back = std::get<TrialRow>(rowFromJson("trial", rowJson(trial)));
  EXPECT_EQ(trial_back.change, trial.change);
  EXPECT_EQ(trial_back.seconds, trial.seconds);
  EXPECT_EQ(trial_back.visits.size(), trial.visits.size());
  EXPECT_EQ(std::get<SessionRow>(rowFromJson("session", rowJson(session))).rng_seed, session.rng_seed);
}

TEST(RowJson, SaysWhatIsWrongWithAMember) {
  const RowObject good = RowObject::parse(rowJson(sentTrial()));
  struct Wrong {
    const char* name;
    RowObject value;
    const char* says;
  };
  const std::vector<Wrong> wrongs = {
      {"id", "x", "'id' must be a UUID"},
      {"id", "018BCFE5-6801-7E5C-9C99-010000000000", "'id' must be a UUID"},
      {"id", "", "'id' is empty"},
      {"block_id", "../../../etc/passwd/../../etc/passwd", "'block_id' must be a UUID"},
      {"number", 1.5, "'number' must be a whole number"},
      {"number", -1, "'number' is -1, not within"},
      {"number", "1", "'number' must be a whole number"},
      {"number", std::numeric_limits<std::uint64_t>::max(), "not within"},
      {"change", -7, "trial: 'change' is -7, not within 0 to"},
      {"change", nullptr, "'change' must be a number"},
      {"kind", "measured_", "'kind' is not one of its words"},
      {"kind", 1, "'kind' is not one of its words"},
      {"correct", 1, "'correct' is neither true nor false"},
      {"excluded", std::string(201, 'x'), "'excluded' has 201 bytes, more than 200"},
      {"excluded", std::string("a\0b", 3), "'excluded' has bytes that are not text"},
      {"excluded", "a\x1b[31m", "'excluded' has bytes that are not text"},
      {"visits", 3, "'visits' must be a list"},
      {"visits", RowObject::array({1}), "visit: must be a JSON object"},
      {"surprise", 1, "trial: has unknown members"},
  };
  for (const Wrong& wrong : wrongs) {
    RowObject bad = good;
    bad[wrong.name] = wrong.value;
    const std::string said = refusalOfRow("trial", bad);
    EXPECT_NE(said.find(wrong.says), std::string::npos) << wrong.name << ": " << said;
  }
}

TEST(RowJson, MissingMembersAreRefusedButForThoseOfALaterVersion) {
  const RowObject good = RowObject::parse(rowJson(sentTrial()));
  for (const auto& [name, value] : good.items()) {
    RowObject bad = good;
    bad.erase(name);
    const bool later = name == "search_force_n" || name == "palpate_force_n" || name == "lumps";
    EXPECT_EQ(refusalOfRow("trial", bad) == "no error", later) << name;
  }
}

TEST(RowJson, PathsStayInTheFolder) {
  RowObject session = RowObject::parse(rowJson(samples::session(samples::trainee(), 1)));
  for (const char* file : {"/etc/passwd", "../x", "sessions/../../x", "..", "a\\b", "C:x"}) {
    session["file"] = file;
    EXPECT_NE(refusalOfRow("session", session).find("leads out of the folder"), std::string::npos) << file;
  }
  for (const char* file : {"sessions/a.session", "a..b", ""}) {
    session["file"] = file;
    EXPECT_EQ(refusalOfRow("session", session), "no error") << file;
  }
}

TEST(RowJson, RefusesWhatIsNoRow) {
  for (const char* text : {"", "{", "[]", "3", "null", "{\"id\":", "\xff\xfe"}) {
    EXPECT_NE(support::thrownMessage([&] { rowFromJson("trial", text); }), "no error") << text;
  }
  EXPECT_NE(support::thrownMessage([&] { rowFromJson("table; DROP", "{}"); }).find("is not a kind of row"),
            std::string::npos);
  const std::string long_text = "{\"id\":\"" + std::string(kLongestRowJson, 'x') + "\"}";
  EXPECT_NE(support::thrownMessage([&] { rowFromJson("trial", long_text); }).find("more than 65536"),
            std::string::npos);
  const std::string deep(60000, '[');
  EXPECT_NE(support::thrownMessage([&] { rowFromJson("trial", deep); }), "no error");
}

/// Whatever single byte a network changes: an error or a row, never anything else.
TEST(RowJson, AnyChangedByteIsRefusedOrStillARow) {
  const std::string good = rowJson(sentTrial());
  Random random(11);
  int refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string bad = good;
    bad[random.below(bad.size())] = static_cast<char>(random.below(256));
    if (i % 3 == 0) bad.resize(random.below(bad.size()));
    try {
      const AnyRow row = rowFromJson("trial", bad);
      EXPECT_EQ(rowJson(rowFromJson("trial", rowJson(row))), rowJson(row));
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 1500);
}

TEST(RowJson, OutboxKeysAreUuidsThatChangeWithTheState) {
  BlockRow block = samples::block(samples::session(samples::trainee(), 1), 1);
  const Uuid before = outboxKey(block);
  block.trials += 1;
  EXPECT_NE(outboxKey(block), before);
  EXPECT_EQ(before.size(), 36u);
  EXPECT_EQ(before[14], '8');
  const TrialRow trial = sentTrial();
  EXPECT_EQ(outboxKey(trial), trial.id);
}

}  // namespace
}  // namespace palpate::training
