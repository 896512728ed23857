// One watching page, over a WebSocket: the newest frame whenever it is ready for one, messages in between, and its
// requests. Frames that it was not ready for are dropped: nothing but a few messages ever queues up.
#include "cli/serve/wire.h"

#include <algorithm>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <optional>
#include <utility>

#include "cli/serve/hall.h"
#include "palpate/base/json.h"
#include "palpate/base/system/network.h"

namespace palpate::app::serving {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;

namespace {

using Failure = boost::system::error_code;

/// The system's buffer for a slow reader: a second of frames, not minutes.
constexpr int kSendBytes = 16384;
constexpr int kUnsentBytes = 4096;

/// Instructors' messages that wait; beyond them a page has stopped reading.
constexpr std::size_t kMaxWaiting = 8;

}  // namespace

class Watcher : public std::enable_shared_from_this<Watcher> {
 public:
  Watcher(Wire wire, Connections& hall, Role role, WatcherId id)
      : stream_(std::move(wire)), hall_(hall), role_(role), id_(id) {}
  ~Watcher() { listenTo(std::nullopt); }
  Watcher(const Watcher&) = delete;
  Watcher& operator=(const Watcher&) = delete;

  void accept(const HttpRequest& request) {
    limitSendBuffers();
    stream_.set_option(websocket::stream_base::timeout{
        std::chrono::milliseconds(static_cast<std::int64_t>(1000.0 * hall_.settings.handshake_s)),
        std::chrono::milliseconds(static_cast<std::int64_t>(1000.0 * hall_.settings.silence_s)), true});
    stream_.set_option(websocket::stream_base::decorator([](websocket::response_type& response) {
      response.set(beast::http::field::server, "palpate");
      response.set(beast::http::field::sec_websocket_protocol, beast::string_view(kProtocol.data(), kProtocol.size()));
    }));
    stream_.auto_fragment(false);
    stream_.read_message_max(kMaxRequestBytes);
    stream_.async_accept(request, [self = shared_from_this()](Failure failure) {
      if (!failure) self->begin();
    });
  }

  void sendState(const std::string& state) {
    state_ = state;
    send();
  }
  void queueMessage(const std::string& message) {
    if (words_.size() == kMaxWaiting) return drop();
    words_.push_back(message);
    send();
  }
  void publishTouch(TouchTexts& texts) {
    if (!listens_) return;
    touch_ = texts.of(*listens_, role_ == Role::instruct);
    send();
  }
  void show(const Frame& frame) {
    if (frame_) ++hall_.counts.frames_skipped;
    frame_ = frame;
    send();
  }
  void look() {
    if (writing_ && hall_.now() - write_began_s_ > hall_.settings.stall_s) drop();
  }
  void close(websocket::close_code code, const char* reason) {
    if (closing_) return;
    closing_ = true;
    stream_.async_close({code, reason}, [self = shared_from_this()](Failure) {});
  }

 private:
  void limitSendBuffers() {
    Socket& socket = beast::get_lowest_layer(stream_).socket();
    Failure ignored;  // without them it is only less fresh
    system::limitUnsent(numberOf(socket), kUnsentBytes);
    socket.set_option(asio::socket_base::send_buffer_size(kSendBytes), ignored);
    socket.set_option(asio::ip::tcp::no_delay(true), ignored);
  }

  void begin() {
    if (hall_.closing || hall_.watchers.size() >= hall_.settings.watchers) {
      ++hall_.counts.refused_full;
      return close(websocket::close_code::try_again_later, "full");
    }
    hall_.join(shared_from_this(), id_);
    Json hello = {{"type", "hello"}, {"version", 1}, {"you", id_}, {"role", std::string(roleName(role_))}};
    hello.update(hall_.exhibits.facts);
    words_.push_back(jsonDump(hello));  // a file may be called anything
    frame_ = hall_.newest;
    hall_.publishState();
    read();
  }

  void read() {
    stream_.async_read(buffer_,
                       [self = shared_from_this()](Failure failure, std::size_t) { self->onMessage(failure); });
  }

  void onMessage(Failure failure) {
    if (failure) {
      if (failure == beast::error::timeout) ++hall_.counts.dropped;
      if (failure == websocket::error::message_too_big) ++hall_.counts.malformed;
      return hall_.leave(id_);
    }
    if (!closing_) handleRequest();
    buffer_.consume(buffer_.size());
    read();  // also while closing: the other side's goodbye arrives here
  }

  void handleRequest() {
    if (isHasty()) return complain(websocket::close_code::policy_error, "too many messages");
    if (!stream_.got_text()) return complain(websocket::close_code::unknown_data, "text only");
    const auto bytes = buffer_.cdata();
    std::string why;
    const auto request = parseRequest({static_cast<const char*>(bytes.data()), bytes.size()}, why);
    if (!request) return complain(websocket::close_code::bad_payload, why.substr(0, 100).c_str());
    const WatcherId holder = hall_.control.holder();
    const bool paused = hall_.control.paused();
    why = hall_.control.handleRequest(id_, role_, *request, hall_.now());
    const auto* listen = std::get_if<Listen>(&*request);
    if (listen != nullptr && listen->pad > 0 && !hall_.exhibits.pressure) why = "this body's tissue has no layers";
    if (!why.empty()) {
      refused_ = jsonDump(Json{{"type", "refused"}, {"why", why}});
      return send();
    }
    if (const auto* say = std::get_if<Say>(&*request)) hall_.publishMessage(say->words);
    if (listen != nullptr) listenTo(listen->on ? std::optional(*listen) : std::nullopt);
    if (holder != hall_.control.holder() || paused != hall_.control.paused()) hall_.publishState();
  }

  void listenTo(const std::optional<Listen>& listen) {
    if (listen && !listens_) ++hall_.counts.listening;
    if (!listen && listens_) --hall_.counts.listening;
    listens_ = listen;
    touch_ = nullptr;
  }

  void complain(websocket::close_code code, const char* reason) {
    ++hall_.counts.malformed;
    hall_.control.left(id_, hall_.now());  // its finger is released before the goodbye
    close(code, reason);
  }

  bool isHasty() {
    const double now_s = hall_.now();
    allowance_ = std::min(kMaxRequestsPerS, allowance_ + kMaxRequestsPerS * (now_s - allowed_at_s_));
    allowed_at_s_ = now_s;
    allowance_ -= 1.0;
    return allowance_ < 0.0;
  }

  /// One message at a time, words before frames.
  void send() {
    if (writing_ || closing_) return;
    std::string* const words = !words_.empty() ? &words_.front() : !state_.empty() ? &state_ : &refused_;
    if (!words->empty()) {
      under_way_ = std::make_shared<const std::string>(std::exchange(*words, {}));
      if (words == (words_.empty() ? nullptr : &words_.front())) words_.pop_front();
      stream_.text(true);
    } else if (touch_ && (!frame_ || frame_went_last_)) {  // in turn: over a slow line neither waits for the other
      under_way_ = std::exchange(touch_, nullptr);
      frame_went_last_ = false;
      stream_.text(true);
    } else if (frame_) {
      under_way_ = std::exchange(frame_, nullptr);
      frame_went_last_ = true;
      stream_.binary(true);
      ++hall_.counts.frames_sent;
      hall_.counts.bytes_sent += under_way_->size();
    } else {
      return;
    }
    writing_ = true;
    write_began_s_ = hall_.now();
    stream_.async_write(asio::buffer(*under_way_), [self = shared_from_this()](Failure failure, std::size_t) {
      self->writing_ = false;
      if (!failure) self->send();
    });
  }

  /// Without a goodbye: it would not be read. Pending reads and writes end with an error.
  void drop() {
    if (std::exchange(dropped_, true)) return;
    ++hall_.counts.dropped;
    closing_ = true;
    Failure ignored;
    beast::get_lowest_layer(stream_).socket().close(ignored);
  }

  websocket::stream<Wire> stream_;
  Connections& hall_;
  const Role role_;
  const WatcherId id_;
  beast::flat_buffer buffer_;
  Frame frame_;  // the newest that was not sent yet
  Frame touch_;  // likewise, for a subscriber
  bool frame_went_last_ = false;
  std::optional<Listen> listens_;
  std::string state_, refused_;    // likewise
  std::deque<std::string> words_;  // all of them
  Frame under_way_;
  bool writing_ = false;
  bool closing_ = false;
  bool dropped_ = false;
  double write_began_s_ = 0.0;
  double allowance_ = kMaxRequestsPerS;
  double allowed_at_s_ = 0.0;
};

void beginLooking(Wire wire, Connections& hall, Role role, const HttpRequest& request) {
  std::make_shared<Watcher>(std::move(wire), hall, role, ++hall.last_id)->accept(request);
}

void sendState(Watcher& watcher, const std::string& state) { watcher.sendState(state); }
void queueMessage(Watcher& watcher, const std::string& message) { watcher.queueMessage(message); }
void publishTouch(Watcher& watcher, TouchTexts& texts) { watcher.publishTouch(texts); }
void show(Watcher& watcher, const Frame& frame) { watcher.show(frame); }
void look(Watcher& watcher) { watcher.look(); }
void sendAway(Watcher& watcher) { watcher.close(websocket::close_code::going_away, "the server ends"); }

}  // namespace palpate::app::serving
