// Back end `remote`: what a client is answered, and what a stranger may send.
#include "palpate/device/detail/remote_device.h"
#include "palpate/device/detail/remote_gate.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "host/tests/device/remote_client.h"
#include "palpate/base/error.h"
#include "palpate/base/random.h"
#include "support/counted.h"
#include "support/temporary_folder.h"

namespace palpate::device {
namespace {

using Client = RemoteClient;

Device opened() {
  OpenOptions options;
  options.which = std::to_string(RemoteClient::port());
  options.origin_mm = {0, 0, 100};
  return openRemote(options);
}

TEST(Remote, MovesTheFingerAndAnswersWithItsForce) {
  const Device device = opened();
  const Client client;
  EXPECT_FALSE(device.read_tip(0).allFinite());
  EXPECT_EQ(device.state().faults, kNoPose);
  client.send("p 1 -2.5 3e1 5\n");
  EXPECT_EQ(device.read_tip(1), Vec3(1, -2.5, 130));
  EXPECT_EQ(device.state().buttons, 5u);
  device.write_force({0.25, 0, -1});
  EXPECT_EQ(client.answer(), "f 0.250000 0.000000 -1.000000\n");
}

TEST(Remote, TheNewestMessageCounts) {
  const Device device = opened();
  const Client client;
  for (int i = 0; i < 10; ++i) client.send("p " + std::to_string(i) + " 0 0");
  EXPECT_EQ(device.read_tip(0).x(), 9.0);
}

TEST(Remote, ASilentClientHasNoPlaceAndZeroForceUntilItSpeaksAgain) {
  const Device device = opened();
  const Client client;
  client.send("p 0 0 0");
  std::uint64_t tick = 0;
  for (; tick <= kMaxSilentTicks; ++tick) EXPECT_TRUE(device.read_tip(tick).allFinite()) << tick;
  EXPECT_FALSE(device.read_tip(tick).allFinite());
  EXPECT_EQ(device.state().faults, kStalePose);
  device.write_force({0, 0, 3});
  EXPECT_EQ(client.answer(), "f 0.000000 0.000000 0.000000\n");
  EXPECT_EQ(device.explain(), "the client has fallen silent");
  client.send("p 0 0 0");
  EXPECT_TRUE(device.read_tip(tick + 1).allFinite());
}

TEST(Remote, TheFirstToSpeakKeepsTheFingerUntilItHasBeenSilentForASecond) {
  const Device device = opened();
  const Client one;
  const Client two;
  one.send("p 1 0 0");
  device.read_tip(0);
  two.send("p 2 0 0");
  EXPECT_EQ(device.read_tip(1).x(), 1.0);
  device.write_force({0, 0, 1});
  EXPECT_NE(one.answer(), "");
  EXPECT_EQ(two.answer(), "");
  EXPECT_EQ(device.explain(), "1 messages came while another client had the finger");
  two.send("p 2 0 0");
  EXPECT_EQ(device.read_tip(1000).x(), 2.0) << "a second at 1 kHz";
  device.write_force({0, 0, 1});
  EXPECT_EQ(one.answer(), "");
  EXPECT_NE(two.answer(), "");
}

TEST(Remote, OneDatagramIsNotAnsweredForEver) {
  const Device device = opened();
  const Client client;
  client.send("p 0 0 0");
  int answers = 0;
  for (std::uint64_t tick = 0; tick < 3000; ++tick) {
    device.read_tip(tick);
    device.write_force({0, 0, 1});
    answers += client.answer().empty() ? 0 : 1;
  }
  EXPECT_EQ(answers, 22) << "20 ticks of silence, the first, and a last zero";
}

TEST(Remote, AClientThatDiedDisturbsNobodyForLong) {
  const Device device = opened();
  { Client().send("p 1 0 0"); }
  for (std::uint64_t tick = 0; tick < 10; ++tick) {
    EXPECT_TRUE(device.read_tip(tick).allFinite());
    device.write_force({0, 0, 1});
  }
  const Client next;
  next.send("p 7 0 0");
  EXPECT_EQ(device.read_tip(1100).x(), 7.0);
}

TEST(Remote, RefusesWhatIsNoPoseAndSaysHowMuchOfIt) {
  for (const char* message :
       {"", "p", "p 1 2", "p 1 2 3 4 5", "p nan 0 0", "p inf 0 0", "p 1e300 0 0", "q 1 2 3", "p 1,2,3", "p 1 2 x",
        "p 1 2 3 -1", "p 1 2 3 99999999999", "p 0x10 0 0", "P 1 2 3", "p1 2 3"}) {
    EXPECT_FALSE(parsePose(message)) << message;
  }
  const Device device = opened();
  const Client client;
  client.send("p 1 2 3");
  client.send("nonsense");
  client.send("p 4 5 6" + std::string(300, ' '));
  EXPECT_EQ(device.read_tip(0).x(), 1.0);
  EXPECT_EQ(device.explain(), "2 messages were not \"p x y z\"");
}

TEST(Remote, AMessageHasTwoHundredAndFiftySixBytesAtMost) {
  const Device device = opened();
  const Client client;
  std::string message = "p 1 0 0";
  message.resize(256, ' ');
  client.send(message);
  EXPECT_EQ(device.read_tip(0).x(), 1.0);
  message.replace(2, 1, "2");
  client.send(message + " ");
  EXPECT_EQ(device.read_tip(1).x(), 1.0);
  EXPECT_EQ(device.explain(), "1 messages were not \"p x y z\"");
}

TEST(Remote, AnythingWhateverIsNoPoseOrAFinitePlace) {
  Random random(3);
  const std::string letters = "p 0123456789.eE+-nainf\n\t\xff";
  int poses = 0;
  for (int i = 0; i < 300000; ++i) {
    std::string message = random.below(2) == 0 ? "p " : "";
    for (std::uint64_t length = random.below(20); length > 0; --length)
      message += letters[random.below(letters.size())];
    const auto pose = parsePose(message);
    if (!pose) continue;
    ++poses;
    ASSERT_TRUE(pose->tip_mm.allFinite()) << message;
  }
  EXPECT_GT(poses, 50) << "some of it is well-formed";
}

TEST(Remote, AFloodDoesNotKeepATickFromEnding) {
  const Device device = opened();
  const Client client;
  for (int i = 0; i < 200; ++i) client.send("p " + std::to_string(i) + " 0 0");
  EXPECT_EQ(device.read_tip(0).x(), 31.0) << "32 messages a tick";
}

TEST(Remote, CloseSendsALastZero) {
  const Device device = opened();
  const Client client;
  client.send("p 0 0 0");
  device.read_tip(0);
  device.write_force({0, 0, 2});
  device.close();
  EXPECT_EQ(client.answer(), "f 0.000000 0.000000 0.000000\n");
  device.write_force({0, 0, 2});
  EXPECT_EQ(client.answer(), "");
  EXPECT_FALSE(device.read_tip(1).allFinite());
  EXPECT_EQ(device.state().faults, kClosed);
}

TEST(Remote, AsksForNeitherMemoryNorLocks) {
  const Device device = opened();
  const Client client;
  client.send("p 0 0 1");
  device.read_tip(0);
  const std::string pose = "p 0.5 1.25 -3";
  const lab::ThreadCounts before = lab::countsOfThisThread();
  for (std::uint64_t tick = 0; tick < 20000; ++tick) {
    if (tick % 4 == 0) client.send(pose);
    device.write_force(1e-3 * device.read_tip(tick));
  }
  const lab::ThreadCounts asked = lab::countsSince(before);
  support::expectNone(asked.allocations, "allocations");
  support::expectNone(asked.locks, "locks");
}

TEST(Remote, ListensOnThisMachineAndSaysWhyNot) {
  const Device device = opened();
  OpenOptions same;
  same.which = std::to_string(RemoteClient::port());
  const Probe probe = probeRemote(same);
  EXPECT_FALSE(probe.available);
  EXPECT_NE(probe.reason.find("127.0.0.1"), std::string::npos) << probe.reason;
  EXPECT_NE(probe.reason.find("Address already in use"), std::string::npos) << probe.reason;
  for (const char* which : {"0", "70000", "here", "somewhere:4730", "1.5"}) {
    OpenOptions options;
    options.which = which;
    EXPECT_THROW(openRemote(options), Error) << which;
  }
}

class RemoteBeyondLoopback : public testing::Test {
 protected:
  RemoteBeyondLoopback() {
    options_.which = "0.0.0.0:" + std::to_string(RemoteClient::port());
    std::ofstream(file_) << "0123456789abcdef0123456789abcdef\n";
    std::filesystem::permissions(file_, static_cast<std::filesystem::perms>(0600));
  }
  ~RemoteBeyondLoopback() override { ::unsetenv(kRemoteKeyVariable); }
  const support::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "key";
  OpenOptions options_;
};

TEST_F(RemoteBeyondLoopback, IsRefusedWithoutAKey) {
  const Probe probe = probeRemote(options_);
  EXPECT_FALSE(probe.available);
  EXPECT_NE(probe.reason.find("PALPATE_REMOTE_KEY_FILE"), std::string::npos) << probe.reason;
  EXPECT_THROW(openRemote(options_), Error);
  ::setenv(kRemoteKeyVariable, "/no/such/key", 1);
  EXPECT_THROW(openRemote(options_), Error);
  ::setenv(kRemoteKeyVariable, file_.c_str(), 1);
  std::filesystem::permissions(file_, static_cast<std::filesystem::perms>(0644));
  EXPECT_THROW(openRemote(options_), Error) << "others may read it";
}

TEST_F(RemoteBeyondLoopback, AKeyOpensItAndUnsignedPosesDoNotMoveIt) {
  ::setenv(kRemoteKeyVariable, file_.c_str(), 1);
  EXPECT_TRUE(probeRemote(options_).available);
  const Device device = openRemote(options_);
  const Client client;
  client.send("p 1 2 3");
  EXPECT_FALSE(device.read_tip(0).allFinite());
  device.write_force({0, 0, 1});
  EXPECT_EQ(client.answer(), "");
  EXPECT_NE(device.explain().find("1 messages were not signed"), std::string::npos) << device.explain();
}

}  // namespace
}  // namespace palpate::device
