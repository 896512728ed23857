#include "view/viewer/state/messages.h"

#include <gtest/gtest.h>

namespace palpate::viewer {
namespace {

TEST(Messages, InfosAndWarningsLeaveByThemselvesErrorsDoNot) {
  Messages messages;
  messages.add(Severity::info, "saved", 0.0);
  ASSERT_NE(messages.toast(1.0), nullptr);
  EXPECT_EQ(messages.toast(kInfoS + 0.1), nullptr);
  messages.add(Severity::warning, "slow", 10.0);
  EXPECT_NE(messages.toast(10.0 + kWarningS - 0.1), nullptr);
  EXPECT_EQ(messages.toast(10.0 + kWarningS + 0.1), nullptr);
  messages.add(Severity::error, "broken", 30.0);
  EXPECT_EQ(messages.toast(1e6)->text, "broken");
  messages.dismiss();
  EXPECT_EQ(messages.toast(1e6), nullptr);
  EXPECT_EQ(messages.all().size(), 3u);
  EXPECT_EQ(messages.unread(), 2u);
}

TEST(Messages, AnErrorGoesBeforeWhatComesLater) {
  Messages messages;
  messages.add(Severity::error, "first", 0.0);
  messages.add(Severity::info, "later", 1.0);
  EXPECT_EQ(messages.toast(1.0)->text, "first");
  messages.dismiss();
  EXPECT_EQ(messages.toast(1.0)->text, "later");
}

TEST(Messages, SuccessClearsTheErrorsOfTheSameThing) {
  Messages messages;
  messages.add(Severity::error, "cannot open a.obj: nonsense", 0.0);
  messages.add(Severity::error, "cannot save", 0.0);
  messages.clearErrors("cannot open");
  EXPECT_EQ(messages.toast(0.0)->text, "cannot save");
}

}  // namespace
}  // namespace palpate::viewer
