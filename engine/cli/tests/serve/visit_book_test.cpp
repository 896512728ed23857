// Who has to go when `palpate serve` has too many requests to answer.
#include "cli/serve/visit_book.h"

#include <gtest/gtest.h>

namespace palpate::app::serving {
namespace {

constexpr VisitLimits kFewVisits = {.strangers = 4, .strangers_of_one = 3, .known = 2};

TEST(VisitBook, ALateStrangerGetsInForTheOneThatGotNowhereForLongest) {
  VisitBook book(kFewVisits);
  for (VisitId id = 1; id <= 4; ++id) EXPECT_EQ(book.enter(id, "", static_cast<double>(id)), 0u);
  book.moved(1, 5.0);
  EXPECT_EQ(book.enter(5, "", 6.0), 2u);
  EXPECT_EQ(book.enter(6, "", 7.0), 3u);
  EXPECT_EQ(book.size(), 4u);
}

TEST(VisitBook, OneClientHasItsShareAndOthersKeepTheirs) {
  VisitBook book(kFewVisits);
  EXPECT_EQ(book.enter(1, "other", 0.0), 0u);
  for (VisitId id = 2; id <= 4; ++id) EXPECT_EQ(book.enter(id, "greedy", 1.0), 0u);
  EXPECT_EQ(book.enter(5, "greedy", 2.0), 2u) << "its own fourth";
  EXPECT_EQ(book.enter(6, "third", 3.0), 3u) << "too many of all: of the client that has most";
  EXPECT_EQ(book.enter(7, "fourth", 4.0), 4u);
}

TEST(VisitBook, OnThisComputerThereIsNoShareForAProxyBringsEverybody) {
  VisitBook book(kFewVisits);
  for (VisitId id = 1; id <= 4; ++id) EXPECT_EQ(book.enter(id, "", 0.0), 0u);
}

TEST(VisitBook, NoStrangerCostsOneThatShowedATokenItsPlace) {
  VisitBook book(kFewVisits);
  EXPECT_EQ(book.enter(1, "", 0.0), 0u);
  EXPECT_EQ(book.markTokenShown(1, 0.0), 0u);
  for (VisitId id = 2; id <= 100; ++id) EXPECT_NE(book.enter(id, "", static_cast<double>(id)), 1u);
  EXPECT_EQ(book.size(), 5u);
  EXPECT_EQ(book.markTokenShown(100, 200.0), 0u);
  EXPECT_EQ(book.markTokenShown(99, 201.0), 1u) << "tokens have room of their own, for so many";
  EXPECT_EQ(book.markTokenShown(99, 202.0), 0u) << "once each";
  EXPECT_EQ(book.markTokenShown(1, 203.0), 0u) << "who is gone is gone";
}

TEST(VisitBook, WhoLeavesMakesRoom) {
  VisitBook book(kFewVisits);
  for (VisitId id = 1; id <= 4; ++id) book.enter(id, "", 0.0);
  book.leave(2);
  EXPECT_EQ(book.enter(5, "", 1.0), 0u);
  book.moved(2, 2.0);
  EXPECT_EQ(book.size(), 4u);
}

}  // namespace
}  // namespace palpate::app::serving
