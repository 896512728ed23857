// What a station sends of its outbox: not faster than allowed, again after a while, little as long as nobody answers;
// and no command after its time.
#include "palpate/classroom/outbox_sender.h"

#include <gtest/gtest.h>

namespace palpate::classroom {
namespace {

Clock::time_point at(double s) { return Clock::time_point(std::chrono::milliseconds(static_cast<int>(1000.0 * s))); }

TEST(OutboxSenderTest, SendsAtMostFiftyRowsASecond) {
  OutboxSender sender({}, at(0.0));
  int sent = 0;
  for (int ms = 0; ms < 10000; ++ms) sent += sender.consumeToken(at(0.001 * ms)) ? 1 : 0;
  EXPECT_GE(sent, 490);
  EXPECT_LE(sent, 510);
}

TEST(OutboxSenderTest, ARowIsSentAgainAfterThreeSecondsAndNotBefore) {
  OutboxSender sender({}, at(0.0));
  EXPECT_TRUE(sender.due("a", at(1.0)));
  sender.sent("a", at(1.0));
  EXPECT_FALSE(sender.due("a", at(3.9)));
  EXPECT_TRUE(sender.due("a", at(4.1)));
}

TEST(OutboxSenderTest, WithoutAnAnswerOnlyAFewRowsAreTriedAgain) {
  OutboxSender sender({}, at(0.0));
  EXPECT_EQ(sender.window(at(0.0)), 200U);
  sender.sent("a", at(0.0));
  EXPECT_TRUE(sender.due("a", at(4.0)));
  EXPECT_EQ(sender.window(at(4.0)), 20U);
  EXPECT_LE(sender.window(at(10.0)), 40U);
  EXPECT_EQ(sender.window(at(60.0)), 200U) << "rows that nobody takes must not hold up the others for ever";
  sender.acknowledged();
  EXPECT_EQ(sender.window(at(5.0)), 200U);
}

TEST(OutboxSenderTest, WhatLeftTheOutboxIsForgotten) {
  OutboxSender sender({}, at(0.0));
  sender.sent("a", at(0.0));
  sender.sent("b", at(0.0));
  sender.restrictTo({{1, "trial", "b", "{}"}});
  EXPECT_TRUE(sender.due("a", at(1.0)));
  EXPECT_FALSE(sender.due("b", at(1.0)));
}

TEST(CommandQueueTest, ACommandExpiresAfterTenSeconds) {
  CommandQueue queue;
  queue.put({CommandKind::pause, {}}, at(0.0));
  queue.put({CommandKind::message, "now"}, at(5.0));
  const auto taken = queue.popCommand(at(11.0));
  ASSERT_TRUE(taken);
  EXPECT_EQ(taken->text, "now");
  EXPECT_FALSE(queue.popCommand(at(11.0)));
}

TEST(CommandQueueTest, KeepsTheNewestOfTooMany) {
  CommandQueue queue;
  for (int i = 0; i < 100; ++i) queue.put({CommandKind::message, std::to_string(i)}, at(0.0));
  EXPECT_EQ(queue.popCommand(at(0.0))->text, "68");
}

}  // namespace
}  // namespace palpate::classroom
