// A plugin's device -> Device; the report of `palpate devices` on the plugins in the user's folders. Cold path but for
// the three functions of a tick, which are the driver's.
#include "palpate/device/detail/each_back_end.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <memory>
#include <mutex>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/device/detail/driver_thread.h"
#include "palpate/device/hardware/plugin_checks.h"
#include "palpate/device/hardware/plugin_driver.h"

namespace palpate::device {

namespace {

/// The driver and, if it may wait, the thread of its exchanges; released when the last function of the Device is gone.
class HeldPlugin {
 public:
  HeldPlugin(std::unique_ptr<plugin::Driver> driver, bool own_thread) : driver_(std::move(driver)) {
    if (!own_thread || driver_->isOnCall()) return;
    thread_ = std::make_unique<DriverThread>([this] { driver_->exchange(); }, plugin::kExchangesPerS);
  }
  ~HeldPlugin() { close(); }
  HeldPlugin(const HeldPlugin&) = delete;
  HeldPlugin& operator=(const HeldPlugin&) = delete;

  plugin::Driver& driver() { return *driver_; }

  void close() {
    const std::lock_guard lock(mutex_);
    driver_->releaseDevice();
    thread_.reset();
  }

 private:
  std::unique_ptr<plugin::Driver> driver_;
  std::unique_ptr<DriverThread> thread_;
  std::mutex mutex_;
};

plugin::Wanted parsePluginName(const OpenOptions& options) {
  if (!options.library.empty()) return {options.library, options.which};
  return plugin::parsePluginName(options.which);
}

/// Checks whether the plugin's device would open; a row of the report.
Probe probeOne(const plugin::Wanted& wanted) {
  Probe probe;
  const plugin::Plugin found = plugin::load(wanted.file);
  probe.reason = found.reason;
  probe.remedy = found.remedy;
  probe.looked_for.push_back({"a plugin", found.file, found.table != nullptr, found.reason});
  if (found.table == nullptr) return probe;
  probe.looked_for.back().words = fmt::format("{}: {}", plugin::nameOf(found), plugin::pluginDescription(found));
  probe.version = fmt::format("palpate_device.h {}", found.table->version);
  if (found.table->probe != nullptr) {
    std::array<char, plugin::kWordsRoom> reason{};
    std::array<char, plugin::kWordsRoom> remedy{};
    const auto room = static_cast<std::uint32_t>(plugin::kWordsRoom);
    if (found.table->probe(wanted.which.c_str(), reason.data(), room, remedy.data(), room) < 0) {
      probe.reason = fmt::format("{}: {}", plugin::nameOf(found), plugin::boundedText(reason.data(), reason.size()));
      probe.remedy = plugin::boundedText(remedy.data(), remedy.size());
      if (probe.remedy.empty()) probe.remedy = "contact the author of the plugin";
      return probe;
    }
  }
  probe.available = true;
  probe.devices.push_back(probe.looked_for.back().words);
  return probe;
}

Probe noneNamed() {
  Probe probe;
  probe.reason = fmt::format("no plugin is named, and {} names no folder that has one", plugin::kFoldersVariable);
  probe.remedy = fmt::format("use plugin:/path/to/it.so, or set {}=/folder/of/plugins (docs/howto/plugins.md)",
                             plugin::kFoldersVariable);
  return probe;
}

/// All that lie in the folders: there when one of them is.
Probe probeAll() {
  Probe all;
  for (const std::filesystem::path& folder : plugin::folders()) {
    std::error_code error;
    if (std::filesystem::is_directory(folder, error)) continue;
    all.looked_for.push_back({"a folder of plugins", folder.string(), false, "no such folder"});
  }
  for (const std::string& file : plugin::filesIn(plugin::folders())) {
    const Probe one = probeOne({file, {}});
    all.looked_for.insert(all.looked_for.end(), one.looked_for.begin(), one.looked_for.end());
    if (one.available) {
      all.available = true;
      all.version = one.version;
      all.devices.push_back(fmt::format("{} (plugin:{})", one.devices.front(), file));
    } else {
      all.troubles.push_back(fmt::format("{}; {}", one.reason, one.remedy));
    }
  }
  if (all.available) return all;
  const Probe none = noneNamed();
  all.reason = all.troubles.empty() ? none.reason : fmt::format("{}", fmt::join(all.troubles, "; "));
  all.remedy = none.remedy;
  all.troubles.clear();
  return all;
}

}  // namespace

Probe probePlugin(const OpenOptions& options) {
  const plugin::Wanted wanted = parsePluginName(options);
  return wanted.file.empty() ? probeAll() : probeOne(wanted);
}

Device openPlugin(const OpenOptions& options) {
  const plugin::Wanted wanted = parsePluginName(options);
  Probe probe = wanted.file.empty() ? noneNamed() : Probe{};
  plugin::Opened opened;
  if (!wanted.file.empty()) {
    const plugin::Plugin found = plugin::load(wanted.file);
    probe.reason = found.reason;
    probe.remedy = found.remedy;
    if (found.table != nullptr) {
      opened = plugin::openDriver(*found.table, wanted.which, options);
      probe.reason = fmt::format("{}: {}", plugin::nameOf(found), opened.reason);
    }
  }
  if (!opened.driver) throw Error(probeFailureText(backEndNamed("plugin"), probe));
  Device device;
  device.name = options.which.empty() ? "plugin" : "plugin:" + options.which;
  device.capabilities = opened.driver->capabilities();
  const bool may_wait = !opened.driver->isOnCall();
  const auto held = std::make_shared<HeldPlugin>(std::move(opened.driver), options.own_thread);
  device.read_tip = [held](std::uint64_t tick) { return held->driver().read(tick); };
  device.write_force = [held](const Vec3& force) { held->driver().write(force); };
  device.state = [held] { return held->driver().state(); };
  device.explain = [held] { return held->driver().explain(); };
  device.revive = [held] { return held->driver().revive(); };
  if (may_wait && !options.own_thread) device.exchange = [held] { held->driver().exchange(); };
  device.close = [held] { held->close(); };
  return device;
}

}  // namespace palpate::device
