// A head as an OpenXR runtime sees it: the double of a runtime (doubles/openxr_double.cpp), and the system's own where
// there is one.
#include "palpate/device/head/openxr_head.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>
#include <thread>

#include "host/tests/device/doubles/double_library.h"
#include "host/tests/device/doubles/openxr_control.h"
#include "palpate/base/error.h"
#include "palpate/device/head/head_stream.h"
#include "support/error_message.h"

namespace palpate::device {
namespace {

// Numbers of the specification, not those of the code that is tested.
enum SpecifiedState { kStateIdle = 1, kStateReady = 2, kStateStopping = 6, kStateLossPending = 7, kStateExiting = 8 };
enum SpecifiedError { kErrorInstanceLost = -13, kErrorSessionLost = -17, kErrorTimeInvalid = -30 };

/// The double as it was when it was loaded; at the end no call broke the specification and no instance is left.
class OpenXrHeadset : public testing::Test {
 protected:
  void SetUp() override {
    void* handle = ::dlopen(library_.c_str(), RTLD_LAZY | RTLD_GLOBAL);
    ASSERT_NE(handle, nullptr) << ::dlerror();
    control_ = reinterpret_cast<doubles::OpenXrControlFunction*>(::dlsym(handle, "palpateOpenXrDouble"))();
    *control_ = {};
  }
  void TearDown() override {
    ASSERT_NE(control_, nullptr);
    EXPECT_EQ(control_->breaches, 0) << control_->last_breach;
    EXPECT_EQ(control_->instances, 0);
  }

  std::string refusal() const {
    return support::thrownMessage([this] { const OpenXrHead head(library_); });
  }

  const std::string library_ = doubles::libraryOf("openxr");
  doubles::OpenXrControl* control_ = nullptr;
};

/// Floats of metres are within a hundredth of a millimetre of what was meant.
void expectPlace(const std::optional<Vec3>& place, const Vec3& mm) {
  ASSERT_TRUE(place);
  EXPECT_LT((*place - mm).norm(), 0.01) << place->transpose();
}

TEST_F(OpenXrHeadset, LocatesTheHeadFromWhereItWasFirstSeen) {
  control_->place_m = {0.3f, 1.6f, -0.2f};
  OpenXrHead head(library_);
  expectPlace(head.newest(), Vec3(0.0, 0.0, 0.0));
  control_->place_m = {0.35f, 1.58f, -0.1f};  // to the right, down, back from the screen
  expectPlace(head.newest(), Vec3(50.0, -20.0, 100.0));
  expectPlace(head.newest(), Vec3(50.0, -20.0, 100.0));
  control_->place_m = {0.25f, 1.6f, -0.3f};
  expectPlace(head.newest(), Vec3(-50.0, 0.0, -100.0));
  EXPECT_EQ(control_->begun, 1);
}

TEST_F(OpenXrHeadset, NothingIsAskedForBeforeTheSessionIsReady) {
  control_->questions_before_ready = 3;
  OpenXrHead head(library_);
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(head.newest()) << i;
  EXPECT_EQ(control_->located, 0);
  EXPECT_EQ(control_->questions, 3) << "one a picture: it does not wait";
  EXPECT_TRUE(head.newest());
}

TEST_F(OpenXrHeadset, SaysWhichPartIsMissing) {
  const std::string no_loader = support::thrownMessage([] { const OpenXrHead head("/nowhere/libopenxr_loader.so.1"); });
  EXPECT_NE(no_loader.find("/nowhere/libopenxr_loader.so.1: cannot open"), std::string::npos) << no_loader;
  EXPECT_NE(no_loader.find("libopenxr-loader1"), std::string::npos) << no_loader;
  EXPECT_NE(no_loader.find("PALPATE_OPENXR_LOADER="), std::string::npos) << no_loader;
  const std::string other = support::thrownMessage([] { const OpenXrHead head("libm.so.6"); });
  EXPECT_NE(other.find("lacks xrGetInstanceProcAddr"), std::string::npos) << other;
  control_->runtime = false;
  EXPECT_NE(refusal().find("no OpenXR runtime is active (result -51)"), std::string::npos) << refusal();
  control_->runtime = true;
  control_->headless = false;
  EXPECT_NE(refusal().find("runtime lacks XR_MND_headless"), std::string::npos) << refusal();
  control_->headless = true;
  control_->timespec = false;
  EXPECT_NE(refusal().find("runtime lacks XR_KHR_convert_timespec_time"), std::string::npos) << refusal();
  control_->timespec = true;
  control_->starts = false;
  EXPECT_NE(refusal().find("runtime does not start (result -2)"), std::string::npos) << refusal();
  control_->starts = true;
  control_->headset = false;
  EXPECT_NE(refusal().find("finds no headset"), std::string::npos) << refusal();
  EXPECT_EQ(refusal().find('\n'), std::string::npos);
  control_->headset = true;
  EXPECT_EQ(refusal(), "no error");
}

TEST_F(OpenXrHeadset, TheEnvironmentNamesTheLoader) {
  ASSERT_EQ(::setenv("PALPATE_OPENXR_LOADER", library_.c_str(), 1), 0);
  OpenXrHead head;
  EXPECT_EQ(::unsetenv("PALPATE_OPENXR_LOADER"), 0);
  EXPECT_TRUE(head.newest());
  EXPECT_EQ(control_->instances, 1);
}

TEST_F(OpenXrHeadset, AnInvalidPoseIsNotSeen) {
  control_->place_m = {5.0f, 5.0f, 5.0f};
  control_->flags = 1;  // the turn alone
  OpenXrHead head(library_);
  EXPECT_FALSE(head.newest());
  control_->flags = 0xf;
  control_->place_m = {0.0f, std::numeric_limits<float>::quiet_NaN(), 0.0f};
  EXPECT_FALSE(head.newest());
  control_->place_m = {0.0f, 0.0f, std::numeric_limits<float>::infinity()};
  EXPECT_FALSE(head.newest());
  control_->place_m = {0.0f, 1.0f, 0.0f};
  control_->locating = kErrorTimeInvalid;
  EXPECT_FALSE(head.newest());
  control_->locating = 0;
  expectPlace(head.newest(), Vec3(0.0, 0.0, 0.0));
  control_->flags = 2;  // the place alone, and not by sight
  control_->place_m = {0.1f, 1.0f, 0.0f};
  expectPlace(head.newest(), Vec3(100.0, 0.0, 0.0));
}

TEST_F(OpenXrHeadset, TooFarIsNotSeen) {
  OpenXrHead head(library_);
  EXPECT_TRUE(head.newest());
  control_->place_m = {0.0f, 0.0f, 2.001f};
  EXPECT_FALSE(head.newest());
  control_->place_m = {0.0f, 3.4e38f, 0.0f};
  EXPECT_FALSE(head.newest());
  control_->place_m = {1.5f, 1.5f, 0.0f};
  EXPECT_FALSE(head.newest()) << "along a diagonal";
  control_->place_m = {0.0f, 0.0f, 1.999f};
  expectPlace(head.newest(), Vec3(0.0, 0.0, 1999.0));
}

TEST_F(OpenXrHeadset, IsMeasuredAnewFromWhereTheUserCentresIt) {
  control_->place_m = {1.0f, 0.0f, 0.0f};
  OpenXrHead head(library_);
  EXPECT_TRUE(head.newest());
  control_->place_m = {1.1f, 0.0f, 0.0f};
  control_->centred_in_ns = 3'600'000'000'000;
  expectPlace(head.newest(), Vec3(100.0, 0.0, 0.0));
  control_->place_m = {0.0f, 0.0f, 0.0f};
  control_->centred_in_ns = 0;
  expectPlace(head.newest(), Vec3(0.0, 0.0, 0.0));
  control_->place_m = {0.0f, 0.0f, 0.02f};
  expectPlace(head.newest(), Vec3(0.0, 0.0, 20.0));
}

TEST_F(OpenXrHeadset, RestsWhileTheSessionIsStopped) {
  OpenXrHead head(library_);
  EXPECT_TRUE(head.newest());
  control_->next_state = kStateStopping;
  EXPECT_FALSE(head.newest());
  EXPECT_EQ(control_->ended, 1);
  control_->next_state = kStateIdle;
  EXPECT_FALSE(head.newest());
  control_->next_state = kStateReady;
  control_->place_m = {0.03f, 0.0f, 0.0f};
  expectPlace(head.newest(), Vec3(30.0, 0.0, 0.0));
  EXPECT_EQ(control_->begun, 2);
}

TEST_F(OpenXrHeadset, GoesQuietWhenTheSessionIsLost) {
  const auto goes_quiet = [this](const char* how, const auto& lose) {
    *control_ = {};
    OpenXrHead head(library_);
    EXPECT_TRUE(head.newest()) << how;
    lose();
    EXPECT_FALSE(head.newest()) << how;
    control_->locating = 0;
    const int questions = control_->questions;
    const int located = control_->located;
    EXPECT_FALSE(head.newest()) << how;
    EXPECT_EQ(control_->questions, questions) << how << ": a runtime that is gone is left alone";
    EXPECT_EQ(control_->located, located) << how;
  };
  goes_quiet("session lost", [this] { control_->locating = kErrorSessionLost; });
  goes_quiet("instance lost", [this] { control_->locating = kErrorInstanceLost; });
  goes_quiet("loss of the session is near", [this] { control_->next_state = kStateLossPending; });
  goes_quiet("the user ends it", [this] { control_->next_state = kStateExiting; });
  goes_quiet("loss of the instance is near", [this] { control_->instance_lost = true; });
}

TEST(OpenXrSystem, FollowsTheHeadsetOfTheSystemsOwnRuntime) {
  std::optional<OpenXrHead> head;
  try {
    head.emplace();
  } catch (const Error& error) {
    const std::string cause = error.what();
    for (const char* missing : {"does not load", "no OpenXR runtime is active", "runtime lacks XR_MND_headless",
                                "runtime does not start", "finds no headset"}) {
      if (cause.find(missing) != std::string::npos) GTEST_SKIP() << cause;
    }
    FAIL() << cause;
  }
  std::optional<Vec3> first;
  for (int i = 0; i < 200 && !first; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    first = head->newest();
  }
  if (!first) GTEST_SKIP() << "the headset does not know where it is: is it worn?";
  EXPECT_EQ(first->norm(), 0.0) << "measured from where it was first seen";
  double farthest = 0.0;
  for (int i = 0; i < 100; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    farthest = std::max(farthest, head->newest().value_or(Vec3::Zero()).norm());
  }
  EXPECT_LE(farthest, kFarthestHeadMm);
  RecordProperty("farthest_mm", std::to_string(farthest));
}

}  // namespace
}  // namespace palpate::device
