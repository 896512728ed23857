// The connection to Haply's service against peers that break the rules, over a socket of their own: each is refused
// with its reason, in time, and costs no more memory than a message.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/stopwatch.h"
#include "palpate/base/web_socket.h"
#include "palpate/device/hardware/haply_message.h"
#include "palpate/device/hardware/haply_session.h"

namespace palpate::device {
namespace {

constexpr double kPatienceS = 0.5;

/// One end of the peer's connection, by hand.
class PeerSocket {
 public:
  explicit PeerSocket(int socket) : socket_(socket) {}

  bool send(std::string_view bytes) const {
    while (!bytes.empty()) {
      const auto sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
  }
  /// So many bytes; fewer where the other side ends or is silent for long.
  std::string receive(std::size_t size) const {
    std::string bytes;
    while (bytes.size() < size) {
      pollfd ready{socket_, POLLIN, 0};
      char buffer[4096];
      if (::poll(&ready, 1, 5000) <= 0) return bytes;
      const auto got = ::recv(socket_, buffer, std::min(sizeof(buffer), size - bytes.size()), 0);
      if (got <= 0) return bytes;
      bytes.append(buffer, static_cast<std::size_t>(got));
    }
    return bytes;
  }
  std::string receiveHead() const {
    std::string head;
    while (!head.ends_with("\r\n\r\n")) {
      const std::string byte = receive(1);
      if (byte.empty()) break;
      head += byte;
    }
    return head;
  }
  /// Until the other side has ended.
  void waitForTheEnd() const {
    while (!receive(1).empty()) {
    }
  }
  /// Answers the handshake as the rules want it, with `more` behind the usual fields.
  void shakeHands(const std::string& more = {}) const {
    const std::string head = receiveHead();
    const std::string name = "Sec-WebSocket-Key: ";
    const std::size_t at = head.find(name) + name.size();
    const std::string key = head.substr(at, head.find("\r\n", at) - at);
    send("HTTP/1.1 101 Switching Protocols\r\nUpgrade: WebSocket\r\nConnection: keep-alive, Upgrade\r\n" + more +
         "Sec-WebSocket-Accept: " + websocket::acceptFor(key) + "\r\n\r\n");
  }

 private:
  int socket_;
};

/// Serves one client with a script, on a thread of its own.
class Peer {
 public:
  using Script = std::function<void(const PeerSocket&)>;

  explicit Peer(Script script) : door_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(at);
    EXPECT_EQ(::bind(door_, reinterpret_cast<const sockaddr*>(&at), sizeof(at)), 0);
    EXPECT_EQ(::listen(door_, 1), 0);
    ::getsockname(door_, reinterpret_cast<sockaddr*>(&at), &size);
    address_.port = ntohs(at.sin_port);
    thread_ = std::thread([this, script = std::move(script)] {
      const int guest = ::accept(door_, nullptr, nullptr);
      if (guest < 0) return;
      script(PeerSocket(guest));
      ::close(guest);
    });
  }
  ~Peer() {
    thread_.join();
    ::close(door_);
  }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;
  const haply::Address& address() const { return address_; }

 private:
  int door_;
  haply::Address address_;
  std::thread thread_;
};

std::string troubleOf(const std::function<void()>& what) {
  try {
    what();
  } catch (const Error& error) {
    return error.what();
  }
  return "no trouble";
}

/// What the client says of a peer that shakes hands and then does that.
std::string troubleAfterHandshake(Peer::Script script) {
  const Peer peer([&](const PeerSocket& socket) {
    socket.shakeHands();
    script(socket);
    socket.waitForTheEnd();
  });
  return troubleOf([&] {
    haply::Connection connection(peer.address(), kPatienceS);
    connection.receive();
  });
}

struct Case {
  std::string bytes;
  const char* trouble;
};

std::string frame(unsigned first, std::string_view bytes) {
  std::string text = websocket::makeFrame(websocket::Side::server, websocket::Kind::text, bytes);
  text[0] = static_cast<char>(first);
  return text;
}

TEST(HaplyPeer, FramesThatBreakARuleAreRefusedWithTheirReason) {
  const std::string text = "text";
  const Case cases[] = {
      {std::string("\x81\x7f\x7f\xff\xff\xff\xff\xff\xff\xff", 10), "exceeded"},
      {std::string("\x81\x7f\xff\xff\xff\xff\xff\xff\xff\xff", 10), "exceeded"},
      {std::string("\x81\x7f\0\0\0\0\0\4\0\1", 10), "exceeded"},
      {std::string("\x81\x7f\0\0\0\0\0\0\0\1x", 11), "not canonical"},
      {std::string("\x81\x7e\0\1x", 5), "not canonical"},
      {frame(0x09, "a"), "fragmented"},
      {frame(0x08, ""), "fragmented"},
      {frame(0x89, std::string(126, 'x')), "control frame size"},
      {frame(0x88, "x"), "close frame payload size"},
      {websocket::makeFrame(websocket::Side::client, websocket::Kind::text, text), "was masked"},
      {frame(0xc1, text), "reserved bits"},
      {frame(0x83, text), "illegal opcode"},
      {frame(0x8b, text), "illegal opcode"},
      {frame(0x80, text), "continuation frame was unexpected"},
      {frame(0x01, text) + frame(0x81, text), "data frame was unexpected"},
      {frame(0x81, "\xff\xfe"), "utf8"},
      {frame(0x01, "\xe2\x82") + frame(0x80, "x"), "utf8"},
      {frame(0x88, "\x03\xe8"), "closed"},
  };
  for (const Case& one : cases) {
    const std::string trouble = troubleAfterHandshake([&](const PeerSocket& socket) { socket.send(one.bytes); });
    EXPECT_NE(trouble.find(one.trouble), std::string::npos) << one.trouble << ", not: " << trouble;
  }
}

TEST(HaplyPeer, AMessageInEndlessFragmentsIsRefusedAtTheLimit) {
  const std::string trouble = troubleAfterHandshake([](const PeerSocket& socket) {
    const std::string piece(65536, 'x');
    bool first = true;
    while (socket.send(frame(std::exchange(first, false) ? 0x01 : 0x00, piece))) {
    }
  });
  EXPECT_NE(trouble.find("exceeded"), std::string::npos) << trouble;
}

/// Each of them always has something to read, and never a message.
TEST(HaplyPeer, WhoOnlyTalksAboutNothingIsHungUpOnInTime) {
  for (const std::string& nothing : {frame(0x89, "ping"), frame(0x8a, "pong")}) {
    const auto began = Clock::now();
    const std::string trouble = troubleAfterHandshake([&](const PeerSocket& socket) {
      std::string many;
      for (int i = 0; i < 100; ++i) many += nothing;
      while (socket.send(many)) {
      }
    });
    EXPECT_NE(trouble.find("no answer within 0.50 s"), std::string::npos) << trouble;
    EXPECT_LT(secondsSince(began), 10 * kPatienceS);
  }
}

TEST(HaplyPeer, WhoIsSilentOrEndsInAMessageIsSaidToBe) {
  EXPECT_NE(troubleAfterHandshake([](const PeerSocket&) {}).find("no answer within"), std::string::npos);
  const Peer peer([](const PeerSocket& socket) {
    socket.shakeHands();
    socket.send(std::string("\x81\x05he", 4));
  });
  const std::string trouble = troubleOf([&] {
    haply::Connection connection(peer.address(), kPatienceS);
    connection.receive();
  });
  EXPECT_NE(trouble.find("End of file"), std::string::npos) << trouble;
}

TEST(HaplyPeer, AHandshakeThatBreaksARuleIsRefused) {
  const std::string switching = "HTTP/1.1 101 Switching Protocols\r\n";
  const std::string upgrade = "Upgrade: websocket\r\n";
  const std::string connection = "Connection: Upgrade\r\n";
  const std::string accept = "Sec-WebSocket-Accept: s3pPLMBiTxaQ9kYGzzhZRbK+xOo=\r\n";
  const Case cases[] = {
      {switching + upgrade + connection + accept + "\r\n", "Accept field is invalid"},
      {switching + upgrade + connection + "\r\n", "Accept field is missing"},
      {switching + upgrade + accept + "\r\n", "upgrade token"},
      {switching + connection + accept + "\r\n", "websocket token"},
      {"HTTP/1.1 200 OK\r\n" + upgrade + connection + accept + "\r\n", "declined"},
      {"HTTP/2 101\r\n\r\n", "bad version"},
      {"HTTP/1.1 1x1 Switching\r\n\r\n", "bad status"},
      {"hello\r\n\r\n", "bad version"},
      {switching + "nothing\r\n\r\n", "bad field"},
      {switching + upgrade, "partial message"},
      {"", "end of stream"},
  };
  for (const Case& one : cases) {
    const Peer peer([&](const PeerSocket& socket) {
      socket.receiveHead();
      socket.send(one.bytes);
    });
    const std::string trouble = troubleOf([&] { haply::Connection(peer.address(), kPatienceS); });
    EXPECT_NE(trouble.find(one.trouble), std::string::npos) << one.trouble << ", not: " << trouble;
  }
}

TEST(HaplyPeer, AnExtensionThatWasNotAskedForIsRefused) {
  const Peer peer([](const PeerSocket& socket) {
    socket.shakeHands("Sec-WebSocket-Extensions: permessage-deflate\r\n");
    socket.waitForTheEnd();
  });
  const std::string trouble = troubleOf([&] { haply::Connection(peer.address(), kPatienceS); });
  EXPECT_NE(trouble.find("not asked for"), std::string::npos) << trouble;
}

TEST(HaplyPeer, AnEndlessHeadAndASilentPeerAreRefused) {
  const Peer endless([](const PeerSocket& socket) {
    socket.send("HTTP/1.1 101 Switching Protocols\r\n");
    while (socket.send("X-More: " + std::string(1000, 'x') + "\r\n")) {
    }
  });
  const std::string trouble = troubleOf([&] { haply::Connection(endless.address(), kPatienceS); });
  EXPECT_NE(trouble.find("header limit exceeded"), std::string::npos) << trouble;
  const Peer silent([](const PeerSocket& socket) { socket.waitForTheEnd(); });
  const std::string late = troubleOf([&] { haply::Connection(silent.address(), kPatienceS); });
  EXPECT_NE(late.find("no answer within 0.50 s"), std::string::npos) << late;
}

TEST(HaplyPeer, FragmentsAreJoinedPingsAnsweredAndEveryFrameHasAMask) {
  std::string pong;
  std::string sent[2];
  {
    const Peer peer([&](const PeerSocket& socket) {
      socket.shakeHands();
      socket.send(frame(0x01, "fragments ") + frame(0x89, "are you there") + frame(0x00, "") + frame(0x80, "joined"));
      pong = socket.receive(2 + 4 + 13);
      for (std::string& one : sent) one = socket.receive(2 + 4 + 5);
      socket.waitForTheEnd();
    });
    haply::Connection connection(peer.address(), 5.0);
    EXPECT_EQ(connection.receive(), "fragments joined");
    connection.send("hello");
    connection.send("hello");
  }
  const auto unmasked = [](std::string bytes) {
    for (std::size_t i = 6; i < bytes.size(); ++i) bytes[i] = static_cast<char>(bytes[i] ^ bytes[2 + (i - 6) % 4]);
    return bytes.substr(6);
  };
  EXPECT_EQ(pong.substr(0, 2), "\x8a\x8d");
  EXPECT_EQ(unmasked(pong), "are you there");
  for (const std::string& one : sent) {
    EXPECT_EQ(one.substr(0, 2), "\x81\x85");
    EXPECT_EQ(unmasked(one), "hello");
  }
  EXPECT_NE(sent[0], sent[1]) << "the same mask twice";
}

TEST(HaplyPeer, AnswersByHttpAreReadInEveryFormAndBounded) {
  const std::string ok = "HTTP/1.1 200 OK\r\n";
  const std::string chunked = ok + "Transfer-Encoding: chunked\r\n\r\n";
  const std::string too_much(haply::kMaxReplyBytes + 1, 'x');
  const Case cases[] = {
      {ok + "Content-Length: 5\r\n\r\nhello", ""},
      {chunked + "2\r\nhe\r\n3;name=value\r\nllo\r\n0\r\n\r\n", ""},
      {ok + "\r\nhello", ""},
      {ok + "Content-Length: 6\r\n\r\nhello", "partial message"},
      {ok + "Content-Length: 99999999999999999999999\r\n\r\n", "bad Content-Length"},
      {ok + "Content-Length: -1\r\n\r\n", "bad Content-Length"},
      {ok + "Content-Length: " + std::to_string(too_much.size()) + "\r\n\r\n", "body limit exceeded"},
      {ok + "\r\n" + too_much, "body limit exceeded"},
      {chunked + "ffffffffffffffff\r\nhello", "body limit exceeded"},
      {chunked + "20000\r\n" + too_much.substr(0, 0x20000) + "\r\n20001\r\n", "body limit exceeded"},
      {chunked + "x\r\nhello", "bad chunk"},
      {chunked + std::string(300, '0'), "bad chunk"},
      {chunked + "2\r\nhello\r\n", "bad chunk"},
      {"HTTP/1.1 404 Not Found\r\nContent-Length: 0\r\n\r\n", "/version: status 404"},
  };
  for (const Case& one : cases) {
    const Peer peer([&](const PeerSocket& socket) {
      socket.receiveHead();
      socket.send(one.bytes);
    });
    std::string body;
    const std::string trouble = troubleOf([&] { body = haply::httpGet(peer.address(), "/version", kPatienceS); });
    if (*one.trouble == '\0') {
      EXPECT_EQ(body, "hello") << trouble;
    } else {
      EXPECT_NE(trouble.find(one.trouble), std::string::npos) << one.trouble << ", not: " << trouble;
    }
  }
}

TEST(HaplyPeer, AHostThatIsNoneIsSaidToBe) {
  const std::string trouble = troubleOf([] { haply::Connection({"no such host", 80}, kPatienceS); });
  EXPECT_NE(trouble.find("no such host:80: "), std::string::npos) << trouble;
}

}  // namespace
}  // namespace palpate::device
