// `palpate serve` behind a real nginx with TLS: with the configuration that docs/howto/serve.md gives.
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "cli/tests/serve/plain_stream.h"
#include "cli/tests/serve/served_command.h"
#include "palpate/base/text.h"
#include "palpate/engine/contact_stream.h"
#include "support/places.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;
using support::PlainStream;
using support::PlainWire;

std::string nginxProgram() {
  for (const char* place : {"/usr/sbin/nginx", "/usr/bin/nginx", "/usr/local/sbin/nginx"}) {
    if (fs::exists(place)) return place;
  }
  return {};
}

/// The configuration of the page.
std::string nginxOfThePage() {
  const std::string page = readFile(support::sourceFolder() / "docs/howto/serve.md", 1 << 20);
  const std::string fence = "```nginx\n";
  const std::size_t begin = page.find(fence) + fence.size();
  return page.substr(begin, page.find("```", begin) - begin);
}

int freePort() {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in at{};
  at.sin_family = AF_INET;
  at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(at);
  if (::bind(socket, reinterpret_cast<const sockaddr*>(&at), sizeof(at)) != 0) ADD_FAILURE() << "no free port";
  ::getsockname(socket, reinterpret_cast<sockaddr*>(&at), &size);
  ::close(socket);
  return ntohs(at.sin_port);
}

/// Nginx as a child, in a folder of its own.
class Nginx {
 public:
  Nginx(const fs::path& folder, int behind_port) : port_(freePort()) {
    const std::string certificate =
        "req -x509 -newkey rsa:2048 -nodes -days 2 -subj /CN=palpate.example.org -keyout key.pem -out cert.pem";
    EXPECT_EQ(support::runProgram("openssl", certificate, folder).exit_code, 0);
    std::string server = nginxOfThePage();
    server = std::regex_replace(server, std::regex("listen 443"), "listen 127.0.0.1:" + std::to_string(port_));
    server = std::regex_replace(server, std::regex("127.0.0.1:8080"), "127.0.0.1:" + std::to_string(behind_port));
    server =
        std::regex_replace(server, std::regex("/etc/letsencrypt/\\S+/fullchain.pem"), (folder / "cert.pem").string());
    server = std::regex_replace(server, std::regex("/etc/letsencrypt/\\S+/privkey.pem"), (folder / "key.pem").string());
    std::ofstream file(folder / "nginx.conf");
    file << "daemon off; master_process off; pid " << (folder / "nginx.pid").string() << ";\n"
         << "error_log " << (folder / "nginx.log").string() << ";\nevents {}\nhttp {\naccess_log "
         << (folder / "access.log").string() << ";\n";
    for (const char* kind : {"client_body", "proxy", "fastcgi", "uwsgi", "scgi"}) {
      file << kind << "_temp_path " << (folder / kind).string() << ";\n";
    }
    file << server << "}\n";
    file.close();
    const std::string program = nginxProgram();
    const std::string configuration = (folder / "nginx.conf").string();
    child_ = ::fork();
    if (child_ == 0) {
      ::execl(program.c_str(), program.c_str(), "-p", folder.c_str(), "-c", configuration.c_str(), nullptr);
      ::_exit(99);
    }
    EXPECT_TRUE(support::waitFor([&] { return PlainWire(port_).isOpen(); }))
        << support::contentOf(folder / "nginx.log");
  }
  ~Nginx() {
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
  }
  Nginx(const Nginx&) = delete;
  Nginx& operator=(const Nginx&) = delete;
  int port() const { return port_; }

 private:
  int port_;
  pid_t child_ = -1;
};

TEST(ServeProxy, NginxWithTlsBringsPageSkinAndFrames) {
  if (nginxProgram().empty()) GTEST_SKIP() << "nginx is not installed (apt install nginx-light)";
  support::ServedCommand server({"--origin", "https://palpate.example.org"});
  const support::TemporaryFolder& folder = server.folder();
  const Nginx nginx(folder.path(), server.port());
  const std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)> tls(SSL_CTX_new(TLS_client_method()), &SSL_CTX_free);
  ASSERT_EQ(SSL_CTX_load_verify_locations(tls.get(), (folder / "cert.pem").c_str(), nullptr), 1);
  SSL_CTX_set_verify(tls.get(), SSL_VERIFY_PEER, nullptr);

  PlainWire wire(nginx.port(), tls.get());
  ASSERT_TRUE(wire.isOpen()) << "the certificate is not believed";
  const auto page = support::ask(wire, "GET", "/");
  EXPECT_EQ(page.status, 200);
  EXPECT_TRUE(page.has("Cross-Origin-Opener-Policy: same-origin")) << page.head;
  PlainWire again(nginx.port(), tls.get());
  const auto skin = support::ask(again, "GET", "/served/skin", "Authorization: Bearer " + support::kLookToken + "\r\n");
  EXPECT_EQ(engine::decodeSkin(skin.body).mesh.triangles.size(), 800u);

  const std::string own = "Origin: https://palpate.example.org\r\nX-Forwarded-For: 203.0.113.7\r\n";
  PlainStream hand(nginx.port(), support::kControlToken, own, tls.get());
  ASSERT_EQ(hand.status(), 101) << hand.head() << support::contentOf(folder / "nginx.log");
  engine::StreamedFrame frame;
  bool touched = false;
  for (int i = 0; i < 200 && !touched; ++i) {
    hand.say(R"({"type":"finger","finger":0,"pressed":true,"place":[0,0,20],"normal":[0,0,1],"depth_mm":5})");
    const auto message = hand.receiveKind(2);
    ASSERT_TRUE(message);
    touched = engine::decodeFrame(message->bytes, 800, frame) && frame.fingers[0].touch != contact::Touch::free;
  }
  EXPECT_TRUE(touched);
  EXPECT_GT(frame.contacts.size(), 0u);

  for (const char* origin : {"https://evil.example", "http://palpate.example.org"}) {
    const std::string other = std::string("Origin: ") + origin + "\r\nX-Forwarded-Host: palpate.example.org\r\n";
    EXPECT_EQ(PlainStream(nginx.port(), support::kLookToken, other, tls.get()).status(), 403) << origin;
  }
  EXPECT_EQ(PlainStream(nginx.port(), "wrong-0123456789abcdef", own, tls.get()).status(), 401);
  const std::string log = support::contentOf(folder / "access.log");
  EXPECT_NE(log.find("/served/contacts"), std::string::npos);
  for (const std::string& token : {support::kLookToken, support::kControlToken}) {
    EXPECT_EQ(log.find(token), std::string::npos) << "a token stands in the proxy's log";
  }
}

}  // namespace
}  // namespace palpate
