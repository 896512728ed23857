// State shared by all connections of the network thread: watchers, exhibits, counts. Only that thread touches it,
// except for the counts.
#pragma once

#include <atomic>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "cli/serve/access.h"
#include "cli/serve/network.h"
#include "cli/serve/touch_text.h"
#include "cli/serve/visit_book.h"
#include "cli/serve/wire.h"
#include "palpate/base/json.h"
#include "palpate/base/stopwatch.h"

namespace palpate::app::serving {

using HttpRequest = boost::beast::http::request<boost::beast::http::empty_body>;

class Watcher;

struct HallCounts {
  std::atomic<std::uint64_t> watchers{0}, most_watchers{0}, frames_sent{0}, frames_skipped{0}, bytes_sent{0},
      refused_token{0}, refused_origin{0}, refused_full{0}, malformed{0}, dropped{0}, hung_up{0}, listening{0};
};

struct Connections {
  Connections(NetworkSettings of, ServedContent shown, FingerControl at)
      : settings(std::move(of)), exhibits(std::move(shown)), control(std::move(at)) {}

  const NetworkSettings settings;
  const ServedContent exhibits;
  FingerControl control;
  int port = 0;
  HallCounts counts;
  std::map<WatcherId, std::shared_ptr<Watcher>> watchers;
  WatcherId last_id = 0;
  VisitBook book;
  std::map<VisitId, std::function<void()>> hang_up;  ///< for those in the book
  VisitId last_visit = 0;
  Frame newest;
  Json vitals;
  bool closing = false;
  const Clock::time_point began = Clock::now();

  double now() const { return secondsSince(began); }
  std::string state() const;
  /// Sends it to all watchers.
  void publishState();
  void publishMessage(const std::string& words);
  /// Sends it to subscribers.
  void publishTouch(TouchTexts texts);
  void show(const Frame& frame);
  void join(const std::shared_ptr<Watcher>& watcher, WatcherId id);
  void leave(WatcherId id);
  /// Closes this connection, if any, to make room.
  void makeRoom(VisitId id);
};

/// Answers the requests on this socket, one after the other, and makes a watcher of one for the stream. Keeps itself
/// alive.
void beginVisit(Socket socket, Connections& hall);

/// Completes the handshake and streams until it ends. Keeps itself alive; the hall knows it from the handshake on.
void beginLooking(Wire wire, Connections& hall, Role role, const HttpRequest& request);

/// For Connections: messages to all watchers, and their end.
void sendState(Watcher& watcher, const std::string& state);
void queueMessage(Watcher& watcher, const std::string& message);
void publishTouch(Watcher& watcher, TouchTexts& texts);
void show(Watcher& watcher, const Frame& frame);
/// Closes watchers that receive nothing; call it some times a second.
void look(Watcher& watcher);
void sendAway(Watcher& watcher);

inline constexpr std::uint32_t kMaxHeaderBytes = 8192;

/// An answer is sent in such pieces, each with its own deadline: a skin of millions of triangles may take long over a
/// slow line, but not for ever.
inline constexpr std::size_t kPieceBytes = 65536;

/// A page sends sixty a second, a hasty one a hundred more.
inline constexpr double kMaxRequestsPerS = 200.0;

/// The protocol that both sides name; a page's token goes with it, where no log records it.
inline constexpr std::string_view kProtocol = "palpate.1";
inline constexpr std::string_view kTokenProtocol = "palpate.token.";

}  // namespace palpate::app::serving
