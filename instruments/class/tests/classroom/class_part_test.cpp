// What a class gives to training: stations, secrets, connections.
#include "palpate/classroom/class_part.h"

#include <gtest/gtest.h>

#include "palpate/classroom/class_folder.h"
#include "support/temporary_folder.h"

namespace palpate::classroom {
namespace {

ClassFolder makeSmallClass(const std::filesystem::path& folder) {
  ClassPlan plan;
  plan.class_id = "osteo-1";
  plan.port = 1;  // where no broker listens
  plan.retention = {.days = 30, .samples_days = 10};
  return makeClassFolder(folder, plan);
}

TEST(ClassPart, ReadsAStationAndTheSecretOfItsClass) {
  const support::TemporaryFolder folder;
  const ClassFolder made = makeSmallClass(folder / "class");
  const training::ClassPart part = makeClassPart();
  const training::ClassStation station = part.station(made.station("s01"));
  EXPECT_EQ(station.of.id, "osteo-1");
  EXPECT_EQ(station.of.retain_days, 30);
  EXPECT_EQ(station.of.retain_samples_days, 10);
  EXPECT_EQ(station.row.name, "s01");
  EXPECT_EQ(station.row.id, deriveStationId("osteo-1", "s01"));
  EXPECT_EQ(station.trainee_key, made.trainee_key);
  for (const std::filesystem::path& which : {made.folder, made.station("s01")}) {
    EXPECT_EQ(part.secret(which).class_id, "osteo-1") << which;
    EXPECT_EQ(part.secret(which).key, made.trainee_key) << which;
  }
}

TEST(ClassPart, AStationKeepsItsRowsForTheClassWhereNoBrokerAnswers) {
  const support::TemporaryFolder folder;
  const ClassFolder made = makeSmallClass(folder / "class");
  training::Store store(folder / "a.results", training::Store::Open::create_too);
  const training::ClassStation station = makeClassPart().station(made.station("s01"));
  const training::ClassLink link = station.connect(store, "palpate 0.9", "mouse");
  link.follow(nullptr);
  EXPECT_FALSE(link.pop_command());
  store.save(station.row);
  EXPECT_EQ(store.waitingCount(), 1U);
}

}  // namespace
}  // namespace palpate::classroom
