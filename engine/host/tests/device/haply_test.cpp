// Back end `haply`: what the doctor says of a service, what is sent to it, and what its answers may be. What every
// hardware keeps is conformance_test.cpp.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <thread>

#include "host/tests/device/conformance_bench.h"
#include "palpate/base/error.h"
#include "palpate/base/random.h"
#include "palpate/device/hardware/haply_message.h"
#include "palpate/device/hardware/haply_session.h"
#include "support/wait_for.h"

namespace palpate::device {
namespace {

using nlohmann::json;

const Vec3 kTouch(0.25, -0.5, 1.0);

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// An environment variable for one test.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) { ::setenv(name, value.c_str(), 1); }
  ~Variable() { ::unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
};

class Haply : public testing::Test {
 protected:
  Haply() : bench(haplyHardware()) {}
  Probe probed() const { return backEndNamed("haply").probe(bench.options()); }
  Probe probedWith(const std::string& words) const {
    OpenOptions options = bench.options();
    options.library = words;
    return backEndNamed("haply").probe(options);
  }
  /// Held at a place, with the force of some ticks on it.
  Device pushed() {
    bench.put({1, 2, 3});
    Device device = bench.open();
    for (int i = 0; i < 10; ++i) bench.tick(device, kTouch);
    return device;
  }
  HardwareBench bench;
};

// --- the doctor ---

TEST_F(Haply, TheDoctorNamesVersionAndDevicesAndMovesNothing) {
  const Probe probe = probed();
  EXPECT_TRUE(probe.available) << probe.reason;
  EXPECT_EQ(probe.reason + probe.remedy, "");
  EXPECT_EQ(probe.version, "3.5.0.0");
  EXPECT_EQ(probe.devices, (std::vector<std::string>{"Inverse3 049D, left", "Inverse3 12AB, right"}));
  ASSERT_GE(probe.looked_for.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(probe.looked_for[i].found) << probe.looked_for[i].what;
  EXPECT_FALSE(bench.hardware().open);
}

TEST_F(Haply, AServiceThatDoesNotRunIsStarted) {
  const Probe probe = probedWith("127.0.0.1:1");
  EXPECT_FALSE(probe.available);
  EXPECT_TRUE(says(probe.reason, "127.0.0.1:1: Connection refused")) << probe.reason;
  EXPECT_TRUE(says(probe.remedy, "sudo systemctl start haply-inverse-service")) << probe.remedy;
  EXPECT_TRUE(says(probe.remedy, "install the maker's Inverse Service")) << "there are no settings of one";
  EXPECT_TRUE(says(probe.remedy, "PALPATE_HAPLY=HOST:PORT")) << probe.remedy;
}

TEST_F(Haply, AServiceThatIsInstalledNeedNotBeInstalled) {
  const support::TemporaryFolder root;
  std::filesystem::create_directories(root / "etc/haply-inverse-service");
  OpenOptions options = bench.options();
  options.library = "127.0.0.1:1";
  options.system_root = root.path();
  const Probe probe = backEndNamed("haply").probe(options);
  EXPECT_FALSE(says(probe.remedy, "install")) << probe.remedy;
}

TEST_F(Haply, LooksAtBothPortsOfTheMaker) {
  const haply::Settings settings = haply::settingsOf("");
  ASSERT_EQ(settings.addresses.size(), 2u);
  EXPECT_EQ(haply::words(settings.addresses[0]), "127.0.0.1:10001");
  EXPECT_EQ(haply::words(settings.addresses[1]), "127.0.0.1:10000");
}

TEST_F(Haply, RefusesVersionsThatItDoesNotKnow) {
  for (const int major : {2, 4}) {
    bench.control().major = major;
    const Probe probe = probed();
    EXPECT_FALSE(probe.available);
    EXPECT_TRUE(says(probe.reason, "version " + std::to_string(major) + ".5.0.0")) << probe.reason;
    EXPECT_TRUE(says(probe.remedy, "3.")) << probe.remedy;
    EXPECT_THROW(bench.open(), Error);
  }
}

TEST_F(Haply, SaysWhatIsOddAboutAService) {
  const std::pair<unsigned, const char*> oddities[] = {{doubles::kHangsUp, "no service answers"},
                                                       {doubles::kNoWebSocket, "handshake was declined"},
                                                       {doubles::kOddSnapshot, "lists no devices"}};
  for (const auto& [refusal, words] : oddities) {
    bench.control().refusal = refusal;
    const Probe probe = probed();
    EXPECT_FALSE(probe.available);
    EXPECT_TRUE(says(probe.reason, words)) << probe.reason;
    EXPECT_GT(probe.remedy.size(), 10u);
  }
}

TEST_F(Haply, SaysThatNothingIsPluggedIn) {
  bench.control().count = 0;
  const Probe probe = probed();
  EXPECT_EQ(probe.reason, "the service knows no device");
  EXPECT_TRUE(says(probe.remedy, "plug")) << probe.remedy;
  EXPECT_THROW(bench.open(), Error);
}

TEST_F(Haply, OpensByIdAndByHandAndNamesWhatThereIs) {
  OpenOptions options = bench.options();
  bench.put({0, 0, 5}, 1);
  for (const char* which : {"12AB", "right"}) {
    options.which = which;
    Device device = bench.open(options);
    EXPECT_TRUE(says(device.capabilities.model, "12AB")) << which;
    bench.turn(device);
    EXPECT_NEAR(device.read_tip(0).z(), 5.0, 1e-9);
  }
  options.which = "FFFF";
  const Probe probe = backEndNamed("haply").probe(options);
  EXPECT_TRUE(says(probe.reason, "'FFFF'") && says(probe.remedy, "049D, 12AB")) << probe.reason << probe.remedy;
  EXPECT_THROW(bench.open(options), Error);
}

TEST_F(Haply, ADeviceKnowsTheVersionOfItsService) {
  bench.control().minor = 4;
  const Device device = bench.open();
  EXPECT_TRUE(says(probed().version, device.capabilities.version)) << probed().version;
  EXPECT_TRUE(device.capabilities.version.starts_with("3.4")) << device.capabilities.version;
}

TEST_F(Haply, TheEnvironmentSaysWhereItIsAndHowItIsSpokenTo) {
  const Variable variable("PALPATE_HAPLY", doubles::haplyWords() + ",most_force_n=8.5,force_key=values");
  OpenOptions options = bench.options();
  options.library.clear();
  Device device = bench.open(options);
  EXPECT_EQ(device.capabilities.max_force_n, 8.5);
  bench.tick(device, kTouch);
  EXPECT_TRUE(says(doubles::lastHaplyOrder(), R"("values":{)")) << doubles::lastHaplyOrder();
}

TEST_F(Haply, RefusesSettingsThatAreNone) {
  for (const char* words :
       {"localhost", ":10001", "localhost:0", "localhost:65536", "localhost:1.5", "most_force_n=0.09",
        "most_force_n=nan", "most_force_n=900", "force_key=torque", "speed=3", "http_port=x", ",", "host:10001,"}) {
    EXPECT_THROW(haply::settingsOf(words), Error) << words;
    EXPECT_FALSE(probedWith(words).available) << words;
  }
  EXPECT_EQ(haply::settingsOf("localhost:1").addresses.at(0).port, 1);
  EXPECT_EQ(haply::settingsOf("localhost:65535").addresses.at(0).port, 65535);
  EXPECT_EQ(haply::settingsOf("most_force_n=0.1").most_force_n, 0.1);
}

// --- what is sent ---

TEST_F(Haply, CallsAForceAsTheVersionOfTheServiceDoes) {
  using haply::ForceKey;
  const auto key = [](const char* version, bool old_port = false) {
    return haply::chooseForceKey(ForceKey::automatic, haply::parseVersion(version), old_port);
  };
  EXPECT_EQ(key(R"({"project_version":"3.5.0.0"})"), ForceKey::vector);
  EXPECT_EQ(key(R"({"project_version":"3.12.1"})"), ForceKey::vector);
  EXPECT_EQ(key(R"({"project_version":"3.4.9.1"})"), ForceKey::values);
  EXPECT_EQ(key(R"({"project_version":"3.0.0.0"})"), ForceKey::values);
  EXPECT_EQ(key("nobody answers"), ForceKey::vector);
  EXPECT_EQ(key("nobody answers", true), ForceKey::values);
  EXPECT_EQ(haply::chooseForceKey(ForceKey::values, haply::parseVersion(R"({"project_version":"3.5"})"), false),
            ForceKey::values);
}

TEST_F(Haply, OldServicesGetTheirForcesToo) {
  for (const int minor : {0, 1, 4}) {  // 3.0 has its devices in an object
    bench.control().minor = minor;
    const Device device = pushed();
    EXPECT_LT((bench.force() - kTouch).norm(), 1e-12) << minor;
  }
}

TEST_F(Haply, AServiceThatTellsNoVersionIsTakenForANewOne) {
  bench.control().refusal = doubles::kNoVersion;
  const Device device = pushed();
  EXPECT_EQ(device.capabilities.version, "");
  EXPECT_LT((bench.force() - kTouch).norm(), 1e-12);
}

TEST_F(Haply, IntroducesItselfOnceAndConfiguresEachDeviceOnce) {
  bench.put({1, 2, 3});
  Device device = bench.open();
  device.exchange();
  const json first = json::parse(doubles::lastHaplyOrder());
  EXPECT_EQ(first["session"]["configure"]["profile"]["name"], "palpate");
  EXPECT_EQ(first["inverse3"][0]["configure"]["preset"], "arm_front_centered");
  device.exchange();
  const json second = json::parse(doubles::lastHaplyOrder());
  EXPECT_FALSE(second.contains("session"));
  EXPECT_EQ(second, json::parse(R"({"inverse3":[{"device_id":"049D","commands":{
    "set_cursor_force":{"vector":{"x":0.0,"y":0.0,"z":0.0}}}}]})"));
}

TEST_F(Haply, TwoDevicesAreTwoElementsOfOneMessage) {
  Device one = bench.open();
  Device two = bench.open();
  Device* const both[] = {&one, &two};
  for (std::uint64_t tick = 0; tick < 4; ++tick) {
    one.read_tip(tick);
    two.read_tip(tick);
    one.write_force({1, 0, 0});
    two.write_force({0, 0, 2});
    bench.turn(both);
  }
  const json order = json::parse(doubles::lastHaplyOrder());
  ASSERT_EQ(order["inverse3"].size(), 2u);
  EXPECT_EQ(order["inverse3"][0]["commands"]["set_cursor_force"]["vector"], json({{"x", 1}, {"y", 0}, {"z", 0}}));
  EXPECT_EQ(order["inverse3"][1]["commands"]["set_cursor_force"]["vector"], json({{"x", 0}, {"y", -2}, {"z", 0}}));
}

// --- what comes back ---

TEST_F(Haply, EveryBadAnswerLeavesNoPlaceAndZeroForceAndIsForgottenAfterwards) {
  const unsigned faults[] = {doubles::kNoState,    doubles::kNoJson, doubles::kCloses,     doubles::kTooLong,
                             doubles::kWrongTypes, doubles::kHuge,   doubles::kNotANumber, doubles::kNoDevices};
  for (const unsigned fault : faults) {
    Device device = pushed();
    bench.hardware().error = fault;
    bench.tick(device, kTouch);
    EXPECT_FALSE(bench.tick(device, kTouch).allFinite()) << fault;
    EXPECT_NE(device.state().faults, 0u) << fault;
    EXPECT_GT(device.explain().size(), 10u) << fault;
    bench.tick(device, kTouch);
    EXPECT_TRUE(support::waitFor([&] { return bench.force() == Vec3::Zero(); })) << fault;  // it may still hang up
    bench.hardware().error = 0;
    device.revive();  // connects again where the connection was lost
    for (int i = 0; i < 5; ++i) bench.tick(device, kTouch);
    EXPECT_LT((bench.force() - kTouch).norm(), 1e-12) << fault << device.explain();
    EXPECT_EQ(device.explain(), "") << fault;
  }
}

TEST_F(Haply, SaysWhatTheServiceSaid) {
  Device device = pushed();
  bench.hardware().error = doubles::kNoDevices;
  bench.tick(device, kTouch);
  EXPECT_EQ(device.explain(), "the service's answer has no devices: device busy");
  bench.hardware().error = doubles::kCloses;
  bench.tick(device, kTouch);
  EXPECT_TRUE(says(device.explain(), "closed")) << device.explain();
}

TEST_F(Haply, AServiceThatFallsSilentIsHungUpOnAndFoundAgain) {
  Device device = pushed();
  bench.hardware().error = doubles::kSilent;
  bench.tick(device, kTouch);
  EXPECT_TRUE(says(device.explain(), "no answer within")) << device.explain();
  EXPECT_FALSE(bench.tick(device, kTouch).allFinite());
  bench.hardware().error = 0;
  EXPECT_TRUE(device.revive());
  for (int i = 0; i < 5; ++i) bench.tick(device, kTouch);
  EXPECT_LT((bench.force() - kTouch).norm(), 1e-12);
}

TEST_F(Haply, AServiceThatComesBackWithoutTheDeviceIsNotToldItsForce) {
  OpenOptions options = bench.options();
  options.which = "right";
  Device device = bench.open(options);
  for (int i = 0; i < 5; ++i) bench.tick(device, kTouch);
  bench.hardware().error = doubles::kCloses;
  bench.tick(device, kTouch);
  bench.hardware().error = 0;
  bench.control().count = 1;
  EXPECT_FALSE(device.revive());
  bench.tick(device, kTouch);
  EXPECT_FALSE(says(doubles::lastHaplyOrder(), "12AB")) << doubles::lastHaplyOrder();
}

TEST_F(Haply, WhileTheServiceIsGoneItsWordsAndTheRemedyAreGiven) {
  Device device = pushed();
  bench.hardware().error = doubles::kCloses;
  bench.tick(device, kTouch);
  bench.control().refusal = doubles::kHangsUp;
  EXPECT_FALSE(device.revive());
  bench.tick(device, kTouch);
  EXPECT_TRUE(says(device.explain(), "systemctl start haply-inverse-service")) << device.explain();
}

/// Answers that come slower than two ticks are positions of then, not of now.
TEST_F(Haply, ALateAnswerIsAnOldPosition) {
  bench.control().by_hand = false;
  bench.control().slow_us = 8000;
  OpenOptions options = bench.options();
  options.own_thread = true;
  const Device device = bench.open(options);
  std::uint64_t tick = 0;
  int with_place = 0;
  for (; tick < 100; ++tick) {
    with_place += device.read_tip(tick).allFinite() ? 1 : 0;
    device.write_force({0, 0, 1});
    EXPECT_EQ(bench.force(), Vec3::Zero());
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(with_place, 0);
  EXPECT_TRUE(says(device.explain(), "too late")) << device.explain();
  bench.control().slow_us = 0;
  EXPECT_TRUE(support::waitFor([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return device.read_tip(tick++).allFinite();
  }));
}

TEST_F(Haply, TwoOpenAndOneIsClosedWhileTheThreadRuns) {
  bench.control().by_hand = false;
  OpenOptions options = bench.options();
  options.own_thread = true;
  const Device one = bench.open(options);
  const Device two = bench.open(options);
  std::uint64_t tick = 0;
  const auto push = [&] {
    one.read_tip(tick);
    two.read_tip(tick++);
    one.write_force({0, 0, 1});
    two.write_force({0, 0, 2});
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  };
  EXPECT_TRUE(support::waitFor([&] {
    push();
    return bench.force(0).z() == 1.0 && bench.force(1).z() == 2.0;
  }));
  one.close();
  EXPECT_EQ(bench.force(0), Vec3::Zero());
  EXPECT_FALSE(bench.hardware(0).open);
  EXPECT_TRUE(support::waitFor([&] {
    push();
    return bench.force(1).z() == 2.0;
  }));
}

// --- texts ---

TEST(HaplyMessage, IsReadAsTheMakerWritesIt) {
  const haply::Reply reply = haply::parseReply(R"({"session_id":1,"inverse3":[{"device_id":"049D",
    "config":{"type":"minverse","handedness":"right"},
    "state":{"cursor_position":{"x":0.01,"y":-0.12,"z":0.15},"cursor_velocity":{"x":1,"y":2,"z":3}}}],
    "wireless_verse_grip":[{"device_id":"F1","state":{"buttons":{"a":true,"b":false,"c":true}}}]})");
  ASSERT_EQ(reply.wrong, "");
  ASSERT_EQ(reply.devices.size(), 1u);
  EXPECT_EQ(reply.devices[0].id, "049D");
  EXPECT_EQ(reply.devices[0].type, "minverse");
  EXPECT_EQ(reply.devices[0].handedness, "right");
  ASSERT_TRUE(reply.devices[0].place_m);
  EXPECT_EQ(*reply.devices[0].place_m, Vec3(0.01, -0.12, 0.15));
  EXPECT_EQ(reply.devices[0].speed_m_s, Vec3(1, 2, 3));
  EXPECT_EQ(reply.devices[0].buttons, 5u);
}

TEST(HaplyMessage, IsRefusedWithAReason) {
  for (const char* text : {"", "hello", "[]", "{}", "null", R"({"inverse3":7})", R"({"inverse3":[)"}) {
    EXPECT_GT(haply::parseReply(text).wrong.size(), 10u) << text;
  }
  EXPECT_GT(haply::parseReply(R"({"inverse3":[],"p":")" + std::string(haply::kMaxReplyBytes, 'x') + "\"}").wrong.size(),
            10u);
}

TEST(HaplyMessage, HoldsNoPlaceThatIsNone) {
  for (const char* place :
       {R"({"x":1,"y":2})", R"({"x":1,"y":2,"z":null})", R"({"x":1,"y":2,"z":"3"})", R"({"x":1,"y":2,"z":11})",
        R"({"x":1,"y":2,"z":-1e300})", R"({"x":1,"y":2,"z":true})", R"([1,2,3])", "null"}) {
    const haply::Reply reply =
        haply::parseReply(R"({"inverse3":[{"device_id":"A","state":{"cursor_position":)" + std::string(place) + "}}]}");
    ASSERT_EQ(reply.devices.size(), 1u) << place;
    EXPECT_TRUE(reply.devices[0].has_state);
    EXPECT_FALSE(reply.devices[0].place_m) << place;
  }
}

TEST(HaplyMessage, TakesNoDeviceWhoseNameCouldNotBeSentBack) {
  for (const char* id : {"", R"(\")", "a b", R"(\u0000)", "123456789012345678901234567890123"}) {
    EXPECT_TRUE(haply::parseReply(R"({"inverse3":[{"device_id":")" + std::string(id) + "\"}]}").devices.empty()) << id;
  }
}

TEST(HaplyMessage, AForceIsNotRoundedUp) {
  const haply::DeviceOrder order{"049D", Vec3(1.0 / 3.0, -5e-324, 4.999999999999999), false, false};
  const json text = json::parse(haply::orderText(std::span(&order, 1), {haply::ForceKey::vector, false}));
  const json& force = text["inverse3"][0]["commands"]["set_cursor_force"]["vector"];
  EXPECT_EQ(force["x"].get<double>(), 1.0 / 3.0);
  EXPECT_EQ(force["z"].get<double>(), 4.999999999999999);
}

}  // namespace
}  // namespace palpate::device
