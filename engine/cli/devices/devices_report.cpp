#include "cli/devices/devices_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/kit/json.h"
#include "palpate/base/json.h"
#include "palpate/device/device_profile.h"

namespace palpate::app {

namespace {

/// null: not reported.
Json positiveOrNull(double value) { return value > 0.0 ? Json(value) : Json(nullptr); }

/// The limiter's maximum on it: the weakest known device's where its type is unknown.
double trustedForceN(const device::Capabilities& able) {
  return device::profileOf(scene::DeviceModel::unknown, able).force_n;
}

Json capabilitiesJson(const device::Capabilities& able) {
  return {{"model", able.model},
          {"max_force_n", positiveOrNull(able.max_force_n)},
          {"continuous_force_n", positiveOrNull(able.continuous_force_n)},
          {"nominal_stiffness_n_per_mm", positiveOrNull(able.nominal_stiffness_n_per_mm)},
          {"force_limit_n", trustedForceN(able)},
          {"rate_hz", positiveOrNull(able.rate_hz)},
          {"delay_ticks", able.delay_ticks}};
}

Json measuredJson(const DeviceMeasurement& measured) {
  return {{"seconds", measured.seconds},
          {"positions_per_s", measured.positions_per_s},
          {"interval_us", percentilesJson(measured.interval)},
          {"delay_us", percentilesJson(measured.delay)},
          {"with_position_share", measured.with_position_share},
          {"trouble", measured.trouble}};
}

std::string formatPercentiles(const servo::DurationPercentiles& p) {
  return fmt::format("p50 {:.0f}  p99 {:.0f}  max {:.0f} us", p.p50_us, p.p99_us, p.max_us);
}

std::string lookedText(const device::LookedFor& looked) {
  const std::string words = looked.words.empty() ? "" : ": " + looked.words;
  return fmt::format("  {:<9}  {}, {}{}\n", looked.found ? "found" : "not found", looked.what, looked.where, words);
}

std::string abilityText(const device::Capabilities& able) {
  const auto number = [](double value, const char* unit) {
    return value > 0.0 ? fmt::format("{:.2f} {}", value, unit) : std::string("not said");
  };
  std::string text = fmt::format("  device     {}; force at most {}, for long {}; wall {}; its own rate {}\n",
                                 able.model, number(able.max_force_n, "N"), number(able.continuous_force_n, "N"),
                                 number(able.nominal_stiffness_n_per_mm, "N/mm"), number(able.rate_hz, "Hz"));
  const double trusted_n = trustedForceN(able);
  if (able.max_force_n > 0.0 && able.max_force_n <= trusted_n) return text;
  return text + fmt::format("  limit      {:.2f} N{}\n", trusted_n,
                            able.kind == scene::DeviceModel::unknown && !able.documented
                                ? ": its type is not known, so the weakest known device's"
                                : "");
}

std::string measuredText(const DeviceMeasurement& measured) {
  std::string text = fmt::format("  positions  {:.0f} a second; between two {}\n", measured.positions_per_s,
                                 formatPercentiles(measured.interval));
  text +=
      fmt::format("  delay      {}, from a force to the first position after it\n", formatPercentiles(measured.delay));
  if (measured.with_position_share < 1.0) {
    text += fmt::format("  trouble    without a position for {:.1f} % of the time\n",
                        100.0 * (1.0 - measured.with_position_share));
  }
  if (!measured.trouble.empty()) text += fmt::format("  trouble    {}\n", measured.trouble);
  return text;
}

}  // namespace

Json toJson(const DeviceFinding& finding) {
  const device::Probe& probe = finding.probe;
  Json looked_for = Json::array();
  for (const device::LookedFor& looked : probe.looked_for) {
    looked_for.push_back(
        {{"what", looked.what}, {"where", looked.where}, {"found", looked.found}, {"words", looked.words}});
  }
  return {{"name", finding.back_end->name},
          {"about", finding.back_end->about},
          {"available", probe.available},
          {"reason", probe.reason},
          {"remedy", probe.remedy},
          {"version", probe.version},
          {"devices", probe.devices},
          {"looked_for", looked_for},
          {"capabilities", finding.capabilities ? capabilitiesJson(*finding.capabilities) : Json(nullptr)},
          {"measured", finding.measured ? measuredJson(*finding.measured) : Json(nullptr)},
          {"not_measured", finding.not_measured.empty() ? finding.why_nothing : finding.not_measured}};
}

std::string textOf(const DeviceFinding& finding, bool whole) {
  const device::Probe& probe = finding.probe;
  std::string text = fmt::format("{:<15} {}", finding.back_end->name, probe.available ? "here" : "not here");
  text += fmt::format("{:<{}}{}\n", "", probe.available ? 6 : 2, finding.back_end->about);
  if (probe.available && !probe.version.empty()) {
    text += fmt::format("  version    {}; {}\n", probe.version, fmt::join(probe.devices, ", "));
  }
  for (const std::string& trouble : probe.troubles) text += fmt::format("  trouble    {}\n", trouble);
  if (!probe.available) text += fmt::format("  because    {}\n  remedy     {}\n", probe.reason, probe.remedy);
  if (!whole) return text;
  for (const device::LookedFor& looked : probe.looked_for) text += lookedText(looked);
  if (finding.capabilities) text += abilityText(*finding.capabilities);
  if (finding.measured) text += measuredText(*finding.measured);
  if (probe.available && !finding.why_nothing.empty())
    text += fmt::format("  measured   nothing: {}\n", finding.why_nothing);
  if (!finding.not_measured.empty()) text += fmt::format("  trouble    not measured: {}\n", finding.not_measured);
  return text;
}

}  // namespace palpate::app
