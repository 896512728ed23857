// One WebSocket to Haply's service, and one question by HTTP: whatever is asked is answered within a time, or thrown.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace palpate::device::haply {

struct Address {
  std::string host = "127.0.0.1";
  int port = 0;
};

/// "127.0.0.1:10001"
std::string words(const Address& address);

/// Connects and shakes hands; every wait ends after `patience_s`. One thread at a time.
class Connection {
 public:
  /// Throws Error with the system's words.
  Connection(const Address& address, double patience_s);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// The next message; longer ones than kMostReplyBytes are an error. Throws Error; then the connection is of no use
  /// any more. The text is valid until the next call.
  std::string_view receive();
  /// Throws Error likewise.
  void send(std::string_view text);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// The body of the answer to GET `path`, if it was 200. Throws Error.
std::string httpGet(const Address& address, const std::string& path, double patience_s);

}  // namespace palpate::device::haply
