// Requests by HTTP: the page's files, skin and forms for holders of a token, and the way to the stream.
#include "cli/serve/wire.h"

#include <algorithm>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/string.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <chrono>
#include <optional>
#include <utility>

#include "cli/serve/hall.h"
#include "palpate/base/system/network.h"
#include "palpate/base/text.h"

namespace palpate::app::serving {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;

namespace {

using Status = boost::system::error_code;

constexpr std::string_view kBearer = "Bearer ";
constexpr std::string_view kServed = "/served/";
constexpr std::string_view kStream = "/served/contacts";

std::string_view toStringView(beast::string_view text) { return {text.data(), text.size()}; }

std::chrono::milliseconds milliseconds(double seconds) {
  return std::chrono::milliseconds(static_cast<std::int64_t>(1000.0 * seconds));
}

/// The address, for IPv6 the network of one client; empty on this computer, where a proxy has the connections of all.
std::string clientAddress(const Socket& socket) {
  Status status;
  asio::ip::address address = socket.remote_endpoint(status).address();
  if (address.is_v6() && address.to_v6().is_v4_mapped()) {
    address = asio::ip::make_address_v4(asio::ip::v4_mapped, address.to_v6());
  }
  if (address.is_loopback()) return {};
  if (address.is_v4()) return address.to_string();
  constexpr std::size_t kNetBytes = 8;
  const auto bytes = address.to_v6().to_bytes();
  return {reinterpret_cast<const char*>(bytes.data()), kNetBytes};
}

/// The token of "Bearer TOKEN"; the first word in letters of any size (RFC 9110). Empty for anything else.
std::string_view tokenIn(beast::string_view authorization) {
  const beast::string_view scheme = authorization.substr(0, kBearer.size());
  if (!beast::iequals(scheme, {kBearer.data(), kBearer.size()})) return {};
  return trimmed(toStringView(authorization.substr(scheme.size())));
}

/// Without the query.
std::string_view pathOfRequest(const HttpRequest& request) {
  const std::string_view target = toStringView(request.target());
  return target.substr(0, target.find('?'));
}

/// RFC 9112, 3.2: a request of HTTP/1.1 without a Host, with two, or with an invalid one is answered 400: a proxy in
/// front may have used the other.
bool namesOneHost(const HttpRequest& request) {
  const std::size_t hosts = request.count(http::field::host);
  if (hosts == 0) return request.version() < 11;
  return hosts == 1 && isHost(toStringView(request[http::field::host]));
}

/// The first line and the others together: the parser's own limit counts them apart.
std::size_t headBytes(const HttpRequest& request) {
  constexpr std::string_view kVersionAndEnds = "  HTTP/1.1\r\n\r\n";
  std::size_t bytes = request.method_string().size() + request.target().size() + kVersionAndEnds.size();
  for (const auto& line : request) bytes += line.name_string().size() + line.value().size() + 4;  // ": " and its end
  return bytes;
}

/// An answer on its way.
template <class Body>
struct Delivery {
  explicit Delivery(http::response<Body> of) : answer(std::move(of)) {}
  http::response<Body> answer;
  http::response_serializer<Body> serializer{answer};
  std::size_t left_of_piece = 0;
};

class Visit : public std::enable_shared_from_this<Visit> {
 public:
  Visit(Socket socket, Connections& hall)
      : wire_(std::move(socket), hall.settings.tls.get()), hall_(hall), id_(++hall_.last_visit) {}
  ~Visit() { leave(); }
  Visit(const Visit&) = delete;
  Visit& operator=(const Visit&) = delete;

  void begin() {
    // Bounds the system's buffer for a client that does not read: without it some MB each, as much as a fast one is
    // worth.
    constexpr int kUnsentOfAnAnswer = kPieceBytes;
    system::limitUnsent(numberOf(line().socket()), kUnsentOfAnAnswer);
    hall_.hang_up[id_] = [this] { line().close(); };
    hall_.makeRoom(hall_.book.enter(id_, clientAddress(line().socket()), hall_.now()));
    if (!wire_.isTls()) return read();
    line().expires_after(milliseconds(hall_.settings.handshake_s));
    wire_.async_handshake([self = shared_from_this()](Status status) {
      if (!status && !self->hall_.closing) self->read();
    });
  }

 private:
  beast::tcp_stream& line() { return wire_.next_layer(); }

  void leave() {
    hall_.book.leave(id_);
    hall_.hang_up.erase(id_);
  }

  void read() {
    parser_.emplace();
    parser_->header_limit(kMaxHeaderBytes);
    parser_->body_limit(0);
    line().expires_after(milliseconds(hall_.settings.handshake_s));
    http::async_read(wire_, buffer_, *parser_,
                     [self = shared_from_this()](Status status, std::size_t) { self->onRequest(status); });
  }

  void onRequest(Status status) {
    if (status == http::error::end_of_stream || status == beast::error::timeout || hall_.closing)
      return shutDownSocket();
    if (status && status.category() != http::make_error_code(http::error::bad_method).category())
      return shutDownSocket();
    request_ = parser_->release();
    hall_.book.moved(id_, hall_.now());
    if (status) {
      return refuseMalformed(status == http::error::header_limit ? http::status::request_header_fields_too_large
                                                                 : http::status::bad_request);
    }
    if (headBytes(request_) > kMaxHeaderBytes) return refuseMalformed(http::status::request_header_fields_too_large);
    if (!namesOneHost(request_)) return refuseMalformed(http::status::bad_request);
    answer();
  }

  /// The client may mean something else by what follows.
  void refuseMalformed(http::status status) {
    ++hall_.counts.malformed;
    request_.keep_alive(false);
    refuse(status);
  }

  void answer() {
    const std::string_view path = pathOfRequest(request_);
    if (beast::websocket::is_upgrade(request_)) return path == kStream ? open() : refuse(http::status::not_found);
    if (request_.method() != http::verb::get && request_.method() != http::verb::head) {
      return refuse(http::status::method_not_allowed);
    }
    if (path.starts_with(kServed)) return serveExhibit(path);
    const SiteFile* file = hall_.exhibits.site.find(path);
    if (file == nullptr) return refuse(http::status::not_found);
    if (toStringView(request_[http::field::if_none_match]) == file->tag) return unchanged(*file);
    send(file->content, file->type, file);
  }

  bool isCrossOrigin() {
    Status ignored;
    const std::string local = line().socket().local_endpoint(ignored).address().to_string();
    if (request_.count(http::field::origin) > 1) return true;
    return !originAllowed(toStringView(request_[http::field::origin]), hall_.settings.origins,
                          {wire_.isTls() ? "https" : "http", local, hall_.port});
  }

  /// The client's role; answers those without one.
  Role admitted(std::string_view token) {
    if (isCrossOrigin()) {
      ++hall_.counts.refused_origin;
      refuse(http::status::forbidden);
      return Role::none;
    }
    const Role role = findRole(hall_.settings.tokens, token);
    if (role == Role::none) {
      ++hall_.counts.refused_token;
      refuse(http::status::unauthorized);
      return role;
    }
    hall_.makeRoom(hall_.book.markTokenShown(id_, hall_.now()));
    return role;
  }

  void serveExhibit(std::string_view path) {
    if (admitted(tokenIn(request_[http::field::authorization])) == Role::none) return;
    if (path == "/served/skin") return send(hall_.exhibits.skin, "application/octet-stream");
    if (path == "/served/forms") return send(hall_.exhibits.forms, "application/octet-stream");
    if (path != "/served/state") return refuse(http::status::not_found);
    own_text_ = hall_.state();
    send(own_text_, "application/json");
  }

  /// The token is sent as a second protocol: in the address logs would record it, and a page can set no header.
  void open() {
    bool speaks = false;
    std::string_view token;
    for (const std::string_view protocol : split(toStringView(request_[http::field::sec_websocket_protocol]), ',')) {
      if (protocol == kProtocol) speaks = true;
      if (protocol.starts_with(kTokenProtocol)) token = protocol.substr(kTokenProtocol.size());
    }
    const Role role = admitted(token);
    if (role == Role::none) return;
    if (!speaks) return refuse(http::status::bad_request);
    if (hall_.watchers.size() >= hall_.settings.watchers) {
      ++hall_.counts.refused_full;
      return refuse(http::status::service_unavailable);
    }
    leave();
    line().expires_never();
    beginLooking(std::move(wire_), hall_, role, request_);
  }

  template <class Body>
  http::response<Body> response(http::status status) const {
    http::response<Body> response(status, request_.version() == 10 ? 10 : 11);
    response.keep_alive(request_.keep_alive());
    response.set(http::field::server, "palpate");
    response.set("X-Content-Type-Options", "nosniff");
    response.set("Referrer-Policy", "no-referrer");
    response.set("Cross-Origin-Opener-Policy", "same-origin");
    response.set("Cross-Origin-Embedder-Policy", "require-corp");
    response.set("Cross-Origin-Resource-Policy", "same-origin");
    return response;
  }

  void refuse(http::status status) {
    auto answer = response<http::string_body>(status);
    answer.set(http::field::content_type, "text/plain; charset=utf-8");
    answer.set(http::field::cache_control, "no-store");
    if (status == http::status::unauthorized) answer.set(http::field::www_authenticate, "Bearer");
    if (status == http::status::method_not_allowed) answer.set(http::field::allow, "GET, HEAD");
    answer.body() = std::string(http::obsolete_reason(status)) + "\n";
    answer.prepare_payload();
    if (request_.method() == http::verb::head) answer.body().clear();
    write(std::move(answer));
  }

  void unchanged(const SiteFile& file) {
    auto answer = response<http::empty_body>(http::status::not_modified);
    answer.set(http::field::etag, file.tag);
    write(std::move(answer));
  }

  /// `content` must stay alive; a file of the site, or content for holders of a token.
  void send(const std::string& content, std::string_view type, const SiteFile* file = nullptr) {
    const bool only_head = request_.method() == http::verb::head;
    auto answer = response<http::span_body<const char>>(http::status::ok);
    answer.set(http::field::content_type, beast::string_view(type.data(), type.size()));
    answer.set(http::field::cache_control, file != nullptr ? "no-cache" : "no-store");
    if (file != nullptr) answer.set(http::field::etag, file->tag);
    if (file != nullptr && !file->policy.empty()) answer.set("Content-Security-Policy", file->policy);
    answer.content_length(content.size());
    if (!only_head) answer.body() = {content.data(), content.size()};
    write(std::move(answer));
  }

  template <class Body>
  void write(http::response<Body> answer) {
    const auto delivery = std::make_shared<Delivery<Body>>(std::move(answer));
    delivery->serializer.limit(kPieceBytes);
    writeSome(delivery);
  }

  template <class Body>
  void writeSome(const std::shared_ptr<Delivery<Body>>& delivery) {
    if (delivery->left_of_piece == 0) {
      delivery->left_of_piece = kPieceBytes;
      line().expires_after(milliseconds(hall_.settings.piece_s));
      hall_.book.moved(id_, hall_.now());
    }
    http::async_write_some(wire_, delivery->serializer,
                           [self = shared_from_this(), delivery](Status status, std::size_t bytes) {
                             if (status) return;
                             delivery->left_of_piece -= std::min(delivery->left_of_piece, bytes);
                             if (!delivery->serializer.is_done()) return self->writeSome(delivery);
                             if (delivery->answer.keep_alive()) return self->read();
                             self->shutDownSocket();
                           });
  }

  void shutDownSocket() {
    Status ignored;
    line().socket().shutdown(Socket::shutdown_both, ignored);
  }

  Wire wire_;
  Connections& hall_;
  const VisitId id_;
  beast::flat_buffer buffer_{2 * kMaxHeaderBytes};
  std::optional<http::request_parser<http::empty_body>> parser_;
  HttpRequest request_;
  std::string own_text_;
};

}  // namespace

void beginVisit(Socket socket, Connections& hall) { std::make_shared<Visit>(std::move(socket), hall)->begin(); }

}  // namespace palpate::app::serving
