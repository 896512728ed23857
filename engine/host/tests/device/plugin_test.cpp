// Back end `plugin`: what the doctor says of a plugin, what its edge refuses, and the example as its author builds it.
// What every hardware keeps is conformance_test.cpp.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>

#include "host/tests/device/conformance_bench.h"
#include "palpate/base/error.h"
#include "palpate/device/hardware/plugin_checks.h"
#include "palpate/device/hardware/plugin_driver.h"
#include "support/error_message.h"
#include "support/places.h"

namespace palpate::device {
namespace {

bool tells(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Folders of plugins for one test.
class Folders {
 public:
  explicit Folders(const std::string& folders) { ::setenv(plugin::kFoldersVariable, folders.c_str(), 1); }
  ~Folders() { ::unsetenv(plugin::kFoldersVariable); }
  Folders(const Folders&) = delete;
  Folders& operator=(const Folders&) = delete;
};

Probe probedPlugin(const std::string& which) {
  OpenOptions options;
  options.which = which;
  return backEndNamed("plugin").probe(options);
}

std::string doubleFile() { return doubles::libraryOf("plugin"); }

/// What an author outside of this tree does: the header alone, and one line for the compiler.
std::string compile(const support::TemporaryFolder& folder, const std::string& source, const std::string& name) {
  std::filesystem::create_directories(folder / "include/palpate/device");
  std::filesystem::copy_file(support::sourceFolder() / "engine/core/palpate/device/palpate_device.h",
                             folder / "include/palpate/device/palpate_device.h",
                             std::filesystem::copy_options::overwrite_existing);
  const std::string file = (folder / name).string();
  const std::string line = "cc -std=c99 -pedantic -Wall -Wextra -Werror -shared -fPIC -I'" +
                           (folder / "include").string() + "' '" + source + "' -o '" + file + "'";
  EXPECT_EQ(std::system(line.c_str()), 0) << line;
  return file;
}

std::string exampleSource() { return support::sourceFolder().string() + "/examples/device_plugin/point_mass.c"; }

// --- the doctor ---

TEST(Plugin, WithoutANameAllInTheFoldersAreListed) {
  const support::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "other");
  compile(folder, exampleSource(), "mass.so");
  std::ofstream(folder / "broken.so") << "no library";
  std::ofstream(folder / "notes.txt") << "no plugin either";
  std::filesystem::copy_file(doubles::libraryOf("forcedimension"), folder / "other/stranger.so");
  const Folders folders(folder.path().string() + ":/nowhere/at all:" + (folder / "other").string());
  const Probe probe = probedPlugin("");
  EXPECT_TRUE(probe.available) << probe.reason;
  ASSERT_EQ(probe.devices.size(), 1u);
  EXPECT_TRUE(tells(probe.devices[0], "point_mass: a mass on a spring")) << probe.devices[0];
  EXPECT_TRUE(tells(probe.devices[0], "plugin:" + (folder / "mass.so").string())) << probe.devices[0];
  EXPECT_EQ(probe.version, "palpate_device.h 1");
  ASSERT_EQ(probe.troubles.size(), 2u);
  EXPECT_TRUE(tells(probe.troubles[0], "file too short") || tells(probe.troubles[0], "invalid ELF header"))
      << probe.troubles[0];
  EXPECT_TRUE(tells(probe.troubles[1], "has no function palpate_device_plugin")) << probe.troubles[1];
  ASSERT_EQ(probe.looked_for.size(), 4u);
  EXPECT_EQ(probe.looked_for[0].where, "/nowhere/at all");
}

TEST(Plugin, WithoutFoldersTheRemedySaysHow) {
  const Probe probe = probedPlugin("");
  EXPECT_FALSE(probe.available);
  EXPECT_TRUE(tells(probe.remedy, "PALPATE_DEVICE_PLUGINS=")) << probe.remedy;
  OpenOptions options;
  EXPECT_THROW(backEndNamed("plugin").open(options), Error);
}

TEST(Plugin, IsFoundByItsNameInTheFolders) {
  const support::TemporaryFolder folder;
  compile(folder, exampleSource(), "libmass.so");
  const Folders folders(folder.path().string());
  for (const char* which : {"mass", "libmass.so", "mass:"}) {
    EXPECT_TRUE(probedPlugin(which).available) << which << probedPlugin(which).reason;
  }
}

TEST(Plugin, AFileMayNameOneOfTheFoldersAndNoOther) {
  const support::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "plugins/below");
  for (const char* file : {"plugins/libmass.so", "plugins/below/deeper.so", "here.so"}) {
    std::ofstream(folder / file) << "never loaded";
  }
  const Folders folders((folder / "plugins").string());
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  std::ofstream("mass:odd") << "a file here is not what lies in the folder";
  for (const char* words : {"plugin:mass", "plugin:libmass.so", "plugin:mass:left", "remote", "playback:path.csv"}) {
    EXPECT_NO_THROW(deviceNamedInFile(words)) << words;
  }
  for (const std::string& words :
       {std::string("plugin"), std::string("plugin:"), std::string("plugin:./here.so"), std::string("plugin:here.so"),
        std::string("plugin:here"), std::string("plugin:mass:odd"), std::string("plugin:below/deeper.so"),
        std::string("plugin:../plugins/libmass.so"), std::string("plugin:libmass.so/"),
        "plugin:" + (folder / "plugins/libmass.so").string(), "plugin:" + (folder / "here.so").string() + ":left"}) {
    const std::string refused = support::thrownMessage([&] { deviceNamedInFile(words); });
    EXPECT_TRUE(tells(refused, "files may name only plugins in a folder of PALPATE_DEVICE_PLUGINS"))
        << words << ": " << refused;
  }
  std::filesystem::current_path(before);
}

TEST(Plugin, AFileOfAPlainNameIsTheOneInThisFolder) {
  EXPECT_EQ(plugin::parsePluginName("nothing:second").file, "nothing");
  EXPECT_EQ(plugin::parsePluginName("nothing:second").which, "second");
  EXPECT_EQ(plugin::parsePluginName("/a/b.so:x:y").file, "/a/b.so:x");
  EXPECT_EQ(plugin::parsePluginName("").file, "");
}

TEST(Plugin, SaysWhyATableWillNotDo) {
  HardwareBench bench(pluginHardware());
  const std::pair<unsigned, const char*> refusals[] = {
      {2, "returns no table"}, {3, "written for version 99"}, {4, "has 16 bytes"}, {5, "lacks read"}};
  for (const auto& [refusal, words] : refusals) {
    bench.control().refusal = refusal;
    const Probe probe = probedPlugin(doubleFile());
    EXPECT_FALSE(probe.available);
    EXPECT_TRUE(tells(probe.reason, words) && tells(probe.reason, doubleFile())) << probe.reason;
    EXPECT_TRUE(tells(probe.remedy, "palpate_device.h")) << probe.remedy;
    EXPECT_THROW(bench.open(), Error);
  }
}

TEST(Plugin, GivesThePluginsOwnWords) {
  HardwareBench bench(pluginHardware());
  bench.control().count = 0;
  const Probe probe = probedPlugin(doubleFile());
  EXPECT_EQ(probe.reason, "double: nothing is plugged in");
  EXPECT_EQ(probe.remedy, "plug it in");
  EXPECT_FALSE(bench.hardware().open);
  bench.control().count = 1;
  bench.put({1, 2, 3});
  Device device = bench.open();
  bench.tick(device, {0, 0, 1});
  bench.hardware().error = 1;
  bench.tick(device, {0, 0, 1});
  EXPECT_TRUE(tells(device.explain(), "the plugin reports: the double was told to fail")) << device.explain();
  EXPECT_LT(device.explain().size(), 600u) << "though it ends nowhere";
}

TEST(Plugin, OpensTheOneOfSeveralThatWasNamed) {
  HardwareBench bench(pluginHardware());
  bench.put({7, 0, 0}, 1);
  OpenOptions options = bench.options();
  options.library.clear();
  options.which = doubleFile() + ":second";
  Device device = bench.open(options);
  EXPECT_EQ(device.name, "plugin:" + doubleFile() + ":second");
  bench.turn(device);
  EXPECT_EQ(device.read_tip(0).x(), 7.0);
  options.which = doubleFile() + ":third";
  EXPECT_THROW(bench.open(options), Error);
}

TEST(Plugin, ADeviceThatFailsForAMomentIsNotGivenUp) {
  HardwareBench bench(pluginHardware());
  bench.put({1, 2, 3});
  Device device = bench.open();
  for (int time = 0; time < 3; ++time) {
    bench.hardware().error = 1;
    for (int i = 0; i < 5; ++i) bench.tick(device, {0, 0, 1});
    EXPECT_NE(device.state().faults, 0u);
    bench.hardware().error = 0;
    for (int i = 0; i < 5; ++i) bench.tick(device, {0, 0, 1});
    EXPECT_TRUE(bench.hardware().open) << time;
    EXPECT_EQ(bench.force(), Vec3(0, 0, 1)) << time;
  }
}

TEST(Plugin, ADeviceThatStaysAwayIsGivenUpAndOpenedAgainWhenAskedFor) {
  HardwareBench bench(pluginHardware());
  bench.control().count = 1;
  bench.put({1, 2, 3});
  Device device = bench.open();
  bench.hardware().connected = false;
  for (int i = 0; i < 30; ++i) bench.tick(device, {0, 0, 1});
  EXPECT_FALSE(bench.hardware().open) << "given up";
  EXPECT_FALSE(device.revive());
  EXPECT_TRUE(tells(device.explain(), "in use or gone")) << device.explain();
  bench.hardware().connected = true;
  EXPECT_TRUE(device.revive());
  for (int i = 0; i < 5; ++i) bench.tick(device, {0, 0, 1});
  EXPECT_EQ(bench.force(), Vec3(0, 0, 1));
}

TEST(Plugin, OneThatAnswersAtOnceHasNoThread) {
  HardwareBench bench(pluginAtOnceHardware());
  bench.put({1, 2, 3});
  OpenOptions options = bench.options();
  options.own_thread = true;
  Device device = bench.open(options);
  EXPECT_EQ(device.capabilities.rhythm, Rhythm::on_call);
  EXPECT_FALSE(device.exchange);
  EXPECT_EQ(device.read_tip(0), Vec3(1, 2, 3)) << "in the very first tick";
  const long frames = bench.hardware().frames;
  device.read_tip(1);
  EXPECT_EQ(bench.hardware().frames, frames + 1);
}

// --- the edge ---

palpate_device_reading goodReading() {
  palpate_device_reading reading{};
  reading.size = sizeof(reading);
  reading.tip_mm[2] = 3.0;
  return reading;
}

std::uint32_t faultsOf(const palpate_device_reading& reading, int answer = PALPATE_DEVICE_OK) {
  return plugin::checkReading(answer, reading, {}, 0.001).faults;
}

TEST(PluginEdge, AReadingIsWorthWhatCanBeBelieved) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(faultsOf(goodReading()), 0u);
  EXPECT_EQ(faultsOf(goodReading(), -7), kDriverError);
  for (const double bad : {kNan, kInfinity, 1e10}) {
    palpate_device_reading reading = goodReading();
    reading.tip_mm[1] = bad;
    EXPECT_EQ(faultsOf(reading), kNoPose) << bad;
    reading = goodReading();
    reading.velocity_mm_s[0] = bad;
    EXPECT_EQ(faultsOf(reading), 0u) << bad;
    EXPECT_EQ(plugin::checkReading(0, reading, {}, 0.001).velocity, Vec3::Zero()) << bad;
  }
  for (const double age : {0.0021, -1e-9, kNan, kInfinity}) {
    palpate_device_reading reading = goodReading();
    reading.age_s = age;
    EXPECT_EQ(faultsOf(reading), kStalePose) << age;
  }
  palpate_device_reading reading = goodReading();
  reading.faults = PALPATE_DEVICE_NOT_CALIBRATED;
  EXPECT_EQ(faultsOf(reading), kNotCalibrated);
  reading.faults = 1u << 20;
  EXPECT_EQ(faultsOf(reading), kDriverError) << "a fault that a later version knows";
  reading.faults = 0;
  reading.notes = ~0u;
  EXPECT_EQ(plugin::checkReading(0, reading, {}, 0.001).notes, 15u);
}

TEST(PluginEdge, TheReachIsThatOfTheDevicePlacedInTheBody) {
  palpate_device_capabilities able{};
  able.size = sizeof(able);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    able.reach_min_mm[axis] = -10.0 * static_cast<double>(axis + 1);
    able.reach_max_mm[axis] = 20.0;
  }
  const Box3 reach = plugin::checkedCapabilities(able, {}).workspace_mm;
  EXPECT_EQ(reach.min(), Vec3(-10, -20, -30));
  EXPECT_EQ(reach.max(), Vec3(20, 20, 20));
}

TEST(PluginEdge, CapabilitiesThatAreNoSizeAreNotSaid) {
  palpate_device_capabilities able{};
  std::memset(able.model, 'm', sizeof(able.model));
  able.max_force_n = std::numeric_limits<double>::quiet_NaN();
  able.continuous_force_n = -1.0;
  able.stiffness_n_per_mm = INFINITY;
  able.rate_hz = 1e30;
  able.reach_max_mm[0] = 50.0;  // a plane is no box
  const Capabilities said = plugin::checkedCapabilities(able, {});
  EXPECT_EQ(said.max_force_n + said.continuous_force_n + said.nominal_stiffness_n_per_mm + said.rate_hz, 0.0);
  EXPECT_TRUE(said.workspace_mm.isEmpty());
  EXPECT_EQ(said.model, std::string(sizeof(able.model), 'm')) << "without its NUL";
}

TEST(PluginEdge, WordsAreOneLineAndEnd) {
  const char room[8] = {'a', '\n', 'b', '\0', 'c', 'd', 'e', 'f'};
  EXPECT_FALSE(tells(plugin::boundedText(room, sizeof(room)), "\n"));
  EXPECT_EQ(plugin::boundedText(room + 4, 4), "cdef");
  EXPECT_EQ(plugin::boundedText(nullptr, 7), "");
  EXPECT_EQ(plugin::boundedText(room, 0), "");
}

// --- the example ---

TEST(PluginExample, IsBuiltByOneLineFromTheHeaderAloneAndMoves) {
  const support::TemporaryFolder folder;
  OpenOptions options;
  options.which = compile(folder, exampleSource(), "point_mass.so");
  options.own_thread = false;
  const Device device = backEndNamed("plugin").open(options);
  EXPECT_EQ(device.capabilities.model, "mass on a spring");
  double least = INFINITY;
  double most = 0.0;
  for (std::uint64_t tick = 0; tick < 400; ++tick) {
    device.exchange();
    device.exchange();
    const double radius = device.read_tip(tick).norm();
    device.write_force(Vec3::Zero());
    least = std::min(least, radius);
    most = std::max(most, radius);
  }
  EXPECT_GT(least, 25.0) << "it circles";
  EXPECT_LT(most, 35.0);
  for (std::uint64_t tick = 400; tick < 4000; ++tick) {
    device.exchange();
    device.exchange();
    device.read_tip(tick);
    device.write_force(-5e-4 * device.state().velocity);
  }
  EXPECT_LT(device.read_tip(4000).norm(), 1.0) << "until a force stops it";
}

TEST(PluginExample, TheOneThatTheBuildMakesLoadsToo) {
  const std::string file = support::buildFolder().string() + "/examples/point_mass.so";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "built without the examples";
  EXPECT_TRUE(probedPlugin(file).available) << probedPlugin(file).reason;
}

}  // namespace
}  // namespace palpate::device
