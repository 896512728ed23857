// What any database of the records must do, SQLite or PostgreSQL: called by the tests of both with empty tables.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "palpate/training/records/row_tables.h"
#include "support/error_message.h"
#include "teach/tests/training/records_samples.h"

namespace palpate::training::suite {

inline void keepAll(RowTables& tables, const std::vector<AnyRow>& rows) {
  SqlTransaction transaction(tables.sql());
  for (const AnyRow& row : rows) tables.save(row);
  transaction.commit();
}

inline std::vector<std::string> sorted(std::vector<std::string> texts) {
  std::ranges::sort(texts);
  return texts;
}

/// Bit for bit, whichever order, and no more after keeping them again.
inline void rowsComeBack(RowTables& tables) {
  const samples::History history = samples::history(3, 2, 12);
  for (int time = 0; time < 2; ++time) {
    keepAll(tables, history.rows);
    EXPECT_EQ(sorted(samples::saidAll(tables.all())), sorted(samples::saidAll(history.rows)));
  }
  EXPECT_EQ(tables.trialCount(), static_cast<std::int64_t>(history.trials));
  const auto& trial = std::get<TrialRow>(history.rows[6]);
  ASSERT_TRUE(tables.trial(trial.id));
  EXPECT_EQ(rowJson(*tables.trial(trial.id)), rowJson(trial));
  EXPECT_FALSE(tables.trial("no id at all"));
}

inline void rowsAreBroughtUpToDate(RowTables& tables) {
  samples::History history = samples::history(1, 1, 2);
  keepAll(tables, history.rows);
  auto session = std::get<SessionRow>(history.rows[4]);
  auto block = std::get<BlockRow>(history.rows[5]);
  auto trial = std::get<TrialRow>(history.rows[6]);
  session.end_ms += 5;
  session.file = "sessions/x.session.locked";
  block.state_json = R"({"seed":"7","outcomes":[1]})";
  block.mastered_change = 0.07;
  trial.visits.resize(1);
  keepAll(tables, {session, block, trial});
  EXPECT_EQ(rowJson(*tables.session(session.id)), rowJson(session));
  EXPECT_EQ(rowJson(*tables.block(block.id)), rowJson(block));
  EXPECT_EQ(rowJson(*tables.trial(trial.id)), rowJson(trial));
}

inline void findsWhatWasInterruptedAndMeasured(RowTables& tables) {
  const TraineeRow who = samples::trainee();
  const SessionRow first = samples::session(who, 1), second = samples::session(who, 2),
                   practice = samples::session(who, 3, SessionKind::practice);
  BlockRow measured = samples::block(first, 1), stopped = samples::block(second, 2),
           practised = samples::block(practice, 3);
  stopped.finished = false;
  keepAll(tables,
          {samples::station(), samples::protocol(), who, first, second, practice, measured, stopped, practised});
  ASSERT_TRUE(tables.interrupted(who.id, SessionKind::pre_test));
  EXPECT_EQ(tables.interrupted(who.id, SessionKind::pre_test)->block.id, stopped.id);
  EXPECT_EQ(tables.interrupted(who.id, SessionKind::pre_test)->session.id, second.id);
  EXPECT_FALSE(tables.interrupted(who.id, SessionKind::practice));
  EXPECT_FALSE(tables.interrupted(samples::trainee("B").id, SessionKind::pre_test));
  ASSERT_TRUE(tables.lastMeasured(who.id));
  EXPECT_EQ(tables.lastMeasured(who.id)->id, measured.id);  // neither the interrupted nor the practice
  stopped.finished = true;
  keepAll(tables, {stopped});
  EXPECT_FALSE(tables.interrupted(who.id, SessionKind::pre_test));
  EXPECT_EQ(tables.lastMeasured(who.id)->id, stopped.id);
  const SessionRow latest = samples::session(who, 4, SessionKind::exam);
  BlockRow mastered = samples::block(latest, 4, 1), unanswered = samples::block(latest, 5, 2),
           stateless = samples::block(latest, 6, 3);
  mastered.method = Method::mastery;
  unanswered.threshold = unanswered.threshold_low = unanswered.threshold_high = 0.0;
  stateless.finished = false;
  stateless.state_json.clear();
  keepAll(tables, {latest, mastered, unanswered, stateless});
  EXPECT_FALSE(tables.interrupted(who.id, SessionKind::exam)) << "nothing to continue from";
  EXPECT_EQ(tables.lastMeasured(who.id)->id, stopped.id) << "neither a method without a threshold nor one of no answer";
}

/// Each row that must not be kept, and what is said of it.
inline void refusesWhatDoesNotFit(RowTables& tables) {
  const samples::History history = samples::history(1, 1, 3);
  keepAll(tables, history.rows);
  const std::vector<std::string> before = samples::saidAll(tables.all());
  const auto refused = [&](const AnyRow& row) {
    return support::thrownMessage([&] {
      SqlTransaction transaction(tables.sql());
      tables.save(row);
      transaction.commit();
    });
  };
  auto trial = std::get<TrialRow>(history.rows[6]);
  trial.id = samples::id(9, 1);
  EXPECT_NE(refused(trial).find("cannot be stored"), std::string::npos) << "the number is taken";
  trial.number = 99;
  trial.block_id = samples::id(9, 2);
  EXPECT_NE(refused(trial).find("before its block"), std::string::npos);
  trial.block_id = "x";
  EXPECT_NE(refused(trial).find("'block_id' must be a UUID"), std::string::npos);
  trial.block_id = std::get<TrialRow>(history.rows[6]).block_id;
  trial.change = -1.5;
  EXPECT_NE(refused(trial).find("'change' is -1.5"), std::string::npos);
  auto session = std::get<SessionRow>(history.rows[4]);
  session.id = samples::id(9, 3);
  session.trainee_id = samples::trainee("nobody").id;
  EXPECT_NE(refused(session).find("before its trainee"), std::string::npos);
  trial = std::get<TrialRow>(history.rows[6]);
  trial.seconds += 1.0;
  trial.visits.push_back(trial.visits.front());
  EXPECT_NE(refused(trial).find("cannot be stored"), std::string::npos) << "a site twice: the trial is not half kept";
  EXPECT_EQ(samples::saidAll(tables.all()), before);
}

inline void erasesOneAndLeavesTheOthers(RowTables& tables) {
  const samples::History history = samples::history(3, 2, 5);
  keepAll(tables, history.rows);
  const Uuid gone = history.trainees[1].id;
  std::vector<std::string> others;
  for (const std::string& text : samples::saidAll(tables.all())) others.push_back(text);
  tables.sql().change("INSERT INTO origin (subject, station_id) VALUES ($1, $2)", {gone, samples::station().id});
  EXPECT_TRUE(tables.erase(gone));
  EXPECT_FALSE(tables.erase(gone));
  EXPECT_EQ(tables.sql().number("SELECT count(*) FROM origin"), 0);
  const std::vector<std::string> left = samples::saidAll(tables.all());
  EXPECT_EQ(left.size(), others.size() - 1 - 2 * (1 + 1 + 5 + 1));
  EXPECT_TRUE(std::ranges::all_of(
      left, [&](const std::string& text) { return std::ranges::find(others, text) != others.end(); }));
  EXPECT_EQ(tables.sql().number("SELECT count(*) FROM site_visit WHERE trial_id NOT IN (SELECT id FROM trial)"), 0);
}

struct Case {
  const char* name;
  void (*run)(RowTables&);
};
inline const std::vector<Case>& cases() {
  static const std::vector<Case> all = {{"RowsComeBack", rowsComeBack},
                                        {"RowsAreBroughtUpToDate", rowsAreBroughtUpToDate},
                                        {"FindsWhatWasInterruptedAndMeasured", findsWhatWasInterruptedAndMeasured},
                                        {"RefusesWhatDoesNotFit", refusesWhatDoesNotFit},
                                        {"ErasesOneAndLeavesTheOthers", erasesOneAndLeavesTheOthers}};
  return all;
}

}  // namespace palpate::training::suite
