// Boost.Asio, one thread and no lock: calls from outside are posted to it.
#include "cli/serve/network.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/v6_only.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "cli/serve/access.h"
#include "cli/serve/hall.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/system/network.h"

namespace palpate::app::serving {

namespace asio = boost::asio;

namespace {

// The addresses under which a browser reaches a server on this computer.

std::string inBrackets(const std::string& host) {
  return host.find(':') == std::string::npos ? host : "[" + host + "]";
}

/// The address itself; for 0.0.0.0 and :: those of this computer's active interfaces, loopback last. IPv6 in brackets.
std::vector<std::string> reachableHosts(const std::string& host) {
  const bool v6 = host == "::";
  if (!v6 && host != "0.0.0.0") return {inBrackets(host)};
  std::vector<std::string> hosts;
  for (const std::string& address : system::ownAddresses(v6)) {
    const std::string found = inBrackets(address);
    if (std::find(hosts.begin(), hosts.end(), found) == hosts.end()) hosts.push_back(found);
  }
  std::stable_partition(hosts.begin(), hosts.end(), [](const std::string& found) { return !isLoopback(found); });
  return hosts.empty() ? std::vector<std::string>{inBrackets(host)} : hosts;
}

constexpr std::chrono::milliseconds kRound{50};
constexpr int kRoundsPerState = 20;  // one second
constexpr std::chrono::milliseconds kNoSocketsLeft{200};
constexpr double kGoodbyeS = 1.0;
/// Frames that wait for the thread; more would only be older.
constexpr int kMaxPosted = 3;

asio::ip::address parseAddress(const std::string& host) {
  boost::system::error_code error;
  const auto address = asio::ip::make_address(host == "localhost" ? "127.0.0.1" : host, error);
  if (error) throw Error(fmt::format("--host {}: is not an address of this computer, such as 127.0.0.1", host));
  return address;
}

}  // namespace

struct Network::Impl {
  Impl(const NetworkSettings& settings, ServedContent exhibits, FingerControl control)
      : hall(settings, std::move(exhibits), std::move(control)), acceptor(events), rounds(events), retry(events) {}

  void listen();
  void accept();
  void runRound(int round);
  void run();
  void end();

  Connections hall;  // first: what happens at the end of the events still counts
  asio::io_context events{1};
  asio::ip::tcp::acceptor acceptor;
  asio::steady_timer rounds;
  asio::steady_timer retry;
  std::atomic<int> posted{0};
  double goodbye_s = 0.0;
  std::thread thread;
};

void Network::Impl::listen() {
  const asio::ip::tcp::endpoint at(parseAddress(hall.settings.host), static_cast<std::uint16_t>(hall.settings.port));
  boost::system::error_code error;
  acceptor.open(at.protocol(), error);
  if (!error) system::claimPort(numberOf(acceptor));
  if (!error && at.address().is_v6()) acceptor.set_option(asio::ip::v6_only(false), error);  // "::" is both
  if (!error) acceptor.bind(at, error);
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error) throw Error(fmt::format("{}:{}: {}", hall.settings.host, hall.settings.port, error.message()));
  hall.port = acceptor.local_endpoint().port();
}

void Network::Impl::accept() {
  acceptor.async_accept([this](boost::system::error_code error, Socket socket) {
    if (hall.closing) return;
    if (error) {  // no sockets left: open ones end sooner or later
      retry.expires_after(kNoSocketsLeft);
      retry.async_wait([this](boost::system::error_code stopped) {
        if (!stopped && !hall.closing) accept();
      });
      return;
    }
    beginVisit(std::move(socket), hall);
    accept();
  });
}

/// Twenty times a second: releases silent fingers, closes stalled watchers, sends the state; at the end, stops.
void Network::Impl::runRound(int round) {
  hall.control.tick(hall.now());
  for (auto at = hall.watchers.begin(); at != hall.watchers.end();) look(*(at++)->second);
  if (hall.closing && (hall.watchers.empty() || hall.now() - goodbye_s > kGoodbyeS)) return events.stop();
  if (round % kRoundsPerState == 0) hall.publishState();
  rounds.expires_after(kRound);
  rounds.async_wait([this, round](boost::system::error_code stopped) {
    if (!stopped) runRound(round + 1);
  });
}

void Network::Impl::run() {
  while (true) {
    try {
      events.run();
      return;
    } catch (const std::exception&) {  // out of memory for one connection: the others continue
      ++hall.counts.dropped;
    }
  }
}

void Network::Impl::end() {
  hall.closing = true;
  goodbye_s = hall.now();
  boost::system::error_code ignored;
  acceptor.close(ignored);
  hall.control.close(hall.now());
  for (auto at = hall.watchers.begin(); at != hall.watchers.end();) sendAway(*(at++)->second);
}

Network::Network(const NetworkSettings& settings, ServedContent exhibits, FingerControl control)
    : impl_(std::make_unique<Impl>(settings, std::move(exhibits), std::move(control))) {
  impl_->listen();
  impl_->accept();
  impl_->runRound(0);
  impl_->thread = std::thread([parts = impl_.get()] { parts->run(); });
}

Network::~Network() {
  asio::post(impl_->events, [parts = impl_.get()] { parts->end(); });
  impl_->thread.join();
  impl_->hall.watchers.clear();  // their sockets close before the events end
}

int Network::port() const { return impl_->hall.port; }

std::vector<std::string> Network::addresses() const {
  const NetworkSettings& settings = impl_->hall.settings;
  std::vector<std::string> addresses;
  for (const std::string& host : reachableHosts(settings.host)) {
    addresses.push_back(fmt::format("{}://{}:{}", settings.tls ? "https" : "http", host, port()));
  }
  return addresses;
}

void Network::show(std::shared_ptr<const std::string> frame) {
  Impl* parts = impl_.get();
  if (parts->posted.load() >= kMaxPosted) return;
  ++parts->posted;
  asio::post(parts->events, [parts, frame = std::move(frame)] {
    --parts->posted;
    parts->hall.show(frame);
  });
}

bool Network::hasSubscribers() const { return impl_->hall.counts.listening.load() > 0; }

void Network::publishTouch(std::vector<trace::Sample> felt) {
  Impl* parts = impl_.get();
  if (parts->posted.load() >= kMaxPosted) return;
  ++parts->posted;
  asio::post(parts->events, [parts, felt = std::move(felt)]() mutable {
    --parts->posted;
    parts->hall.publishTouch(TouchTexts(parts->hall.exhibits.pressure, std::move(felt)));
  });
}

void Network::publishStats(Json vitals) {
  asio::post(impl_->events,
             [parts = impl_.get(), vitals = std::move(vitals)]() mutable { parts->hall.vitals = std::move(vitals); });
}

NetworkCounts Network::counts() const {
  const HallCounts& counts = impl_->hall.counts;
  return {counts.watchers,   counts.most_watchers, counts.frames_sent,    counts.frames_skipped,
          counts.bytes_sent, counts.refused_token, counts.refused_origin, counts.refused_full,
          counts.malformed,  counts.dropped,       counts.hung_up};
}

// --- the hall

std::string Connections::state() const {
  Json json = {
      {"type", "state"}, {"holder", control.holder()}, {"paused", control.paused()}, {"onlookers", watchers.size()}};
  if (!vitals.is_null()) json["servo"] = vitals;
  return jsonDump(json);
}

void Connections::publishState() {
  const std::string text = state();
  for (const auto& [id, watcher] : watchers) sendState(*watcher, text);
}

void Connections::publishMessage(const std::string& words) {
  const std::string text = jsonDump(Json{{"type", "message"}, {"text", words}});
  for (const auto& [id, watcher] : watchers) queueMessage(*watcher, text);
}

void Connections::publishTouch(TouchTexts texts) {
  for (const auto& [id, watcher] : watchers) serving::publishTouch(*watcher, texts);
}

void Connections::show(const Frame& frame) {
  newest = frame;
  for (const auto& [id, watcher] : watchers) serving::show(*watcher, frame);
}

void Connections::join(const std::shared_ptr<Watcher>& watcher, WatcherId id) {
  watchers.emplace(id, watcher);
  counts.watchers = watchers.size();
  counts.most_watchers = std::max<std::uint64_t>(counts.most_watchers, watchers.size());
}

void Connections::leave(WatcherId id) {
  if (watchers.erase(id) == 0) return;
  counts.watchers = watchers.size();
  control.left(id, now());
  if (!closing) publishState();
}

void Connections::makeRoom(VisitId id) {
  const auto visit = hang_up.find(id);
  if (visit == hang_up.end()) return;
  ++counts.hung_up;
  visit->second();
  hang_up.erase(id);
}

}  // namespace palpate::app::serving
