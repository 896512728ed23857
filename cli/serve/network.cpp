// Boost.Asio, one thread and no lock: everything that comes from outside it is posted to it.
#include "cli/serve/network.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <thread>
#include <utility>

#include "cli/serve/hall.h"
#include "cli/serve/own_addresses.h"
#include "palpate/base/error.h"

namespace palpate::app::serving {

namespace asio = boost::asio;

namespace {

constexpr std::chrono::milliseconds kRound{50};
constexpr int kRoundsPerState = 20;  // a second
constexpr std::chrono::milliseconds kNoSocketsLeft{200};
constexpr double kGoodbyeS = 1.0;
/// Frames that wait for the thread; more would only be older.
constexpr int kMostPosted = 2;

asio::ip::address addressOf(const std::string& host) {
  boost::system::error_code error;
  const auto address = asio::ip::make_address(host == "localhost" ? "127.0.0.1" : host, error);
  if (error) throw Error(fmt::format("--host {}: is no address of this computer, such as 127.0.0.1", host));
  return address;
}

}  // namespace

struct Network::Parts {
  Parts(const NetworkSettings& settings, Exhibits exhibits, ControlDesk desk)
      : hall(settings, std::move(exhibits), std::move(desk)), acceptor(events), rounds(events), retry(events) {}

  void listen();
  void accept();
  void goRound(int round);
  void run();
  void end();

  Hall hall;  // first: what happens at the end of the events still counts
  asio::io_context events{1};
  asio::ip::tcp::acceptor acceptor;
  asio::steady_timer rounds;
  asio::steady_timer retry;
  std::atomic<int> posted{0};
  double goodbye_s = 0.0;
  std::thread thread;
};

void Network::Parts::listen() {
  const asio::ip::tcp::endpoint at(addressOf(hall.settings.host), static_cast<std::uint16_t>(hall.settings.port));
  boost::system::error_code error;
  acceptor.open(at.protocol(), error);
  if (!error) acceptor.set_option(asio::socket_base::reuse_address(true), error);
  if (!error) acceptor.bind(at, error);
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error) throw Error(fmt::format("{}:{}: {}", hall.settings.host, hall.settings.port, error.message()));
  hall.port = acceptor.local_endpoint().port();
}

void Network::Parts::accept() {
  acceptor.async_accept([this](boost::system::error_code error, Socket socket) {
    if (hall.closing) return;
    if (error) {  // no sockets left: those that there are end sooner or later
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

/// Twenty times a second: silent fingers, stalled onlookers, news of the state; and at the end, who is still there.
void Network::Parts::goRound(int round) {
  hall.desk.tick(hall.now());
  for (auto at = hall.onlookers.begin(); at != hall.onlookers.end();) look(*(at++)->second);
  if (hall.closing && (hall.onlookers.empty() || hall.now() - goodbye_s > kGoodbyeS)) return events.stop();
  if (round % kRoundsPerState == 0) hall.tellState();
  rounds.expires_after(kRound);
  rounds.async_wait([this, round](boost::system::error_code stopped) {
    if (!stopped) goRound(round + 1);
  });
}

void Network::Parts::run() {
  while (true) {
    try {
      events.run();
      return;
    } catch (const std::exception&) {  // out of memory for one connection: the others go on
      ++hall.counts.dropped;
    }
  }
}

void Network::Parts::end() {
  hall.closing = true;
  goodbye_s = hall.now();
  boost::system::error_code ignored;
  acceptor.close(ignored);
  hall.desk.close(hall.now());
  for (auto at = hall.onlookers.begin(); at != hall.onlookers.end();) sendAway(*(at++)->second);
}

Network::Network(const NetworkSettings& settings, Exhibits exhibits, ControlDesk desk)
    : parts_(std::make_unique<Parts>(settings, std::move(exhibits), std::move(desk))) {
  parts_->listen();
  parts_->accept();
  parts_->goRound(0);
  parts_->thread = std::thread([parts = parts_.get()] { parts->run(); });
}

Network::~Network() {
  asio::post(parts_->events, [parts = parts_.get()] { parts->end(); });
  parts_->thread.join();
  parts_->hall.onlookers.clear();  // their sockets go before the events
}

int Network::port() const { return parts_->hall.port; }

std::vector<std::string> Network::addresses() const {
  const NetworkSettings& settings = parts_->hall.settings;
  std::vector<std::string> addresses;
  for (const std::string& host : reachableHosts(settings.host)) {
    addresses.push_back(fmt::format("{}://{}:{}", settings.tls ? "https" : "http", host, port()));
  }
  return addresses;
}

void Network::show(std::shared_ptr<const std::string> frame) {
  Parts* parts = parts_.get();
  if (parts->posted.load() >= kMostPosted) return;
  ++parts->posted;
  asio::post(parts->events, [parts, frame = std::move(frame)] {
    --parts->posted;
    parts->hall.show(frame);
  });
}

void Network::tellVitals(nlohmann::ordered_json vitals) {
  asio::post(parts_->events,
             [parts = parts_.get(), vitals = std::move(vitals)]() mutable { parts->hall.vitals = std::move(vitals); });
}

NetworkCounts Network::counts() const {
  const HallCounts& counts = parts_->hall.counts;
  return {counts.onlookers,  counts.most_onlookers, counts.frames_sent,    counts.frames_skipped,
          counts.bytes_sent, counts.refused_token,  counts.refused_origin, counts.refused_full,
          counts.malformed,  counts.dropped,        counts.hung_up};
}

// --- the hall

std::string Hall::state() const {
  nlohmann::ordered_json json = {
      {"type", "state"}, {"holder", desk.holder()}, {"paused", desk.paused()}, {"onlookers", onlookers.size()}};
  if (!vitals.is_null()) json["servo"] = vitals;
  return json.dump();
}

void Hall::tellState() {
  const std::string text = state();
  for (const auto& [id, onlooker] : onlookers) tell(*onlooker, text);
}

void Hall::tellMessage(const std::string& words) {
  const std::string text = nlohmann::ordered_json{{"type", "message"}, {"text", words}}.dump();
  for (const auto& [id, onlooker] : onlookers) tellWords(*onlooker, text);
}

void Hall::show(const Frame& frame) {
  newest = frame;
  for (const auto& [id, onlooker] : onlookers) serving::show(*onlooker, frame);
}

void Hall::join(const std::shared_ptr<Onlooker>& onlooker, OnlookerId id) {
  onlookers.emplace(id, onlooker);
  counts.onlookers = onlookers.size();
  counts.most_onlookers = std::max<std::uint64_t>(counts.most_onlookers, onlookers.size());
}

void Hall::leave(OnlookerId id) {
  if (onlookers.erase(id) == 0) return;
  counts.onlookers = onlookers.size();
  desk.left(id, now());
  if (!closing) tellState();
}

void Hall::makeRoom(VisitId id) {
  const auto visit = hang_up.find(id);
  if (visit == hang_up.end()) return;
  ++counts.hung_up;
  visit->second();
  hang_up.erase(id);
}

}  // namespace palpate::app::serving
