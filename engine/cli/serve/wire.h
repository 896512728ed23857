// A connection, plain or over TLS: one type for both, so that visits and streams are written once. It is an
// asynchronous stream in Beast's sense.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/beast/core/role.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/ssl/ssl_stream.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <boost/beast/websocket/teardown.hpp>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <utility>

// On Windows Asio includes the system's headers, where a macro has the name of a function of ours. Files that include
// more of Boost than this include this first.
#undef near

namespace palpate::app::serving {

// A certificate and its key out of two files, for `palpate serve` over TLS.

using TlsContext = boost::asio::ssl::context;

/// PEM: the certificate with its chain, and its key, which the group may read and others may not. TLS 1.2 and 1.3.
/// Throws Error: no such files, another form, a key of another certificate, or one that others may read.
std::shared_ptr<TlsContext> tlsFrom(const std::filesystem::path& certificate, const std::filesystem::path& key);

using Socket = boost::asio::ip::tcp::socket;

/// The system's number (base/system/network.h).
template <class OfAsio>
std::intptr_t numberOf(OfAsio& socket) {
  return static_cast<std::intptr_t>(socket.native_handle());
}

// The names are Beast's.
// NOLINTBEGIN(readability-identifier-naming)
class Wire {
 public:
  using next_layer_type = boost::beast::tcp_stream;
  using executor_type = next_layer_type::executor_type;

  /// `tls` null: plain. It must stay alive.
  Wire(Socket socket, TlsContext* tls) {
    if (tls == nullptr) {
      plain_ = std::make_unique<next_layer_type>(std::move(socket));
    } else {
      tls_ = std::make_unique<Tls>(std::move(socket), *tls);
    }
  }

  bool isTls() const { return tls_ != nullptr; }
  executor_type get_executor() { return next_layer().get_executor(); }
  next_layer_type& next_layer() { return tls_ ? tls_->next_layer() : *plain_; }
  const next_layer_type& next_layer() const { return tls_ ? tls_->next_layer() : *plain_; }

  /// For TLS only.
  template <class Handler>
  void async_handshake(Handler&& handler) {
    tls_->async_handshake(boost::asio::ssl::stream_base::server, std::forward<Handler>(handler));
  }
  template <class Buffers, class Handler>
  void async_read_some(const Buffers& buffers, Handler&& handler) {
    if (tls_) {
      tls_->async_read_some(buffers, std::forward<Handler>(handler));
    } else {
      plain_->async_read_some(buffers, std::forward<Handler>(handler));
    }
  }
  template <class Buffers, class Handler>
  void async_write_some(const Buffers& buffers, Handler&& handler) {
    if (tls_) {
      tls_->async_write_some(buffers, std::forward<Handler>(handler));
    } else {
      plain_->async_write_some(buffers, std::forward<Handler>(handler));
    }
  }

  friend void teardown(boost::beast::role_type role, Wire& wire, boost::system::error_code& error) {
    using boost::beast::teardown;
    using boost::beast::websocket::teardown;
    if (wire.tls_) {
      teardown(role, *wire.tls_, error);
    } else {
      teardown(role, *wire.plain_, error);
    }
  }
  template <class Handler>
  friend void async_teardown(boost::beast::role_type role, Wire& wire, Handler&& handler) {
    using boost::beast::async_teardown;
    using boost::beast::websocket::async_teardown;
    if (wire.tls_) {
      async_teardown(role, *wire.tls_, std::forward<Handler>(handler));
    } else {
      async_teardown(role, *wire.plain_, std::forward<Handler>(handler));
    }
  }

 private:
  using Tls = boost::beast::ssl_stream<next_layer_type>;
  std::unique_ptr<next_layer_type> plain_;
  std::unique_ptr<Tls> tls_;
};
// NOLINTEND(readability-identifier-naming)

}  // namespace palpate::app::serving
