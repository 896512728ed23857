// Access control: tokens, their roles and allowed origins; and which connection closes when there are too many.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace palpate::app::serving {

/// The rights of a token; each includes those before it.
enum class Role : std::uint8_t {
  none,
  look,
  control,   ///< takes the finger when it is free
  instruct,  ///< takes it from anyone, halts it, writes to all
};

std::string_view roleName(Role role);

/// All three are set and differ.
struct Tokens {
  std::string look, control, instruct;
};

/// The error of a token, which must have 16 to 128 letters, digits, '-' and '_'. Empty for a valid one.
std::string faultOfToken(std::string_view token);

/// 160 bits of the system's own randomness, 40 digits. Throws Error.
std::string makeToken();

/// Keeps the given tokens and makes those that are empty. Throws Error for an invalid one, and for two that are the
/// same.
Tokens completed(Tokens given);

/// The role of a token. The time it takes does not reveal how much of it was right.
Role findRole(const Tokens& tokens, std::string_view offered) noexcept;

/// {"look": ..., "control": ..., "instruct": ...}, readable by the owner only. Throws Error for an existing file.
void writeTokens(const std::filesystem::path& file, const Tokens& tokens);
/// Default file for a server's tokens: in the folder of running programs (runtimeFolder), which is the user's alone.
/// Removes files of killed servers, so call it before this process has one.
std::filesystem::path freshTokenFile();
/// Throws Error for a missing or malformed file, or one that others than its owner may read.
Tokens readTokens(const std::filesystem::path& file);

/// 127.0.0.0/8, ::1 and "localhost"; no other name is one.
bool isLoopback(std::string_view address);

/// Valid Host of a request: a name or an address, IPv6 in brackets, with or without a port.
bool isHost(std::string_view host);

/// "https://place.example:8443" in small letters, without what follows; the scheme's own port left out. Empty for
/// anything but an origin of a page.
std::string parseOrigin(std::string_view url);

/// The server's end of a connection.
struct LocalPlace {
  std::string_view scheme;   ///< "http" or "https"
  std::string_view address;  ///< the connection's, so that a strange name that leads here (DNS rebinding) does not
                             ///< match
  int port = 0;
};

/// Whether a page from there may open a stream: the named origins, and the server's own address as the browser wrote
/// it. An empty origin means a program: browsers always send one.
bool originAllowed(std::string_view origin, const std::vector<std::string>& named, const LocalPlace& local);

// Chooses which HTTP connection closes when there are too many: strangers, who have shown no token, for strangers;
// never one with a token for one without. A new connection is always admitted: it replaces the one that has been idle
// for longest, of the client that has most.
//
// A plain list without network or clock. One thread.

/// Identifies a connection; 0 is none.
using VisitId = std::uint64_t;

struct VisitLimits {
  std::size_t strangers = 256;        ///< without a token, all clients together
  std::size_t strangers_of_one = 64;  ///< per address; not counted on loopback, where a proxy has the connections of
                                      ///< all
  std::size_t known = 256;            ///< with a token
};

class VisitBook {
 public:
  explicit VisitBook(const VisitLimits& limits = {}) : limits_(limits) {}

  // Each returns the connection to close for it, or 0; that one has left the book.

  /// A connection begins. `client`: its address, or the network that one client has; empty: on this computer.
  VisitId enter(VisitId id, const std::string& client, double now_s);
  /// It has presented a token.
  VisitId markTokenShown(VisitId id, double now_s);

  /// It made progress: a whole request arrived, or a piece of the answer was accepted.
  void moved(VisitId id, double now_s);
  void leave(VisitId id) { visits_.erase(id); }

  std::size_t size() const { return visits_.size(); }

 private:
  struct Visit {
    std::string client;
    bool known = false;
    double moved_s = 0.0;
  };
  /// Number of strangers per client.
  std::map<std::string, std::size_t> strangers() const;
  template <class Is>
  VisitId evictStalest(VisitId but, const Is& is);

  VisitLimits limits_;
  std::map<VisitId, Visit> visits_;
};

}  // namespace palpate::app::serving
