// Words -> settings; TCP and WebSocket, GET /version, snapshot, in this order. Cold path.
#include "palpate/device/hardware/haply_session.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/path_text.h"
#include "palpate/base/system/process.h"
#include "palpate/base/text.h"

namespace palpate::device::haply {

namespace {

/// For a machine that is busy; the servo does not wait for it.
constexpr double kPatienceS = 1.0;

constexpr double kLargestForceN = 20.0;

[[noreturn]] void refuse(std::string_view part) {
  throw Error(
      fmt::format("haply: '{}' in {} is invalid; expected HOST:PORT, force_key=auto|vector|values, "
                  "most_force_n=0.1..{} or http_port=PORT (docs/reference/devices.md)",
                  oneLine(part), kServiceVariable, kLargestForceN));
}

double numberIn(std::string_view text, double least, double most, std::string_view part) {
  const std::optional<double> number = parseNumber(text);
  if (!number || !(*number >= least) || !(*number <= most)) refuse(part);
  return *number;
}

int portIn(std::string_view text, std::string_view part) {
  const double port = numberIn(text, 1.0, 65535.0, part);
  if (port != std::floor(port)) refuse(part);
  return static_cast<int>(port);
}

ForceKey keyIn(std::string_view text, std::string_view part) {
  if (text == "auto") return ForceKey::automatic;
  if (text == "vector") return ForceKey::vector;
  if (text == "values") return ForceKey::values;
  refuse(part);
}

Address addressIn(std::string_view part) {
  const std::size_t colon = part.rfind(':');
  if (colon == std::string_view::npos || colon == 0) refuse(part);
  return {std::string(part.substr(0, colon)), portIn(part.substr(colon + 1), part)};
}

void parseSetting(std::string_view part, Settings& settings) {
  const std::size_t equals = part.find('=');
  if (equals == std::string_view::npos) {
    settings.addresses = {addressIn(part)};
    return;
  }
  const std::string_view name = part.substr(0, equals);
  const std::string_view value = part.substr(equals + 1);
  if (name == "force_key") {
    settings.force_key = keyIn(value, part);
  } else if (name == "most_force_n") {
    settings.most_force_n = numberIn(value, 0.1, kLargestForceN, part);
  } else if (name == "http_port") {
    settings.http_port = portIn(value, part);
  } else {
    refuse(part);
  }
}

/// Whether it was done; what went wrong is a row of the report.
template <class Step>
bool tried(LookedFor looked, Probe& probe, const Step& step) {
  try {
    looked.words = step();
    looked.found = true;
  } catch (const Error& error) {
    looked.words = error.what();
  }
  const bool found = looked.found;
  probe.looked_for.push_back(std::move(looked));
  return found;
}

std::unique_ptr<Connection> connectTo(const Address& address, Probe& probe) {
  std::unique_ptr<Connection> connection;
  tried({"Haply's service (WebSocket)", words(address), false, ""}, probe, [&] {
    connection = std::make_unique<Connection>(address, kPatienceS);
    return std::string();
  });
  return connection;
}

/// The version from whichever page answers; unknown if none does.
Version askVersion(const Settings& settings, const Address& address, Probe& probe) {
  std::vector<int> ports = {settings.http_port};
  if (settings.http_port == 0) ports = {address.port, kOldPort};
  Version version;
  for (const int port : ports) {
    for (const char* path : {"/version", "/3.0/version"}) {
      const Address page{address.host, port};
      tried({"its version (HTTP)", words(page) + path, false, ""}, probe, [&] {
        version = parseVersion(httpGet(page, path, kPatienceS));
        if (version.major == 0) throw Error("the answer has no project_version");
        return version.words;
      });
      if (version.major != 0) return version;
    }
  }
  return version;
}

/// Below the root of the system, or with its own.
std::filesystem::path settingsFolder() {
  if (system::kIsWindows) return pathOf(system::variable("PROGRAMDATA")) / "Haply" / "Inverse";
  return "etc/haply-inverse-service";
}

bool isInstalled(const std::filesystem::path& system_root, Probe& probe) {
  std::error_code error;
  const std::filesystem::path folder = system_root / settingsFolder();
  const bool found = std::filesystem::is_directory(folder, error);
  probe.looked_for.push_back({"the service's settings", folder.string(), found, ""});
  return found;
}

void explainSilence(const std::filesystem::path& system_root, Probe& probe) {
  for (const LookedFor& looked : probe.looked_for) {
    if (!looked.found) probe.reason += (probe.reason.empty() ? "no service answers: " : "; ") + looked.words;
  }
  probe.remedy = system::kIsWindows ? "start it: Haply Inverse Service, in Windows' list of services"
                                    : "start it: sudo systemctl start haply-inverse-service";
  if (!isInstalled(system_root, probe)) {
    probe.remedy = "install the maker's Inverse Service, 3.1 to 3.5, and " + probe.remedy;
  }
  probe.remedy += fmt::format("; where it runs elsewhere: {}=HOST:PORT", kServiceVariable);
}

bool refuseVersion(const Version& version, Probe& probe) {
  if (version.major == 0 || version.major == 3) return false;
  probe.reason = fmt::format("the service is version {}; this program speaks to 3.0 to 3.5", version.words);
  probe.remedy = version.major < 3 ? "install the maker's Inverse Service, 3.1 to 3.5"
                                   : "install a service of 3.x, or a newer Palpate";
  return true;
}

}  // namespace

Settings settingsOf(const std::string& said) {
  Settings settings;
  settings.words = said;
  if (said.empty()) settings.words = system::variable(kServiceVariable);
  if (settings.words.empty()) return settings;
  for (const std::string_view part : split(settings.words, ',')) parseSetting(part, settings);
  return settings;
}

Service findService(const Settings& settings, const std::filesystem::path& system_root, Probe& probe) {
  Service service;
  for (const Address& address : settings.addresses) {
    service.connection = connectTo(address, probe);
    if (!service.connection) continue;
    const bool sent = tried({"its snapshot of devices", words(address), false, ""}, probe, [&] {
      service.snapshot = parseReply(service.connection->receive());
      if (!service.snapshot.wrong.empty()) throw Error(service.snapshot.wrong);
      return fmt::format("{} devices", service.snapshot.devices.size());
    });
    service.version = askVersion(settings, address, probe);
    service.force_key = chooseForceKey(settings.force_key, service.version, address.port == kOldPort);
    probe.version = service.version.words;
    if (refuseVersion(service.version, probe)) {
      service.connection.reset();
    } else if (!sent) {
      service.connection.reset();
      probe.reason = "the service at " + words(address) + " lists no devices; another program may be using the port";
      probe.remedy = fmt::format(
          "restart it: sudo systemctl restart haply-inverse-service; where it listens elsewhere: "
          "{}=HOST:PORT",
          kServiceVariable);
    }
    return service;
  }
  explainSilence(system_root, probe);
  return service;
}

}  // namespace palpate::device::haply
