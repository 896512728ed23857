// What a back end says when its hardware is not there: the loader's own words, the missing part by its name, the
// permission and the rule that gives it, the version, the licence; and what mends each.
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <algorithm>
#include <fstream>

#include "host/tests/device/conformance_bench.h"
#include "palpate/base/error.h"
#include "palpate/device/hardware/shared_library.h"
#include "palpate/device/hardware/usb_search.h"
#include "support/error_message.h"

namespace palpate::device {
namespace {

OpenOptions optionsWith(const std::string& library) {
  OpenOptions options;
  options.library = library;
  options.system_root = "/nonexistent";
  return options;
}

Probe probed(const char* back_end, const OpenOptions& options) { return backEndNamed(back_end).probe(options); }

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A file tree with one USB device, as the kernel shows it.
struct Bus {
  support::TemporaryFolder root;
  Bus(const std::string& maker, const std::string& numbers, mode_t mode) {
    const auto device = root / "sys/bus/usb/devices/1-3";
    std::filesystem::create_directories(device);
    std::filesystem::create_directories(root / "dev/bus/usb/001");
    std::ofstream(device / "manufacturer") << maker << "\n";
    std::ofstream(device / "product") << "test device\n";
    std::ofstream(device / "idVendor") << numbers.substr(0, 4) << "\n";
    std::ofstream(device / "idProduct") << numbers.substr(5) << "\n";
    std::ofstream(device / "busnum") << "1\n";
    std::ofstream(device / "devnum") << "9\n";
    std::ofstream(root / "dev/bus/usb/001/009") << "";
    ::chmod((root / "dev/bus/usb/001/009").c_str(), mode);
    std::filesystem::create_directories(root / "sys/bus/usb/devices/usb1");  // without numbers, as hubs' ports are
  }
};

TEST(Doctor, GivesTheLoadersOwnWordsForEveryNameItTried) {
  const Probe probe = probed("openhaptics", optionsWith("/nowhere/libHD.so"));
  EXPECT_FALSE(probe.available);
  EXPECT_TRUE(holds(probe.reason, "/nowhere/libHD.so: cannot open shared object file")) << probe.reason;
  EXPECT_TRUE(holds(probe.remedy, "PALPATE_LIBHD=")) << probe.remedy;
  ASSERT_FALSE(probe.looked_for.empty());
  EXPECT_EQ(probe.looked_for[0].where, "/nowhere/libHD.so");
  EXPECT_FALSE(probe.looked_for[0].found);
  EXPECT_TRUE(holds(probe.looked_for[0].words, "No such file")) << probe.looked_for[0].words;
}

TEST(Doctor, TriesEveryNameOfALibraryInItsOrder) {
  const SharedLibrary library = openLibrary(std::vector<std::string>{"libnone_a.so", "libnone_b.so.3"});
  ASSERT_EQ(library.attempts.size(), 2u);
  EXPECT_TRUE(holds(library.attempts[1].words, "libnone_b.so.3")) << library.attempts[1].words;
}

TEST(Doctor, NamesTheLibraryThatALibraryNeeds) {
  const Probe probe = probed("openhaptics", optionsWith(doubles::libraryOf("openhaptics_needing")));
  EXPECT_TRUE(holds(probe.reason, "needs libPhantomIOLib42.so, which is missing")) << probe.reason;
  EXPECT_TRUE(holds(probe.remedy, "device driver")) << probe.remedy;
}

TEST(Doctor, AFoundLibraryThatDoesNotLoadSaysMoreThanOneThatIsNotThere) {
  const SharedLibrary library =
      openLibrary(std::vector<std::string>{"libnone_a.so", doubles::libraryOf("openhaptics_needing"), "libnone_b.so"});
  ASSERT_NE(mostInformativeAttempt(library), nullptr);
  EXPECT_EQ(mostInformativeAttempt(library)->dependency, "libPhantomIOLib42.so");
}

TEST(Doctor, OfSeveralThatSayAsMuchTheFirstIsTold) {
  const SharedLibrary none = openLibrary(std::vector<std::string>{"libnone_a.so", "libnone_b.so"});
  EXPECT_EQ(mostInformativeAttempt(none)->name, "libnone_a.so") << "the name that is usual";
  const std::string needing = doubles::libraryOf("openhaptics_needing");
  const support::TemporaryFolder folder;
  std::ofstream(folder / "libHD.so") << std::string(1000, 'x');
  const SharedLibrary found = openLibrary(std::vector<std::string>{needing, (folder / "libHD.so").string()});
  EXPECT_EQ(mostInformativeAttempt(found)->name, needing);
}

TEST(Doctor, TellsADependencyFromTheLibraryItself) {
  EXPECT_EQ(missingDependency("libtinfo.so.5: cannot open shared object file: No such file", "libHD.so"),
            "libtinfo.so.5");
  EXPECT_EQ(missingDependency("libHD.so: cannot open shared object file: No such file", "libHD.so"), "");
  EXPECT_EQ(missingDependency("/opt/libHD.so: cannot open shared object file: Permission denied", "/opt/libHD.so"), "");
  EXPECT_EQ(missingDependency("/opt/libHD.so: invalid ELF header", "/opt/libHD.so"), "");
}

TEST(Doctor, AFileThatIsNoLibraryIsCalledThat) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "libHD.so") << std::string(1000, 'x');
  const Probe probe = probed("openhaptics", optionsWith((folder / "libHD.so").string()));
  EXPECT_TRUE(holds(probe.reason, "invalid ELF header")) << probe.reason;
}

TEST(Doctor, NamesTheFunctionsThatAnOldLibraryLacks) {
  const Probe probe = probed("openhaptics", optionsWith(doubles::libraryOf("openhaptics_old")));
  EXPECT_TRUE(holds(probe.reason, "lacks hdSetDoublev, hdUnschedule")) << probe.reason;
  EXPECT_TRUE(holds(probe.remedy, "too old")) << probe.remedy;
}

TEST(Doctor, AnOldLibraryThatLacksOnlyWhatIsOptionalWillDo) {
  doubles::DoubleControl& control = doubles::controlOf("forcedimension_old");
  doubles::reset(control);
  OpenOptions options = optionsWith(doubles::libraryOf("forcedimension_old"));
  options.own_thread = false;
  const Device device = backEndNamed("forcedimension").open(options);
  for (int i = 0; i < 200; ++i) {
    control.devices[0].place[2] = 1e-5 * i;  // 10 um an exchange, 2000 a second: 20 mm/s upwards
    device.exchange();
  }
  EXPECT_NEAR(device.read_tip(0).y(), 1.99, 1e-9);
  EXPECT_NEAR(device.state().velocity.y(), 20.0, 0.2) << "from the places";
  EXPECT_EQ(device.capabilities.max_force_n, 0.0) << "it does not say what it is";
}

TEST(Doctor, RefusesALibraryThatIsTooOldByItsVersion) {
  HardwareBench bench(forceDimensionHardware());
  bench.control().major = 2;
  const Probe probe = probed("forcedimension", bench.options());
  EXPECT_TRUE(holds(probe.reason, "version 2.17.6.0, 3.0 is the oldest")) << probe.reason;
  EXPECT_EQ(probe.version, "2.17.6.0");
  EXPECT_THROW(bench.open(), Error);
}

TEST(Doctor, SaysThatALicenceIsMissing) {
  HardwareBench bench(openHapticsHardware());
  bench.control().refusal = 0x600;
  const Probe probe = probed("openhaptics", bench.options());
  EXPECT_TRUE(holds(probe.reason, "invalid licence (0x600), HD_INVALID_LICENSE")) << probe.reason;
  EXPECT_TRUE(holds(probe.remedy, "licence")) << probe.remedy;
}

TEST(Doctor, SaysThatNothingIsPluggedIn) {
  for (const Hardware& hardware : {openHapticsHardware(), forceDimensionHardware()}) {
    HardwareBench bench(hardware);
    bench.control().count = 0;
    const Probe probe = probed(hardware.back_end.c_str(), bench.options());
    EXPECT_FALSE(probe.available);
    EXPECT_TRUE(holds(probe.reason, "no device of this maker is seen on USB")) << probe.reason;
    EXPECT_TRUE(holds(probe.remedy, "plug")) << probe.remedy;
  }
}

TEST(Doctor, SaysWhatIsThereAndLeavesItAlone) {
  for (const Hardware& hardware : {openHapticsHardware(), forceDimensionHardware()}) {
    HardwareBench bench(hardware);
    const Probe probe = probed(hardware.back_end.c_str(), bench.options());
    EXPECT_TRUE(probe.available) << probe.reason;
    EXPECT_EQ(probe.reason + probe.remedy, "");
    EXPECT_FALSE(probe.version.empty());
    ASSERT_EQ(probe.devices.size(), 1u);
    EXPECT_FALSE(bench.hardware().open) << "a doctor keeps nothing open";
    EXPECT_TRUE(probed(hardware.back_end.c_str(), bench.options()).available) << "and may ask again";
  }
}

TEST(Doctor, KnowsTheDeviceThatThisProgramHolds) {
  HardwareBench bench(openHapticsHardware());
  const Device device = bench.open();
  const Probe probe = probed("openhaptics", bench.options());
  EXPECT_TRUE(probe.available);
  EXPECT_TRUE(bench.hardware().open) << "it is still held";
}

TEST(Doctor, FindsADeviceOnTheBusByItsMakerAndByItsNumbers) {
  const Bus bus("Force Dimension", "1a2b:0402", 0600);
  const auto by_name = usbDevices({.words = {"force dimension"}, .numbers = {}}, bus.root.path());
  ASSERT_EQ(by_name.size(), 1u);
  EXPECT_EQ(by_name[0].product, "test device");
  EXPECT_EQ(by_name[0].node, bus.root / "dev/bus/usb/001/009");
  EXPECT_EQ(usbDevices({.words = {}, .numbers = {"1a2b:0402"}}, bus.root.path()).size(), 1u);
  EXPECT_TRUE(usbDevices({.words = {"haply"}, .numbers = {"1a2b:0403"}}, bus.root.path()).empty());
  EXPECT_TRUE(usbDevices({.words = {"force dimension"}, .numbers = {}}, "/nonexistent").empty());
}

TEST(Doctor, GivesTheRuleThatLetsAUserOpenADevice) {
  HardwareBench bench(forceDimensionHardware());
  bench.control().refusal = 1;
  const Bus bus("Force Dimension", "1a2b:0402", 0600);
  std::filesystem::remove(bus.root / "dev/bus/usb/001/009");  // root may open whatever is there
  OpenOptions options = bench.options();
  options.system_root = bus.root.path();
  const Probe probe = probed("forcedimension", options);
  EXPECT_TRUE(holds(probe.reason, "no permission to open it")) << probe.reason;
  EXPECT_TRUE(holds(probe.remedy, R"(SUBSYSTEM=="usb", ATTR{idVendor}=="1a2b", MODE="0660", TAG+="uaccess")"))
      << probe.remedy;
  EXPECT_TRUE(holds(probe.remedy, "/etc/udev/rules.d/70-palpate-forcedimension.rules")) << probe.remedy;
}

TEST(Doctor, ADeviceThatMayBeOpenedNeedsNoRule) {
  HardwareBench bench(forceDimensionHardware());
  bench.control().refusal = 1;
  const Bus bus("Force Dimension", "1a2b:0402", 0666);
  OpenOptions options = bench.options();
  options.system_root = bus.root.path();
  const Probe probe = probed("forcedimension", options);
  EXPECT_FALSE(holds(probe.remedy, "udev")) << probe.remedy;
  EXPECT_TRUE(std::any_of(probe.looked_for.begin(), probe.looked_for.end(),
                          [](const LookedFor& looked) { return looked.found && holds(looked.words, "1a2b:0402"); }));
}

TEST(OpenHaptics, GoesOnWhenTheDriverComplainsOfWarmMotorsOrOfTooMuchForce) {
  HardwareBench bench(openHapticsHardware());
  bench.put({1, 2, 3});
  Device device = bench.open();
  const std::pair<unsigned, std::uint32_t> complaints[] = {{0x200, kWarmMotors},
                                                           {0x201, kForceExceeded},
                                                           {0x202, kForceLimited},
                                                           {0x203, kVelocityExceeded},
                                                           {0x204, kForceLimited}};
  for (const auto& [code, note] : complaints) {
    bench.hardware().error = code;
    for (int i = 0; i < 5; ++i) bench.tick(device, {0, 0, 1});
    EXPECT_EQ(device.state().faults, 0u) << std::hex << code;
    EXPECT_EQ(device.state().notes, note) << std::hex << code;
    EXPECT_EQ(bench.force(), Vec3(0, 0, 1)) << std::hex << code;
  }
}

TEST(OpenHaptics, GivesAnErrorToTheDeviceThatItNames) {
  HardwareBench bench(openHapticsHardware());
  Device one = bench.open();
  Device two = bench.open();
  bench.hardware(1).error = 0x300;
  for (std::uint64_t tick = 0; tick < 5; ++tick) {
    one.read_tip(tick);
    two.read_tip(tick);
    bench.control().tick();
  }
  EXPECT_EQ(one.state().faults, 0u);
  EXPECT_NE(two.state().faults & kDriverError, 0u);
  EXPECT_TRUE(holds(two.explain(), "device fault (0x300)")) << two.explain();
}

TEST(OpenHaptics, CalibratesByItselfWhereItCanAndAsksWhereItCannot) {
  HardwareBench bench(openHapticsHardware());
  bench.hardware().calibration = 0x5001;
  Device device = bench.open();
  bench.tick(device, Vec3::Zero());
  EXPECT_TRUE(bench.tick(device, Vec3::Zero()).allFinite());
  EXPECT_EQ(bench.hardware().calibration, 0x5000u) << "updated";
  bench.hardware().calibration = 0x5002;
  for (int i = 0; i < 300; ++i) bench.tick(device, {0, 0, 1});
  EXPECT_NE(device.state().faults & kNotCalibrated, 0u);
  EXPECT_EQ(bench.force(), Vec3::Zero()) << "it does not know where it is";
  EXPECT_TRUE(holds(device.explain(), "inkwell")) << device.explain();
  bench.hardware().calibration = 0x5000;
  for (int i = 0; i < 300; ++i) bench.tick(device, {0, 0, 1});
  EXPECT_EQ(bench.force(), Vec3(0, 0, 1));
}

TEST(OpenHaptics, TakesItsLimitsFromTheDevice) {
  const Capabilities able = HardwareBench(openHapticsHardware()).open().capabilities;
  EXPECT_EQ(able.max_force_n, 3.3);
  EXPECT_EQ(able.continuous_force_n, 0.88);
  EXPECT_EQ(able.nominal_stiffness_n_per_mm, 0.5);
  EXPECT_EQ(able.rate_hz, 1000.0);
  EXPECT_EQ(able.model, "PHANTOM Omni");
  EXPECT_EQ(able.workspace_mm.max(), Vec3(210, 200, 130));
}

TEST(ForceDimension, DataOfBeforeAreNoErrorUntilTheyAreOld) {
  HardwareBench bench(forceDimensionHardware());
  Device device = bench.open();
  for (int i = 0; i < 5; ++i) bench.tick(device, Vec3::Zero());
  bench.control().stands = true;  // "asked too soon", in every exchange
  bench.tick(device, Vec3::Zero());
  EXPECT_TRUE(bench.tick(device, Vec3::Zero()).allFinite());
  EXPECT_EQ(device.state().age_ticks, 1u);
  EXPECT_EQ(device.state().faults, 0u);
}

TEST(ForceDimension, ItsMotorsAreSwitchedOnWithoutAForce) {
  HardwareBench bench(forceDimensionHardware());
  {
    Device before = bench.open();
    for (int i = 0; i < 5; ++i) bench.tick(before, {0, 0, 2});
  }
  const Device device = bench.open();
  EXPECT_EQ(bench.force(), Vec3::Zero());
}

TEST(ForceDimension, WithoutADeviceSaysSo) {
  HardwareBench bench(forceDimensionHardware());
  bench.control().count = 0;
  const std::string why = support::thrownMessage([&] { (void)bench.open(); });
  EXPECT_TRUE(holds(why, "the library finds no device")) << why;
}

TEST(ForceDimension, ASaturatedMotorIsNoted) {
  doubles::DoubleControl& control = doubles::controlOf("forcedimension_old");
  doubles::reset(control);
  OpenOptions options = optionsWith(doubles::libraryOf("forcedimension_old"));
  options.own_thread = false;
  const Device device = backEndNamed("forcedimension").open(options);  // a type that nobody knows: no limit of its own
  for (std::uint64_t tick = 0; tick < 5; ++tick) {
    device.read_tip(tick);
    device.write_force({0, 0, 13});
    device.exchange();
    device.exchange();
  }
  EXPECT_EQ(device.state().notes, kForceExceeded);
  EXPECT_EQ(device.state().faults, 0u);
}

}  // namespace
}  // namespace palpate::device
