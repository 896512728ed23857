// The protocol of `remote` without a socket: how much is answered, who holds the finger, and what a key keeps out.
#include "palpate/device/detail/remote_gate.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "palpate/base/error.h"
#include "palpate/base/random.h"
#include "support/counted.h"
#include "support/temporary_folder.h"

namespace palpate::device {
namespace {

constexpr std::uint64_t kHandoverTicks = 1000;
constexpr RemotePeer kFirst{0x7f000001, 1000};
constexpr RemotePeer kSecond{0x7f000001, 1001};
const std::string kSecret = "0123456789abcdef0123456789abcdef";
const std::string kTheirNonce = "ClientNonce0ClientNonce0ClientN0";

RemoteGate::Seed seed(char digit = 'a') {
  RemoteGate::Seed seed;
  seed.fill(digit);
  return seed;
}

/// With its signature.
std::string signedBy(const std::string& secret, const std::string& message) {
  const auto hex = hexOf(HmacSha256(secret).of(message));
  return message + " " + std::string(hex.begin(), hex.end());
}

std::string hello(const std::string& secret = kSecret, std::size_t bytes = kHelloBytes) {
  std::string message = signedBy(secret, "hello " + kTheirNonce);
  message.resize(std::max(bytes, message.size()), ' ');
  return message;
}

/// The server's nonce for a hello at this tick; empty where it is not answered.
std::string nonceOf(RemoteGate& gate, std::uint64_t tick, const RemotePeer& from = kFirst,
                    const std::string& last_pose = "0") {
  EXPECT_FALSE(gate.acceptPose(hello(), from, tick));
  const std::string reply(gate.reply());
  const std::string before = "challenge " + kTheirNonce + " ";
  if (!reply.starts_with(before)) return {};
  const std::string nonce = reply.substr(before.size(), 32);
  EXPECT_EQ(reply, signedBy(kSecret, before + nonce + " " + last_pose) + "\n");
  EXPECT_LE(reply.size(), kHelloBytes) << "an answer longer than what asks for it";
  return nonce;
}

std::string pose(const std::string& nonce, int number, const std::string& secret = kSecret) {
  return signedBy(secret, "p 1 2 3 " + nonce + " " + std::to_string(number));
}

int countAnswers(RemoteGate& gate, std::uint64_t first_tick, int ticks) {
  int answers = 0;
  for (int i = 0; i < ticks; ++i) {
    gate.tick(first_tick + static_cast<std::uint64_t>(i));
    answers += gate.answer({0, 0, 1}).empty() ? 0 : 1;
  }
  return answers;
}

TEST(RemoteGate, APoseBringsSoManyAnswersAndNoMore) {
  RemoteGate gate(std::nullopt, seed(), kHandoverTicks);
  EXPECT_EQ(countAnswers(gate, 0, 100), 0) << "nobody has asked";
  ASSERT_TRUE(gate.acceptPose("p 0 0 0", kFirst, 0));
  EXPECT_EQ(countAnswers(gate, 0, 10000), kAnswersPerPose);
  for (std::uint64_t tick = 20000; tick < 20100; ++tick) ASSERT_TRUE(gate.acceptPose("p 0 0 0", kFirst, tick));
  EXPECT_EQ(countAnswers(gate, 20100, 10000), kAnswersPerPose) << "poses that came at once do not add up";
}

TEST(RemoteGate, ASecondSenderIsIgnoredUntilTheFirstWasSilentForASecond) {
  RemoteGate gate(std::nullopt, seed(), kHandoverTicks);
  ASSERT_TRUE(gate.acceptPose("p 1 0 0", kFirst, 5));
  for (const std::uint64_t tick : {5u, 6u, 500u, 1004u}) {
    gate.tick(tick);
    EXPECT_FALSE(gate.acceptPose("p 2 0 0", kSecond, tick)) << tick;
    EXPECT_EQ(gate.holder(), kFirst);
  }
  EXPECT_EQ(gate.counts().ignored, 4u);
  gate.tick(1005);
  EXPECT_TRUE(gate.acceptPose("p 2 0 0", kSecond, 1005));
  EXPECT_EQ(gate.holder(), kSecond);
  EXPECT_FALSE(gate.acceptPose("p 1 0 0", kFirst, 1005));
}

TEST(RemoteGate, WithAKeyOnlySignedPosesMoveTheFinger) {
  RemoteGate gate(kSecret, seed(), kHandoverTicks);
  const std::string nonce = nonceOf(gate, 0);
  ASSERT_EQ(nonce, std::string(24, 'a') + "00000000");
  EXPECT_FALSE(gate.acceptPose("p 1 2 3", kFirst, 0)) << "not signed";
  EXPECT_FALSE(gate.acceptPose(pose(nonce, 1, std::string(32, 'x')), kFirst, 0)) << "another key";
  std::string changed = pose(nonce, 1);
  changed[2] = '9';
  EXPECT_FALSE(gate.acceptPose(changed, kFirst, 0)) << "another place";
  EXPECT_FALSE(gate.acceptPose(pose(std::string(32, 'b'), 1), kFirst, 0)) << "another run";
  EXPECT_FALSE(gate.acceptPose(signedBy(kSecret, "q 1 2 3 " + nonce + " 1"), kFirst, 0)) << "signed, but no pose";
  EXPECT_EQ(gate.counts().not_signed, 4u);
  EXPECT_EQ(gate.counts().malformed, 1u);
  EXPECT_FALSE(gate.holder());
  const auto taken = gate.acceptPose(pose(nonce, 2) + "\n", kFirst, 0);
  ASSERT_TRUE(taken);
  EXPECT_EQ(taken->tip_mm, Vec3(1, 2, 3));
}

TEST(RemoteGate, NothingThatWasSentCountsAgain) {
  RemoteGate gate(kSecret, seed(), kHandoverTicks);
  const std::string nonce = nonceOf(gate, 0);
  ASSERT_TRUE(gate.acceptPose(pose(nonce, 7), kFirst, 0));
  EXPECT_FALSE(gate.acceptPose(pose(nonce, 7), kFirst, 1)) << "again";
  EXPECT_FALSE(gate.acceptPose(pose(nonce, 6), kFirst, 1)) << "an older one";
  EXPECT_TRUE(gate.acceptPose(pose(nonce, 8), kFirst, 1));
  EXPECT_EQ(nonceOf(gate, 2, kFirst, "8"), nonce) << "who greets again goes on";
  gate.tick(1 + kHandoverTicks);
  EXPECT_FALSE(gate.holder());
  EXPECT_FALSE(gate.acceptPose(pose(nonce, 9), kSecond, 1 + kHandoverTicks)) << "of a conversation that is over";
  const std::string next = nonceOf(gate, 1 + kHandoverTicks, kSecond);
  EXPECT_NE(next, nonce);
  EXPECT_TRUE(gate.acceptPose(pose(next, 1), kSecond, 1 + kHandoverTicks));

  RemoteGate later(kSecret, seed('b'), kHandoverTicks);
  EXPECT_FALSE(later.acceptPose(pose(nonce, 10), kFirst, 0)) << "of another run";
}

TEST(RemoteGate, WithAKeyStrangersGetNotOneByte) {
  RemoteGate gate(kSecret, seed(), kHandoverTicks);
  for (const std::string& message :
       {hello(std::string(32, 'x')), std::string("hello"), "hello " + kTheirNonce, hello(kSecret, 100),
        std::string("p 0 0 0"), std::string(kHelloBytes, ' '), std::string()}) {
    EXPECT_FALSE(gate.acceptPose(message, kFirst, 0));
    EXPECT_TRUE(gate.reply().empty()) << message;
    EXPECT_TRUE(gate.answer({0, 0, 1}).empty());
  }
  EXPECT_FALSE(nonceOf(gate, 1).empty());
  EXPECT_TRUE(nonceOf(gate, 1).empty()) << "one a tick";
  EXPECT_FALSE(nonceOf(gate, 2).empty());
}

TEST(RemoteGate, AnswersAreSignedAndCountUp) {
  RemoteGate gate(kSecret, seed(), kHandoverTicks);
  const std::string nonce = nonceOf(gate, 0);
  ASSERT_TRUE(gate.acceptPose(pose(nonce, 1), kFirst, 0));
  EXPECT_EQ(gate.answer({0.5, 0, -1}), signedBy(kSecret, "f 0.500000 0.000000 -1.000000 " + nonce + " 1") + "\n");
  EXPECT_EQ(gate.answer({0, 0, 0}), signedBy(kSecret, "f 0.000000 0.000000 0.000000 " + nonce + " 2") + "\n");
}

TEST(RemoteGate, AForceThatHasNoRoomInAnAnswerIsNotSent) {
  RemoteGate gate(kSecret, seed(), kHandoverTicks);
  const std::string nonce = nonceOf(gate, 0);
  std::size_t sent = 0;
  int pose_number = 0;
  int answer_number = 0;
  for (double force = 1.0; force < 1e300; force *= 10.0) {
    ASSERT_TRUE(gate.acceptPose(pose(nonce, ++pose_number), kFirst, 0));
    const std::string answer(gate.answer({force, 0, 0}));
    const std::string text = fmt::format("f {:.6f} 0.000000 0.000000 {} {}", force, nonce, ++answer_number);
    const std::string whole = signedBy(kSecret, text) + "\n";
    EXPECT_EQ(answer, whole.size() <= kMaxDatagramBytes ? whole : "") << force;
    sent += answer.empty() ? 0 : 1;
  }
  EXPECT_GT(sent, 100u);
}

TEST(RemoteGate, NoBytesOfAStrangerMoveAKeyedFinger) {
  Random random(7);
  RemoteGate gate(kSecret, seed(), kHandoverTicks);
  const std::string nonce = nonceOf(gate, 0);
  const std::string good = pose(nonce, 1);
  for (int i = 0; i < 20000; ++i) {
    std::string message = good;
    for (std::uint64_t changes = 1 + random.below(3); changes > 0; --changes) {
      message[random.below(message.size())] = static_cast<char>(random.below(256));
    }
    if (random.below(4) == 0) message.resize(random.below(message.size()));
    if (message == good) continue;
    EXPECT_FALSE(gate.acceptPose(message, kFirst, 0)) << message;
  }
  EXPECT_TRUE(gate.acceptPose(good, kFirst, 0));
}

TEST(RemoteGate, AsksForNeitherMemoryNorLocksWithAKey) {
  RemoteGate gate(kSecret, seed(), kHandoverTicks);
  const std::string nonce = nonceOf(gate, 0);
  std::vector<std::string> poses;
  for (int i = 1; i <= 2000; ++i) poses.push_back(pose(nonce, i));
  const std::string greeting = hello();
  std::size_t bytes = 0;
  const lab::ThreadCounts before = lab::countsOfThisThread();
  for (std::size_t tick = 0; tick < poses.size(); ++tick) {
    gate.tick(tick);
    (void)gate.acceptPose(greeting, kFirst, tick);
    bytes += gate.reply().size();
    if (gate.acceptPose(poses[tick], kFirst, tick)) bytes += gate.answer({1, 2, 3}).size();
  }
  const lab::ThreadCounts asked = lab::countsSince(before);
  support::expectNone(asked.allocations, "allocations");
  support::expectNone(asked.locks, "locks");
  EXPECT_GT(bytes, 2000u * 200u);
}

TEST(RemoteKey, IsReadFromAFileOfTheOwnerAlone) {
  const support::TemporaryFolder folder;
  const auto file_with = [&](const std::string& content, int mode) {
    const std::filesystem::path file = folder / "key";
    std::ofstream(file) << content;
    std::filesystem::permissions(file, static_cast<std::filesystem::perms>(mode));
    return file;
  };
  EXPECT_EQ(readRemoteKey(file_with(kSecret + "\n", 0600)), kSecret);
  EXPECT_EQ(readRemoteKey(file_with(kSecret, 0400)), kSecret);
  EXPECT_THROW(readRemoteKey(file_with(kSecret, 0640)), Error);
  EXPECT_THROW(readRemoteKey(file_with(kSecret, 0604)), Error);
  EXPECT_THROW(readRemoteKey(file_with(std::string(31, 'a'), 0600)), Error);
  EXPECT_EQ(readRemoteKey(file_with(std::string(32, 'a') + "\n", 0600)), std::string(32, 'a'));
  EXPECT_EQ(readRemoteKey(file_with(std::string(128, 'a') + "\n", 0600)), std::string(128, 'a'));
  EXPECT_THROW(readRemoteKey(file_with(std::string(129, 'a') + "\n", 0600)), Error);
  EXPECT_THROW(readRemoteKey(file_with(kSecret + "\n" + kSecret, 0600)), Error);
  EXPECT_THROW(readRemoteKey(folder / "nothing"), Error);
}

}  // namespace
}  // namespace palpate::device
