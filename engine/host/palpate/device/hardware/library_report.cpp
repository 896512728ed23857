// Findings -> sentences. The first thing that is wrong is the reason; what comes after it cannot be checked. Cold path.
#include "palpate/device/hardware/library_report.h"
#include "palpate/base/path_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace palpate::device {

namespace {

std::string remedyFor(const std::string& dependency, const LibraryRemedies& remedies) {
  const std::string name = pathOf(dependency).filename().string();
  for (const auto& [beginning, remedy] : remedies.dependencies) {
    if (name.starts_with(beginning)) return remedy;
  }
  return fmt::format("install the package that contains {}, or add its folder to LD_LIBRARY_PATH", name);
}

void explainRefusal(const LibraryFindings& findings, Probe& probe) {
  const LibraryAttempt* attempt = mostInformativeAttempt(findings.library);
  if (attempt == nullptr) return;
  const LibraryRemedies& remedies = findings.remedies;
  if (!attempt->dependency.empty()) {
    probe.reason = fmt::format("{} needs {}, which is missing: {}", attempt->name, attempt->dependency, attempt->words);
    probe.remedy = remedyFor(attempt->dependency, remedies);
    return;
  }
  probe.reason = fmt::format("{} does not load: {}", findings.what, attempt->words);
  probe.remedy = fmt::format("{}, or name its file: {}=/path/to/{}", remedies.install, remedies.variable,
                             pathOf(attempt->name).filename().string());
  if (attempt->words.find("ELFCLASS") != std::string::npos) {
    probe.remedy = "this file is for another processor or for 32 bit: " + probe.remedy;
  }
}

}  // namespace

void reportLibrary(const LibraryFindings& findings, Probe& probe) {
  for (const LibraryAttempt& attempt : findings.library.attempts) {
    const bool opened = attempt.words.empty();
    probe.looked_for.push_back({findings.what, opened ? findings.library.path : attempt.name, opened, attempt.words});
  }
  if (!findings.library) {
    explainRefusal(findings, probe);
  } else if (!findings.missing_functions.empty()) {
    probe.reason = fmt::format("{} lacks {}", findings.library.path, fmt::join(findings.missing_functions, ", "));
    probe.remedy = "it is too old, or another library of that name: " + findings.remedies.install;
  }
}

void reportPlugged(std::string_view makers, std::span<const UsbDevice> plugged, Probe& probe) {
  if (plugged.empty()) {
    probe.looked_for.push_back({fmt::format("a device of {}", makers), "/sys/bus/usb/devices, /dev", false, ""});
  }
  for (const UsbDevice& device : plugged) {
    probe.looked_for.push_back({fmt::format("a device of {}", makers), device.node.string(), true, describe(device)});
  }
}

void explainByBus(std::span<const UsbDevice> plugged, std::string_view rule_name, Probe& probe) {
  if (probe.available) return;
  if (plugged.empty()) {
    probe.reason += "; no device of this maker is seen on USB";
    return;
  }
  const auto locked = std::find_if(plugged.begin(), plugged.end(), [](const auto& device) { return !device.may_open; });
  if (locked == plugged.end()) return;
  probe.reason += "; " + describe(*locked);
  probe.remedy = udevRemedy(*locked, rule_name);
}

}  // namespace palpate::device
