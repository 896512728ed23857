// The network side of `palpate serve`: one thread that hands out the page, the skin and sixty frames a second, and
// hears what pages request.
//
//   show(frame) ─► newest frame ─► each watcher that is ready for one (the others skip it)
//   page ─ Request ─► FingerControl ─► the servo's mouse links (triple buffers)
//
// The servo never waits for it, nor does the caller: what has no time is left out.
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
  double handshake_s = 10.0;                       ///< for a request to be complete, that of TLS included
  double silence_s = 20.0;                         ///< a watcher that answers no ping for so long is gone
  double stall_s = 5.0;                            ///< and one that takes nothing for so long
  double piece_s = 10.0;                           ///< for 64 KiB of an answer to be taken
};

/// What is shown, made once.
struct Exhibits {
  Site site;
  std::string skin;                                                ///< engine::encodedSkin
  std::string forms;                                               ///< engine::encodedForms
  Json facts;                                                      ///< of the hello
  std::shared_ptr<const engine::FeltPressure> pressure = nullptr;  ///< null: the tissue has no patterns
};

/// Since the start, but for the first.
struct NetworkCounts {
  std::uint64_t watchers = 0;  ///< now
  std::uint64_t most_watchers = 0;
  std::uint64_t frames_sent = 0;
  std::uint64_t frames_skipped = 0;  ///< by those that were not ready
  std::uint64_t bytes_sent = 0;      ///< of the frames
  std::uint64_t refused_token = 0;
  std::uint64_t refused_origin = 0;
  std::uint64_t refused_full = 0;
  std::uint64_t malformed = 0;  ///< requests and messages
  std::uint64_t dropped = 0;    ///< watchers that were silent or took nothing
  std::uint64_t hung_up = 0;    ///< requests that got nowhere, for others that came
};

class Network {
 public:
  /// Listens when it returns. Throws Error: no such address, a port that is taken.
  Network(const NetworkSettings& settings, Exhibits exhibits, FingerControl control);
  /// Lets go the fingers, tells everybody that it ends and waits a second at most.
  ~Network();
  Network(const Network&) = delete;
  Network& operator=(const Network&) = delete;

  int port() const;
  /// "http://127.0.0.1:8080": those under which a browser reaches it, at least one.
  std::vector<std::string> addresses() const;

  // The owner's thread; none of them waits.

  /// `frame` is the newest; it is sent as it is.
  void show(std::shared_ptr<const std::string> frame);
  /// Whether anybody wants to be told what the fingers feel.
  bool isListenedTo() const;
  /// What they felt in their newest tick, for those.
  void tellTouch(std::vector<trace::Sample> felt);
  /// How the servo is doing: a JSON object for the state message.
  void publishStats(Json vitals);
  NetworkCounts counts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate::app::serving
