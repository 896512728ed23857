// Access control: tokens, their roles and allowed origins.
#pragma once

#include <cstdint>
#include <filesystem>
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

}  // namespace palpate::app::serving
