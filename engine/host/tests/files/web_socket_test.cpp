// SHA-1 against the standard's examples, and a server's half of a WebSocket's frames; a client's half meets hostile
// peers in engine/host/tests/device/haply_peer_test.cpp.
#include "palpate/base/web_socket.h"

#include <gtest/gtest.h>

#include <string>

namespace palpate {
namespace {

using websocket::FrameReader;
using websocket::Kind;
using websocket::Side;

std::string hexOfSha1(std::string_view message) {
  std::string hex;
  for (const unsigned byte : sha1(message)) {
    hex += "0123456789abcdef"[byte >> 4];
    hex += "0123456789abcdef"[byte & 15];
  }
  return hex;
}

TEST(Sha1, GivesTheStandardsDigests) {
  EXPECT_EQ(hexOfSha1(""), "da39a3ee5e6b4b0d3255bfef95601890afd80709");
  EXPECT_EQ(hexOfSha1("abc"), "a9993e364706816aba3e25717850c26c9cd0d89d");
  EXPECT_EQ(hexOfSha1("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "84983e441c3bd26ebaae4aa1f95129e5e54670f1");
  EXPECT_EQ(hexOfSha1(std::string(1'000'000, 'a')), "34aa973cd4c4daa4f61eeb2bdbad27316534016f");
}

TEST(WebSocket, AnswersTheKeyOfTheStandard) {
  EXPECT_EQ(websocket::acceptFor("dGhlIHNhbXBsZSBub25jZQ=="), "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=");
  EXPECT_EQ(websocket::makeKey().size(), 24u);
  EXPECT_NE(websocket::makeKey(), websocket::makeKey());
}

/// Byte by byte, as a slow line brings them.
TEST(WebSocket, AServerReadsWhatAClientWrites) {
  for (const std::size_t size : {0u, 5u, 125u, 126u, 65535u, 65536u}) {
    const std::string message(size, 'm');
    FrameReader reader(Side::server, 65536);
    std::string read;
    int messages = 0;
    for (const char byte : websocket::makeFrame(Side::client, Kind::text, message)) {
      reader.feed({&byte, 1});
      while (const auto whole = reader.next()) {
        read = whole->bytes;
        ++messages;
      }
    }
    EXPECT_EQ(messages, 1) << size;
    EXPECT_EQ(read, message) << size;
    EXPECT_FALSE(reader.fault());
  }
}

TEST(WebSocket, AServerReadsSeveralMessagesOutOfOnePacket) {
  FrameReader reader(Side::server, 100);
  reader.feed(websocket::makeFrame(Side::client, Kind::text, "one") +
              websocket::makeFrame(Side::client, Kind::ping, "p") +
              websocket::makeFrame(Side::client, Kind::binary, "\xff"));
  std::string read;
  while (const auto whole = reader.next()) read += std::string(whole->bytes) + ';';
  EXPECT_EQ(read, "one;p;\xff;");
}

TEST(WebSocket, AServerRefusesFramesWithoutAMaskAndLongOnes) {
  FrameReader bare(Side::server, 100);
  bare.feed(websocket::makeFrame(Side::server, Kind::text, "one"));
  EXPECT_FALSE(bare.next());
  ASSERT_TRUE(bare.fault());
  EXPECT_EQ(bare.fault()->code, websocket::CloseCode::protocol_error);
  bare.feed(websocket::makeFrame(Side::client, Kind::text, "two"));
  EXPECT_FALSE(bare.next()) << "nothing comes after a fault";

  FrameReader long_one(Side::server, 100);
  long_one.feed(websocket::makeFrame(Side::client, Kind::text, std::string(101, 'x')).substr(0, 8));
  EXPECT_FALSE(long_one.next());
  ASSERT_TRUE(long_one.fault()) << "before its bytes have come";
  EXPECT_EQ(long_one.fault()->code, websocket::CloseCode::too_big);
}

TEST(WebSocket, AGoodbyeIsAnsweredWithItsCodeOrCalledWrong) {
  EXPECT_EQ(websocket::answerClose(Side::server, "\x03\xe9gone"), std::string("\x88\x02\x03\xe9"));
  EXPECT_EQ(websocket::answerClose(Side::server, "\x03\xed"), std::string("\x88\x02\x03\xea"));  // 1005 is never sent
  EXPECT_EQ(websocket::answerClose(Side::server, ""), std::string("\x88\x00", 2));
  EXPECT_EQ(websocket::makeClose(Side::server, websocket::CloseCode::normal, std::string(500, 'x')).size(), 127u);
}

}  // namespace
}  // namespace palpate
