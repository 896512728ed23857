// Boost.Beast over Asio. An operation is started and the loop of events run until it is done or its time is over; then
// the socket is closed, which ends the operation. Cold path: the servo is never here.
#include "palpate/device/hardware/haply_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/device/hardware/haply_message.h"

namespace palpate::device::haply {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using Tcp = asio::ip::tcp;
using Status = boost::system::error_code;

constexpr std::size_t kLongestWords = 200;

/// A socket that is not waited for longer than that.
class Wire {
 public:
  Wire(Address address, double patience_s) : address_(std::move(address)), patience_s_(patience_s), socket_(events_) {
    Status status;
    const auto found = Tcp::resolver(events_).resolve(address_.host, std::to_string(address_.port), status);
    if (status) refuse(status.message());
    finish([&](auto done) { asio::async_connect(socket_, found, done); });
    socket_.set_option(Tcp::no_delay(true), status);  // a force must not wait for company
  }

  Tcp::socket& socket() { return socket_; }

  /// Starts an operation by a function that takes what to call at its end, and waits for it.
  template <class Start>
  void finish(const Start& start) {
    Status result = asio::error::timed_out;
    bool ended = false;
    start([&](Status status, const auto&...) {
      result = status;
      ended = true;
    });
    events_.restart();
    events_.run_for(std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(patience_s_)));
    const bool in_time = ended;
    if (!in_time) {
      Status ignored;
      socket_.close(ignored);
      events_.restart();
      events_.run();  // the operation ends now, and lets go of what it refers to
    }
    if (!in_time) refuse(fmt::format("no answer within {:.2f} s", patience_s_));
    if (result) refuse(result.message());
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw Error(words(address_) + ": " + oneLine(why, kLongestWords));
  }

  Address address_;
  double patience_s_;
  asio::io_context events_;
  Tcp::socket socket_;
};

}  // namespace

std::string words(const Address& address) { return fmt::format("{}:{}", address.host, address.port); }

struct Connection::Impl {
  Impl(const Address& address, double patience_s) : wire(address, patience_s), stream(wire.socket()) {
    stream.read_message_max(kMaxReplyBytes);
    wire.finish([&](auto done) { stream.async_handshake(words(address), "/", done); });
    stream.text(true);
  }
  Wire wire;
  beast::websocket::stream<Tcp::socket&> stream;
  beast::flat_buffer buffer;
};

Connection::Connection(const Address& address, double patience_s)
    : impl_(std::make_unique<Impl>(address, patience_s)) {}

Connection::~Connection() = default;

std::string_view Connection::receive() {
  Impl& self = *impl_;
  self.buffer.clear();
  self.wire.finish([&](auto done) { self.stream.async_read(self.buffer, done); });
  const auto bytes = self.buffer.cdata();
  return {static_cast<const char*>(bytes.data()), bytes.size()};
}

void Connection::send(std::string_view text) {
  Impl& self = *impl_;
  self.wire.finish([&](auto done) { self.stream.async_write(asio::buffer(text.data(), text.size()), done); });
}

std::string httpGet(const Address& address, const std::string& path, double patience_s) {
  namespace http = beast::http;
  Wire wire(address, patience_s);
  http::request<http::empty_body> request(http::verb::get, path, 11);
  request.set(http::field::host, words(address));
  wire.finish([&](auto done) { http::async_write(wire.socket(), request, done); });
  beast::flat_buffer buffer;
  http::response_parser<http::string_body> answer;
  answer.body_limit(kMaxReplyBytes);
  wire.finish([&](auto done) { http::async_read(wire.socket(), buffer, answer, done); });
  if (answer.get().result() != http::status::ok) {
    throw Error(fmt::format("{}{}: status {}", words(address), path, answer.get().result_int()));
  }
  return answer.get().body();
}

}  // namespace palpate::device::haply
