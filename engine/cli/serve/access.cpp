#include "cli/serve/access.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <system_error>

#include "palpate/base/error.h"
#include "palpate/base/hmac_sha256.h"
#include "palpate/base/json.h"
#include "palpate/base/output_file.h"
#include "palpate/base/path_text.h"
#include "palpate/base/private_folder.h"
#include "palpate/base/system/process.h"
#include "palpate/base/text.h"

namespace palpate::app::serving {

namespace {

constexpr std::size_t kMinToken = 16;
constexpr std::size_t kMaxToken = 128;
constexpr std::uint64_t kMaxTokenFile = 4096;
constexpr std::string_view kTokenFileStem = "serve-";

bool isTokenLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
}

bool isDigit(char c) { return c >= '0' && c <= '9'; }

bool isNameLetter(char c) { return (c >= 'a' && c <= 'z') || isDigit(c) || c == '-' || c == '.' || c == '_'; }

bool isHostLetter(char c) { return isNameLetter(c) || c == ':' || c == '[' || c == ']'; }

bool isAddressLetter(char c) { return isDigit(c) || (c >= 'a' && c <= 'f') || c == ':' || c == '.'; }

constexpr std::size_t kMaxHost = 255;
constexpr std::size_t kMaxPortDigits = 5;

std::string readToken(const Json& json, const char* name) {
  return json.contains(name) && json[name].is_string() ? json[name].get<std::string>() : std::string();
}

/// Judges by the name, "serve-PID-...": of a process that has ended, or of an earlier one with our number.
bool isOfDeadServer(std::string_view name) {
  if (!name.starts_with(kTokenFileStem)) return false;
  name.remove_prefix(kTokenFileStem.size());
  int process = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), process);
  if (error != std::errc() || process <= 0) return false;
  return process == system::ownProcess() || !system::isRunning(process);
}

}  // namespace

std::string_view roleName(Role role) {
  constexpr std::array<std::string_view, 4> kWords = {"none", "look", "control", "instruct"};
  return kWords[static_cast<std::size_t>(role)];
}

std::string faultOfToken(std::string_view token) {
  if (token.size() < kMinToken || token.size() > kMaxToken) {
    return fmt::format("a token has {} to {} letters, not {}", kMinToken, kMaxToken, token.size());
  }
  if (!std::all_of(token.begin(), token.end(), isTokenLetter)) return "a token has letters, digits, - and _ only";
  return {};
}

std::string makeToken() {
  std::array<unsigned char, 20> random{};
  if (!system::fillWithRandom(random)) throw Error("the system's random number generator is unavailable");
  std::string token;
  for (const unsigned char byte : random) token += fmt::format("{:02x}", byte);
  return token;
}

Tokens completed(Tokens given) {
  for (std::string* token : {&given.look, &given.control, &given.instruct}) {
    if (token->empty()) *token = makeToken();
    if (const std::string fault = faultOfToken(*token); !fault.empty()) throw Error("token: " + fault);
  }
  if (given.look == given.control || given.look == given.instruct || given.control == given.instruct) {
    throw Error("token: the three tokens must all be different");
  }
  return given;
}

Role findRole(const Tokens& tokens, std::string_view offered) noexcept {
  if (offered.size() > kMaxToken) return Role::none;
  const bool looks = equalInConstantTime(tokens.look, offered);
  const bool controls = equalInConstantTime(tokens.control, offered);
  const bool instructs = equalInConstantTime(tokens.instruct, offered);
  return instructs ? Role::instruct : controls ? Role::control : looks ? Role::look : Role::none;
}

void writeTokens(const std::filesystem::path& file, const Tokens& tokens) {
  if (std::filesystem::exists(std::filesystem::symlink_status(file))) {
    throw Error::inFile(file.string(), std::generic_category().message(EEXIST));
  }
  const Json json = {{"look", tokens.look}, {"control", tokens.control}, {"instruct", tokens.instruct}};
  writePrivateFile(file, jsonDump(json, 2) + "\n");
}

std::filesystem::path freshTokenFile() {
  const std::filesystem::path folder = runtimeFolder();
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (isOfDeadServer(entry.path().filename().string())) std::filesystem::remove(entry.path(), error);
  }
  return folder / pathOf(fmt::format("{}{}-{}.json", kTokenFileStem, system::ownProcess(), makeToken().substr(0, 8)));
}

Tokens readTokens(const std::filesystem::path& file) {
  requireClosedFile(file);
  const auto json = Json::tryParse(readFile(file, kMaxTokenFile));
  if (!json.is_object()) throw Error::inFile(file.string(), R"(is not {"look": ..., "control": ..., "instruct": ...})");
  try {
    return completed({readToken(json, "look"), readToken(json, "control"), readToken(json, "instruct")});
  } catch (const Error& error) {
    throw Error::inFile(file.string(), error.what());
  }
}

bool isHost(std::string_view host) {
  const std::string lower = inSmallLetters(host);
  const bool is_v6 = lower.starts_with('[');
  const std::size_t end = std::min(lower.size(), is_v6 ? lower.find(']') : lower.find(':'));
  const std::string_view name = std::string_view(lower).substr(is_v6 ? 1 : 0, end - (is_v6 ? 1 : 0));
  std::string_view port = std::string_view(lower).substr(end);
  if (is_v6 && !port.empty()) port.remove_prefix(1);
  const bool has_port = port.empty() || (port.front() == ':' && port.size() <= 1 + kMaxPortDigits &&
                                         std::all_of(port.begin() + 1, port.end(), isDigit));
  return !name.empty() && lower.size() <= kMaxHost && has_port && (!is_v6 || end < lower.size()) &&
         std::all_of(name.begin(), name.end(), is_v6 ? isAddressLetter : isNameLetter);
}

bool isLoopback(std::string_view address) {
  if (address == "localhost" || address == "::1" || address == "[::1]") return true;
  if (!address.starts_with("127.")) return false;
  return std::all_of(address.begin(), address.end(), [](char c) { return c == '.' || (c >= '0' && c <= '9'); });
}

std::string parseOrigin(std::string_view url) {
  const std::string lower = inSmallLetters(url);
  const std::size_t scheme = lower.find("://");
  if (scheme == std::string::npos) return {};
  const std::string name = lower.substr(0, scheme);
  if (name != "http" && name != "https") return {};
  std::string host = lower.substr(scheme + 3);
  if (const std::size_t slash = host.find('/'); slash != std::string::npos) host.resize(slash);
  const std::string_view standard = name == "http" ? ":80" : ":443";
  if (host.ends_with(standard) && host.find(':') == host.size() - standard.size()) {
    host.resize(host.size() - standard.size());
  }
  if (host.empty() || host.size() > kMaxHost || !std::all_of(host.begin(), host.end(), isHostLetter)) return {};
  return name + "://" + host;
}

bool originAllowed(std::string_view origin, const std::vector<std::string>& named, const LocalPlace& local) {
  if (origin.empty()) return true;
  const std::string from = parseOrigin(origin);
  if (from.empty() || from.size() < origin.size() - 4) return false;  // text after it: not an origin of a page
  if (std::find(named.begin(), named.end(), from) != named.end()) return true;
  const bool is_v6 = local.address.find(':') != std::string_view::npos;
  const std::string own = is_v6 ? fmt::format("[{}]", local.address) : std::string(local.address);
  if (from == parseOrigin(fmt::format("{}://{}:{}", local.scheme, own, local.port))) return true;
  return isLoopback(local.address) && from == parseOrigin(fmt::format("{}://localhost:{}", local.scheme, local.port));
}

}  // namespace palpate::app::serving
