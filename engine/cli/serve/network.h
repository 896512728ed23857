// The network side of `palpate serve`: one thread that serves the page, the skin and sixty frames a second, and handles
// the pages' requests.
//
//   show(frame) ─► newest frame ─► each watcher that is ready for one (the others skip it)
//   page ─ Request ─► FingerControl ─► the servo's mouse links (triple buffers)
//
// Neither the servo nor the caller ever waits for it: late frames are left out.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "cli/serve/access.h"
#include "cli/serve/finger_control.h"
#include "cli/serve/site.h"
#include "palpate/base/json.h"
#include "palpate/engine/felt_pressure.h"
#include "palpate/trace/sample.h"

namespace boost::asio::ssl {
class context;
}

namespace palpate::app::serving {

struct NetworkSettings {
  std::string host = "127.0.0.1";  ///< an address of this computer, or "localhost"
  int port = 8080;                 ///< 0: any that is free
  Tokens tokens;
  std::shared_ptr<boost::asio::ssl::context> tls;  ///< null: plain HTTP
  std::vector<std::string> origins;                ///< pages from there may look, besides the server's own
  std::size_t watchers = 64;                       ///< at once
  double handshake_s = 10.0;                       ///< for a complete request, TLS included
  double silence_s = 20.0;                         ///< without an answer to a ping, a watcher is gone
  double stall_s = 5.0;                            ///< and without receiving anything
  double piece_s = 10.0;                           ///< for a client to receive 64 KiB of an answer
};

/// Served content, made once.
struct ServedContent {
  Site site;
  std::string skin;                                                ///< engine::encodedSkin
  std::string forms;                                               ///< engine::encodedForms
  Json facts;                                                      ///< for the hello
  std::shared_ptr<const engine::FeltPressure> pressure = nullptr;  ///< null: the tissue has no patterns
};

/// Since the start, except for the first.
struct NetworkCounts {
  std::uint64_t watchers = 0;  ///< now
  std::uint64_t most_watchers = 0;
  std::uint64_t frames_sent = 0;
  std::uint64_t frames_skipped = 0;  ///< watchers were not ready
  std::uint64_t bytes_sent = 0;      ///< in frames
  std::uint64_t refused_token = 0;
  std::uint64_t refused_origin = 0;
  std::uint64_t refused_full = 0;
  std::uint64_t malformed = 0;  ///< requests and messages
  std::uint64_t dropped = 0;    ///< silent or stalled watchers
  std::uint64_t hung_up = 0;    ///< stalled requests closed for new ones
};

class Network {
 public:
  /// Listens when it returns. Throws Error: no such address, a port that is taken.
  Network(const NetworkSettings& settings, ServedContent exhibits, FingerControl control);
  /// Releases the fingers, sends an end to all watchers and waits a second at most.
  ~Network();
  Network(const Network&) = delete;
  Network& operator=(const Network&) = delete;

  int port() const;
  /// "http://127.0.0.1:8080": the addresses for a browser, at least one.
  std::vector<std::string> addresses() const;

  // The owner's thread; none of them waits.

  /// `frame` is the newest; it is sent unchanged.
  void show(std::shared_ptr<const std::string> frame);
  /// Whether any watcher subscribed to the fingers' outputs.
  bool hasSubscribers() const;
  /// Sends the fingers' newest outputs to those.
  void publishTouch(std::vector<trace::Sample> felt);
  /// The servo's health: a JSON object for the state message.
  void publishStats(Json vitals);
  NetworkCounts counts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate::app::serving
