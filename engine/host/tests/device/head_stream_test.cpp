#include "palpate/device/head/head_stream.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "palpate/base/error.h"

namespace palpate::device {
namespace {

using Pose = std::array<double, 6>;

std::vector<unsigned char> bytesOf(const Pose& pose) {
  std::vector<unsigned char> bytes(sizeof(pose));
  std::memcpy(bytes.data(), pose.data(), sizeof(pose));
  return bytes;
}

/// A tracker on this machine.
class Tracker {
 public:
  explicit Tracker(int port) : file_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    address_.sin_family = AF_INET;
    address_.sin_port = htons(static_cast<std::uint16_t>(port));
    address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  }
  ~Tracker() { ::close(file_); }
  Tracker(const Tracker&) = delete;
  Tracker& operator=(const Tracker&) = delete;
  void send(const std::vector<unsigned char>& bytes) const {
    ::sendto(file_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&address_), sizeof(address_));
  }

 private:
  int file_;
  sockaddr_in address_{};
};

/// A port that is free now.
int freePort() {
  const int file = ::socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  EXPECT_EQ(::bind(file, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  socklen_t length = sizeof(address);
  ::getsockname(file, reinterpret_cast<sockaddr*>(&address), &length);
  ::close(file);
  return ntohs(address.sin_port);
}

TEST(HeadStream, CentimetresOfTheMessageAreMillimetres) {
  const auto place = parseHeadPlace(bytesOf({1.5, -2.0, 10.0, 30.0, 0.0, 0.0}));
  ASSERT_TRUE(place);
  EXPECT_EQ(*place, Vec3(15.0, -20.0, 100.0));
}

TEST(HeadStream, MessagesOfOtherLengthsAndImpossiblePlacesAreNotSeen) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(parseHeadPlace({}));
  EXPECT_FALSE(parseHeadPlace(std::vector<unsigned char>(47)));
  EXPECT_FALSE(parseHeadPlace(std::vector<unsigned char>(49)));
  EXPECT_FALSE(parseHeadPlace(bytesOf({kNan, 0, 0, 0, 0, 0})));
  EXPECT_FALSE(parseHeadPlace(bytesOf({0, kInfinity, 0, 0, 0, 0})));
  EXPECT_FALSE(parseHeadPlace(bytesOf({0, 0, 1e300, 0, 0, 0})));
  EXPECT_FALSE(parseHeadPlace(bytesOf({0, 0, 200.1, 0, 0, 0})));
  EXPECT_TRUE(parseHeadPlace(bytesOf({0, 0, 199.9, kNan, 0, 0}))) << "angles are not used";
}

TEST(HeadStream, TheNewestGoodPlaceCounts) {
  const int port = freePort();
  HeadStream stream(std::to_string(port));
  EXPECT_FALSE(stream.newest()) << "nothing has come, and it does not wait";
  const Tracker tracker(port);
  tracker.send(bytesOf({1, 0, 0, 0, 0, 0}));
  tracker.send(bytesOf({2, 0, 0, 0, 0, 0}));
  tracker.send(std::vector<unsigned char>(500, 0x41));
  tracker.send(bytesOf({1e9, 0, 0, 0, 0, 0}));
  const auto newest = stream.newest();
  ASSERT_TRUE(newest);
  EXPECT_EQ(newest->x(), 20.0);
  EXPECT_FALSE(stream.newest());
}

TEST(HeadStream, AFloodDoesNotKeepAPictureFromBeingDrawn) {
  const int port = freePort();
  HeadStream stream(std::to_string(port));
  const Tracker tracker(port);
  for (int i = 1; i <= 100; ++i) tracker.send(bytesOf({static_cast<double>(i), 0, 0, 0, 0, 0}));
  const auto first = stream.newest();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->x(), 640.0) << "64 messages, not all that wait";
}

TEST(HeadStream, APlaceToListenMustBeAPortThatIsFree) {
  EXPECT_THROW(HeadStream("0"), Error);
  EXPECT_THROW(HeadStream("head"), Error);
  EXPECT_THROW(HeadStream("nowhere:4242"), Error);
  const std::string port = std::to_string(freePort());
  const HeadStream first(port);
  EXPECT_THROW(HeadStream{port}, Error);
}

}  // namespace
}  // namespace palpate::device
