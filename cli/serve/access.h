// Who may come in, and as what: tokens and where a page may come from; and who has to go when there are too many.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace palpate::app::serving {

/// What a token allows; each allows what those before it do.
enum class Role : std::uint8_t {
  none,
  look,      ///< sees everything
  control,   ///< takes the finger when nobody has it
  instruct,  ///< takes it from anybody, halts it, writes to all
};

std::string_view wordOf(Role role);

/// All three are set and differ.
struct Tokens {
  std::string look, control, instruct;
};

/// What is wrong with it: a token has 16 to 128 letters, digits, '-' and '_'. Empty: nothing.
std::string faultOfToken(std::string_view token);

/// 160 bits of the system's own randomness, 40 digits. Throws Error.
std::string makeToken();

/// The given ones, those that are empty made. Throws Error for one that is none, and for two that are the same.
Tokens completed(Tokens given);

/// What this token is worth. The time it takes says nothing about how much of it was right.
Role roleOf(const Tokens& tokens, std::string_view offered) noexcept;

/// {"look": ..., "control": ..., "instruct": ...}, for its owner's eyes. Throws Error for a file that is there already.
void writeTokens(const std::filesystem::path& file, const Tokens& tokens);
/// Where a server may write tokens that nobody named a file for: in the folder of running programs (runtimeFolder),
/// which is the user's alone. What servers left there that were killed is removed. Call it before there is one of this
/// process.
std::filesystem::path freshTokenFile();
/// Throws Error: no such file, another form, or a file that others than its owner may read.
Tokens readTokens(const std::filesystem::path& file);

/// 127.0.0.0/8 and ::1; a name is none but "localhost".
bool isLoopback(std::string_view address);

/// What a request may name as its Host: a name or an address, IPv6 in brackets, with or without a port.
bool isHost(std::string_view host);

/// "https://place.example:8443" in small letters, without what follows; the scheme's own port left out. Empty for what
/// is no origin of a page.
std::string originOf(std::string_view url);

/// Where a connection arrived.
struct LocalPlace {
  std::string_view scheme;   ///< "http" or "https"
  std::string_view address;  ///< of the connection, so a strange name that leads here (DNS rebinding) is not it
  int port = 0;
};

/// Whether a page from there may open a stream: those named, and the server's own address as the browser wrote it. An
/// empty origin is no browser's: programs send none.
bool originAllowed(std::string_view origin, const std::vector<std::string>& named, const LocalPlace& local);

// Who is being answered over HTTP, and who has to go when there are too many: strangers, who have shown no token, for
// strangers; never one with a token for one without. Whoever comes gets in: for it goes the one that has been getting
// nowhere for longest, of the client that has most.
//
// A plain list: it knows no network and no clock. One thread.

/// Names a connection; 0 is none.
using VisitId = std::uint64_t;

struct VisitLimits {
  std::size_t strangers = 256;        ///< without a token, of all clients
  std::size_t strangers_of_one = 64;  ///< of one address; not counted on loopback, where a proxy brings all of them
  std::size_t known = 256;            ///< with a token
};

class VisitBook {
 public:
  explicit VisitBook(const VisitLimits& limits = {}) : limits_(limits) {}

  // Each returns who is to be hung up on for it, or 0; that one is no longer in the book.

  /// A connection begins. `client`: its address, or the network that one client has; empty: on this computer.
  VisitId enter(VisitId id, const std::string& client, double now_s);
  /// It has shown a token.
  VisitId showedToken(VisitId id, double now_s);

  /// It got somewhere: a whole request came, or a piece of the answer was taken.
  void moved(VisitId id, double now_s);
  void leave(VisitId id) { visits_.erase(id); }

  std::size_t size() const { return visits_.size(); }

 private:
  struct Visit {
    std::string client;
    bool known = false;
    double moved_s = 0.0;
  };
  /// How many strangers each client has.
  std::map<std::string, std::size_t> strangers() const;
  template <class Is>
  VisitId evictStalest(VisitId but, const Is& is);

  VisitLimits limits_;
  std::map<VisitId, Visit> visits_;
};

}  // namespace palpate::app::serving
