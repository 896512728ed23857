// `palpate serve` under siege, over TLS, and on all interfaces of a computer.
#include <gtest/gtest.h>

#include <fstream>

#include "cli/serve/wire.h"
#include "cli/tests/serve/plain_stream.h"
#include "cli/tests/serve/served_command.h"

namespace palpate {
namespace {

using support::PlainStream;
using support::PlainWire;
using support::ServedCommand;

std::string withToken(const std::string& scheme, const std::string& token) {
  return "Authorization: " + scheme + token + "\r\n";
}

TEST(ServeGuards, ThreeHundredHalfRequestsKeepNobodyOut) {
  ServedCommand server;
  std::vector<PlainWire> half;
  for (int i = 0; i < 300; ++i) {
    half.emplace_back(server.port());
    half.back().send("GET / HTTP/1.1\r\nHost: lo");
  }
  PlainWire page(server.port());
  EXPECT_EQ(support::ask(page, "GET", "/").status, 200);
  PlainWire known(server.port());
  EXPECT_EQ(support::ask(known, "GET", "/served/state", withToken("Bearer ", support::kLookToken)).status, 200);
  EXPECT_EQ(PlainStream(server.port(), support::kControlToken).status(), 101);
  server.end(SIGTERM);
  EXPECT_GE(server.report()["hung_up"], 40);
}

TEST(ServeGuards, TheSchemeBearerMayBeWrittenInAnyLetters) {
  ServedCommand server;
  PlainWire wire(server.port());
  for (const char* scheme : {"Bearer ", "bearer ", "BEARER ", "Bearer   "}) {
    EXPECT_EQ(support::ask(wire, "GET", "/served/state", withToken(scheme, support::kLookToken)).status, 200) << scheme;
  }
  for (const char* scheme : {"Bearer", "Basic ", "", "Token "}) {
    EXPECT_EQ(support::ask(wire, "GET", "/served/state", withToken(scheme, support::kLookToken)).status, 401) << scheme;
  }
}

/// The status of a request of these lines; 0: none came.
int requestStatus(int port, const std::string& first_line, const std::string& lines) {
  PlainWire wire(port);
  wire.send(first_line + "\r\n" + lines + "\r\n");
  const auto head = wire.receiveUntil("\r\n", 10.0);
  return head && head->size() > 12 ? std::stoi(head->substr(9, 3)) : 0;
}

TEST(ServeGuards, ARequestNamesOneHost) {
  const ServedCommand server;
  const auto status = [&](const std::string& lines) { return requestStatus(server.port(), "GET / HTTP/1.1", lines); };
  for (const char* host :
       {"localhost", "127.0.0.1:8080", "[::1]:8080", "[::1]", "Palpate.Example.org", "a_b:", "x:1"}) {
    EXPECT_EQ(status(std::string("Host: ") + host + "\r\n"), 200) << host;
  }
  EXPECT_EQ(status(""), 400);
  EXPECT_EQ(status("Host: localhost\r\nHost: localhost\r\n"), 400);
  EXPECT_EQ(status("Host: localhost\r\nX: y\r\nhost: evil.example\r\n"), 400);
  for (const char* host :
       {"", " ", "local host", "localhost/", "a@b", "a,b", "a:b", "a:1:2", "localhost:123456", "[::1", "::1", "[]",
        "[::1]8", "[localhost]", "local\r\n host", "http://localhost", "\xc3\xa4"}) {
    EXPECT_EQ(status(std::string("Host: ") + host + "\r\n"), 400) << host;
  }
  EXPECT_EQ(status("Host: " + std::string(256, 'a') + "\r\n"), 400);
  EXPECT_EQ(requestStatus(server.port(), "GET / HTTP/1.0", ""), 200) << "which has none";
  EXPECT_EQ(requestStatus(server.port(), "GET / HTTP/1.0", "Host: a\r\nHost: b\r\n"), 400);
}

TEST(ServeGuards, AStrangeNameThatLeadsHereOpensNothing) {
  const ServedCommand server;
  const std::string port = std::to_string(server.port());
  const std::string evil = "evil.example:" + port;
  const auto status = [&](const std::string& host, const std::string& origins) {
    const std::string lines = "Host: " + host + "\r\n" + origins + withToken("Bearer ", support::kLookToken);
    return requestStatus(server.port(), "GET /served/skin HTTP/1.1", lines);
  };
  const std::string own = "Origin: http://127.0.0.1:" + port + "\r\n";
  EXPECT_EQ(status("127.0.0.1:" + port, own), 200);
  EXPECT_EQ(status(evil, "Origin: http://" + evil + "\r\n"), 403) << "the browser's own word for such a page";
  EXPECT_EQ(status("127.0.0.1:" + port, "Origin: http://" + evil + "\r\n"), 403);
  EXPECT_EQ(status(evil, own + "Origin: http://" + evil + "\r\n"), 403);
  EXPECT_EQ(status(evil, "Origin: http://" + evil + "\r\n" + own), 403);
}

TEST(ServeGuards, OnAllInterfacesItNamesAddressesThatCanBeOpenedAndSaysThatItIsPlain) {
  const ServedCommand server({"--host", "0.0.0.0"});
  const auto& line = server.firstLine();
  ASSERT_FALSE(line["addresses"].empty());
  EXPECT_EQ(line["address"], line["addresses"][0]);
  EXPECT_FALSE(line["tls"]);
  for (const std::string address : line["addresses"]) EXPECT_EQ(address.find("0.0.0.0"), std::string::npos) << address;
  const std::string loopback = "http://127.0.0.1:" + std::to_string(server.port());
  EXPECT_EQ(line["addresses"].back(), loopback);
  EXPECT_NE(support::contentOf(server.folder() / "err").find("plain HTTP"), std::string::npos);
}

TEST(ServeGuards, OnLoopbackPlainHttpNeedsNoWord) {
  const ServedCommand server;
  EXPECT_EQ(server.firstLine()["addresses"].size(), 1u);
  EXPECT_EQ(support::contentOf(server.folder() / "err").find("plain HTTP"), std::string::npos);
}

/// A certificate of its own for 127.0.0.1.
class ServeOverTls : public testing::Test {
 protected:
  ServeOverTls() {
    const auto made = support::runProgram(
        "openssl",
        "req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -days 2 -subj /CN=palpate -addext "
        "subjectAltName=IP:127.0.0.1 -keyout key.pem -out cert.pem",
        folder_.path());
    EXPECT_EQ(made.exit_code, 0) << made.err;
    SSL_CTX_load_verify_locations(tls_.get(), cert().c_str(), nullptr);
    SSL_CTX_set_verify(tls_.get(), SSL_VERIFY_PEER, nullptr);
  }
  std::string cert() const { return (folder_ / "cert.pem").string(); }
  std::string key() const { return (folder_ / "key.pem").string(); }
  support::TemporaryFolder folder_;
  std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)> tls_{SSL_CTX_new(TLS_client_method()), &SSL_CTX_free};
};

TEST_F(ServeOverTls, PageAndStreamComeAndPlainRequestsDoNot) {
  ServedCommand server({"--tls-cert", cert(), "--tls-key", key()});
  ASSERT_TRUE(server.firstLine()["tls"]);
  const std::string address = server.firstLine()["address"];
  EXPECT_TRUE(address.starts_with("https://127.0.0.1:")) << address;
  PlainWire wire(server.port(), tls_.get());
  ASSERT_TRUE(wire.isOpen());
  EXPECT_EQ(support::ask(wire, "GET", "/m.js").body, "export const one = 1;\n");
  EXPECT_EQ(support::ask(wire, "GET", "/served/state").status, 401);
  PlainStream stream(server.port(), support::kLookToken, "Origin: " + address + "\r\n", tls_.get());
  ASSERT_EQ(stream.status(), 101) << stream.head();
  EXPECT_TRUE(stream.receiveText("hello"));
  EXPECT_TRUE(stream.receiveKind(2)) << "frames";
  const std::string plain = "Origin: http" + address.substr(5) + "\r\n";
  EXPECT_EQ(PlainStream(server.port(), support::kLookToken, plain, tls_.get()).status(), 403) << "not its own address";
  PlainWire bare(server.port());
  EXPECT_EQ(support::ask(bare, "GET", "/").status, 0);
  SSL_CTX_set_max_proto_version(tls_.get(), TLS1_1_VERSION);
  EXPECT_FALSE(PlainWire(server.port(), tls_.get()).isOpen()) << "TLS 1.1";
  EXPECT_EQ(server.end(SIGTERM), 143);
}

/// A client of Debian's own settings could not speak an older one either: asked here, not over a line.
TEST_F(ServeOverTls, NoVersionBefore12IsSpokenWhateverTheSystemAllows) {
  const auto context = app::serving::tlsFrom(cert(), key());
  EXPECT_EQ(SSL_CTX_get_min_proto_version(context->native_handle()), TLS1_2_VERSION);
}

TEST_F(ServeOverTls, WrongFilesAreRefusedInOneLine) {
  const ServedCommand dome;
  const auto refusal = [&](const std::string& words) {
    const auto result = support::runPalpate("serve dome.ply --port 0 " + words, dome.folder().path());
    EXPECT_NE(result.exit_code, 0) << words;
    return result.err;
  };
  EXPECT_NE(refusal("--tls-cert " + cert()).find("--tls-key"), std::string::npos);
  EXPECT_NE(refusal("--tls-cert " + key() + " --tls-key " + key()).find("must be a certificate"), std::string::npos);
  EXPECT_NE(refusal("--tls-cert " + cert() + " --tls-key " + cert()).find("other users can read"), std::string::npos);
  std::filesystem::permissions(cert(), std::filesystem::perms::owner_read);
  EXPECT_NE(refusal("--tls-cert " + cert() + " --tls-key " + cert()).find("must be the private key"),
            std::string::npos);
  std::filesystem::permissions(key(), static_cast<std::filesystem::perms>(0604));
  EXPECT_NE(refusal("--tls-cert " + cert() + " --tls-key " + key()).find("chmod 600"), std::string::npos);
}

}  // namespace
}  // namespace palpate
