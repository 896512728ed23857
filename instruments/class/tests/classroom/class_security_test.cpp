// Who is let in and what they may do, asked of a real broker with the configuration that `palpate class init` writes:
// each refusal beside the same thing done by the one who may.
#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>

#include "class/tests/classroom/class_broker.h"
#include "palpate/classroom/messages.h"
#include "support/wait_for.h"

namespace palpate::classroom {
namespace {

using support::waitFor;

class ClassSecurityTest : public brokers::BrokerTest {
 protected:
  std::string topic(const char* station, const char* kind) const { return topicText({"osteo-1", station, kind}); }

  /// True when the broker has taken it, false when it refused.
  static bool accepts(MqttLink& link, const std::string& where) {
    EXPECT_TRUE(waitFor([&] { return link.connected(); })) << link.trouble();
    const std::uint64_t before = link.refused();
    EXPECT_TRUE(link.publish({where, "{}", 1, false, 0}));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));  // its answer
    return link.refused() == before;
  }
  /// Never within a few attempts.
  static bool staysOut(const MqttSettings& settings) {
    const MqttLink link(settings, {});
    for (int i = 0; i < 150; ++i) {
      if (link.connected()) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return true;
  }
};

TEST_F(ClassSecurityTest, NobodyWithoutACertificateOfThisClassComesIn) {
  const MqttLink good(makeMqttSettings(station("s01")), {});
  EXPECT_TRUE(waitFor([&] { return good.connected(); })) << good.trouble();

  MqttSettings anonymous = makeMqttSettings(station("s02"));
  anonymous.certificate.clear();
  anonymous.key.clear();
  EXPECT_TRUE(staysOut(anonymous));

  // Another class's: the same names, another authority.
  const ClassFolder other = makeClassFolder(temporary_ / "other", brokers::smallClass(2, folder_.port));
  MqttSettings stranger = makeMqttSettings(readMember(other.station("s02")));
  stranger.authority = station("s02").authority;
  EXPECT_TRUE(staysOut(stranger));
}

TEST_F(ClassSecurityTest, AStationThatWasRemovedStaysOutAndTheOthersComeIn) {
  const std::filesystem::path lost = temporary_ / "lost";  // a stick with all that the station had
  std::filesystem::copy(folder_.station("s02"), lost, std::filesystem::copy_options::recursive);
  EXPECT_FALSE(staysOut(makeMqttSettings(readMember(lost))));
  removeStation(folder_, "s02");
  broker_->restart();
  EXPECT_TRUE(staysOut(makeMqttSettings(readMember(lost))));
  addStation(folder_, "s02");
  for (const Member& member : {station("s01"), station("s02"), instructor(), ingest()}) {
    EXPECT_FALSE(staysOut(makeMqttSettings(member))) << member.name;
  }
}

TEST_F(ClassSecurityTest, AStationDoesNotTalkToABrokerOfAnotherClass) {
  const ClassFolder other = makeClassFolder(temporary_ / "other", brokers::smallClass(2, folder_.port));
  MqttSettings misled = makeMqttSettings(station("s01"));
  misled.authority = readMember(other.station("s01")).authority;
  EXPECT_TRUE(staysOut(misled));
}

TEST_F(ClassSecurityTest, AStationWritesItsOwnTopicsAlone) {
  MqttLink link(makeMqttSettings(station("s01")), {});
  EXPECT_TRUE(accepts(link, topic("s01", "trial")));
  EXPECT_TRUE(accepts(link, topic("s01", "live")));
  EXPECT_FALSE(accepts(link, topic("s02", "trial")));
  EXPECT_FALSE(accepts(link, topic("s02", "cmd")));
  EXPECT_FALSE(accepts(link, topic("s01", "ack")));
  EXPECT_FALSE(accepts(link, topic("s01", "cmd")));
  EXPECT_FALSE(accepts(link, "palpate/v1/other/st/s01/trial"));
  EXPECT_FALSE(accepts(link, "something/else"));
}

TEST_F(ClassSecurityTest, TheInstructorAsksAndWritesNoResults) {
  MqttLink link(makeMqttSettings(instructor()), {});
  EXPECT_TRUE(accepts(link, topic("s01", "cmd")));
  EXPECT_TRUE(accepts(link, topic("instructor", "delete")));
  EXPECT_FALSE(accepts(link, topic("s01", "delete")));
  for (const char* kind : {"trial", "block", "session", "event", "ack", "state", "live"}) {
    EXPECT_FALSE(accepts(link, topic("s01", kind))) << kind;
    EXPECT_FALSE(accepts(link, topic("instructor", kind))) << kind;
  }
}

TEST_F(ClassSecurityTest, TheCollectorAcknowledgesAndWritesNoResults) {
  MqttLink link(makeMqttSettings(ingest()), {});
  EXPECT_TRUE(accepts(link, topic("s01", "ack")));
  EXPECT_TRUE(accepts(link, topic("s01", "state")));
  for (const char* kind : {"trial", "block", "cmd", "live"}) EXPECT_FALSE(accepts(link, topic("s01", kind))) << kind;
}

TEST_F(ClassSecurityTest, AStationHearsNobodyElse) {
  std::mutex mutex;
  std::set<std::string> heard;
  MqttSettings settings = makeMqttSettings(station("s02"));
  settings.subscriptions = {{"#", 1}, {topic("s01", "trial"), 1}, {topic("s02", "cmd"), 1}};
  const MqttLink curious(settings, {[&](auto where, auto) {
                                      const std::lock_guard lock(mutex);
                                      heard.emplace(where);
                                    },
                                    {}});
  MqttLink other(makeMqttSettings(station("s01")), {});
  MqttLink teacher(makeMqttSettings(instructor()), {});
  ASSERT_TRUE(waitFor([&] { return curious.connected() && other.connected() && teacher.connected(); }));
  std::this_thread::sleep_for(std::chrono::milliseconds(200));  // its subscriptions
  for (const char* kind : {"trial", "live", "state"}) other.publish({topic("s01", kind), "{}", 1, false, 0});
  teacher.publish({topic("s01", "cmd"), "{}", 1, false, 0});
  teacher.publish({topic("s02", "cmd"), "{}", 1, false, 0});
  EXPECT_TRUE(waitFor([&] {
    const std::lock_guard lock(mutex);
    return heard.contains(topic("s02", "cmd"));
  }));
  const std::lock_guard lock(mutex);
  EXPECT_EQ(heard, std::set<std::string>{topic("s02", "cmd")});
}

TEST_F(ClassSecurityTest, TheCheckerAsksTheCollectorAndNothingElse) {
  MqttLink link(makeMqttSettings(readMember(folder_.checker())), {});
  EXPECT_TRUE(accepts(link, topic("checker", "check")));
  for (const char* kind : {"trial", "delete", "ack", "cmd"}) {
    EXPECT_FALSE(accepts(link, topic("s01", kind))) << kind;
    EXPECT_FALSE(accepts(link, topic("checker", kind))) << kind;
  }
}

class ClassSecurityWithPatience : public ClassSecurityTest {};

TEST_F(ClassSecurityWithPatience, TwoProgramsWithOneCertificateTakeTurnsEverMoreSlowlyAndSayWhy) {
  std::atomic<int> connections = 0;
  const MqttHandlers counting{{}, [&] { ++connections; }};
  const MqttLink first(makeMqttSettings(station("s01")), counting);
  const MqttLink second(makeMqttSettings(station("s01")), counting);
  std::string said;
  const auto until = Clock::now() + std::chrono::seconds(5);
  while (Clock::now() < until) {
    for (const MqttLink* link : {&first, &second}) said += link->trouble();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_NE(said.find("another program"), std::string::npos) << said.substr(0, 200);
  EXPECT_LE(connections, 10);  // with half a second each it would be twenty
}

TEST_F(ClassSecurityTest, EveryInstructorsWindowHasItsOwnConnection) {
  const MqttLink first(makeMqttSettings(instructor()), {});
  const MqttLink second(makeMqttSettings(readMember(addInstructor(folder_))), {});
  ASSERT_TRUE(waitFor([&] { return first.connected() && second.connected(); }));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_TRUE(first.connected());
  EXPECT_TRUE(second.connected());
}

}  // namespace
}  // namespace palpate::classroom
