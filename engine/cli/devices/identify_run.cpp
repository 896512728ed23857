#include "cli/devices/identify_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "cli/kit/interruption.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/device/back_ends.h"
#include "palpate/servo/pacing.h"

namespace palpate::app {

namespace {

constexpr double kTickS = 0.001;
constexpr int kCountdownS = 3;
constexpr std::uint64_t kTicksPerReport = 200;
/// A fit that leaves more means that the device was touched, or hit a stop, mm.
constexpr double kDoubtful = 0.3;

using device::DeviceIdentification;

/// Every number of an identification, to iterate over.
constexpr double DeviceIdentification::*kNumbers[] = {
    &DeviceIdentification::mass_kg, &DeviceIdentification::damping_n_s_per_mm, &DeviceIdentification::friction_n,
    &DeviceIdentification::bias_n,  &DeviceIdentification::delay_ticks,        &DeviceIdentification::residual_mm};

bool isHardware(const device::BackEnd& back_end, const device::Probe& probe) {
  return probe.available && !probe.looked_for.empty() && back_end.name != "remote";
}

std::string firstHardware() {
  for (const device::BackEnd& back_end : device::backEnds()) {
    if (isHardware(back_end, back_end.probe({}))) return std::string(back_end.name);
  }
  throw Error("no haptic device found to identify; see palpate devices, or try a simulated one with --device hand");
}

/// A simulated hand is set to release itself.
std::string released(const std::string& words) {
  const device::DeviceName name = device::deviceNamed(words);
  if (name.back_end->name != "hand") return words;
  return name.which.empty() ? "hand:released" : words + ",released";
}

/// Whatever happens, the device ends without force.
class LetsGo {
 public:
  explicit LetsGo(const device::Device& device) : device_(device) {}
  ~LetsGo() {
    device_.write_force(Vec3::Zero());
    if (device_.close) device_.close();
  }
  LetsGo(const LetsGo&) = delete;
  LetsGo& operator=(const LetsGo&) = delete;

 private:
  const device::Device& device_;
};

/// The user at the device reads it, even when the report goes to a program.
void instructUser(const IdentifySettings& settings, const std::string& words) {
  std::FILE* const to = settings.json ? stderr : stdout;
  fmt::print(to, "{}\n", words);
  std::fflush(to);
}

void waitWithoutForce(const device::Device& device, double seconds) {
  servo::Pacer pacer(servo::PacingSettings{});
  for (std::uint64_t tick = 0; static_cast<double>(tick) * kTickS < seconds && endingSignal() == 0;) {
    tick = pacer.waitForNext().tick;
    (void)device.read_tip(tick);
    device.write_force(Vec3::Zero());
  }
  throwIfInterrupted();
}

void promptRelease(const IdentifySettings& settings, const device::Device& device, int round) {
  instructUser(settings, fmt::format("{} {} in the middle of its workspace, so that it stays there when released.",
                                     round == 0 ? "Hold" : "Again: hold", device.name));
  for (int left = kCountdownS; left > 0; --left) {
    instructUser(settings, fmt::format("  release it in {} s", left));
    waitWithoutForce(device, 1.0);
  }
  instructUser(settings, "  release it, and do not touch it until it is at rest");
  waitWithoutForce(device, 1.0);
}

void swing(const device::Device& device, device::Swings& swings, bool paced, const Progress& progress) {
  servo::Pacer pacer(servo::PacingSettings{});
  std::uint64_t tick = paced ? pacer.waitForNext().tick : 0;
  const std::uint64_t first = tick;
  for (; !swings.finished() && endingSignal() == 0; tick = paced ? pacer.waitForNext().tick : tick + 1) {
    device.write_force(swings.tick(tick - first, device.read_tip(tick)));
    if (tick % kTicksPerReport == 0) report(progress, "swinging " + device.name, swings.progress());
  }
  device.write_force(Vec3::Zero());
  throwIfInterrupted();
}

DeviceIdentification oneRound(const device::Device& device, bool paced, const Progress& progress) {
  device::Swings swings(device::swingPlan(device.capabilities, kTickS));
  swing(device, swings, paced, progress);
  if (swings.trouble() != nullptr) throw Error(device.name + ": " + swings.trouble());
  return device::identify(swings.record());
}

/// Median and range of one number.
void summarise(Identified& found, double DeviceIdentification::*number) {
  std::vector<double> values;
  for (const DeviceIdentification& round : found.rounds) values.push_back(round.*number);
  std::ranges::sort(values);
  found.middle.*number = values[values.size() / 2];
  found.spread.*number = values.back() - values.front();
}

Json numbersJson(const DeviceIdentification& numbers) {
  return {{"mass_kg", numbers.mass_kg},
          {"device_damping_n_s_per_mm", numbers.damping_n_s_per_mm},
          {"device_friction_n", numbers.friction_n},
          {"bias_n", numbers.bias_n},
          {"delay_ticks", numbers.delay_ticks},
          {"residual_mm", numbers.residual_mm}};
}

}  // namespace

Identified identifyDevice(const IdentifySettings& settings, const Progress& progress) {
  const FinishesInOrder in_order;
  Identified found;
  found.words = settings.device.empty() ? firstHardware() : settings.device;
  device::OpenOptions opening;
  opening.tick_s = kTickS;
  const device::Device device = device::openNamed(released(found.words), opening);
  if (!device.write_force) throw Error(device.name + " does not render forces; there is nothing to identify");
  const LetsGo at_the_end(device);
  found.model = device.capabilities.model;
  found.simulated = device.capabilities.rhythm == device::Rhythm::on_call;
  found.most_force_n = device::swingPlan(device.capabilities, kTickS).most_force_n;
  instructUser(settings,
               fmt::format("{} is going to swing left and right by itself, with at most {:.2f} N. Ctrl-C stops it.",
                           device::describe(device), found.most_force_n));
  for (int round = 0; round < settings.rounds; ++round) {
    if (!found.simulated) promptRelease(settings, device, round);
    found.rounds.push_back(oneRound(device, settings.realtime || !found.simulated, progress));
  }
  for (const auto number : kNumbers) summarise(found, number);
  return found;
}

std::string formatSafetyLines(const Identified& found) {
  return fmt::format("device_damping_n_s_per_mm = {:.2e}\ndevice_friction_n = {:.3f}\ndelay_ticks = {:.2f}\n",
                     std::max(0.0, found.middle.damping_n_s_per_mm), std::max(0.0, found.middle.friction_n),
                     std::max(0.0, found.middle.delay_ticks));
}

std::string textOf(const Identified& found) {
  const DeviceIdentification& middle = found.middle;
  const DeviceIdentification& spread = found.spread;
  std::string text = fmt::format("{}: median of {} rounds, and their spread\n", found.model, found.rounds.size());
  text += fmt::format("  mass       {:.4f} kg       ({:.4f})\n", middle.mass_kg, spread.mass_kg);
  text += fmt::format("  damping    {:.3f} N s/m    ({:.3f})\n", 1e3 * middle.damping_n_s_per_mm,
                      1e3 * spread.damping_n_s_per_mm);
  text += fmt::format("  friction   {:.3f} N        ({:.3f})\n", middle.friction_n, spread.friction_n);
  text += fmt::format("  out of balance by {:.3f} N\n", middle.bias_n);
  text += fmt::format("  delay      {:.2f} ticks    ({:.2f})\n", middle.delay_ticks, spread.delay_ticks);
  text += fmt::format("  left over  {:.3f} mm, rms\n", middle.residual_mm);
  if (middle.residual_mm > kDoubtful || middle.damping_n_s_per_mm < 0.0) {
    text += "  doubtful   it did not move like a released device; it may have been touched, or at a mechanical stop\n";
  }
  return text + "\nFor the scene:\n\n[safety]\n" + formatSafetyLines(found);
}

Json toJson(const Identified& found) {
  Json rounds = Json::array();
  for (const DeviceIdentification& round : found.rounds) rounds.push_back(numbersJson(round));
  Json json = {{"device", found.words},
               {"model", found.model},
               {"simulated", found.simulated},
               {"most_force_n", found.most_force_n}};
  json.update(numbersJson(found.middle));
  json["spread"] = numbersJson(found.spread);
  json["rounds"] = rounds;
  json["safety"] = formatSafetyLines(found);
  return json;
}

}  // namespace palpate::app
