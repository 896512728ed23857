// A real broker for a test: a class's folder in a temporary folder, mosquitto with its configuration on a port of its
// own, and stations with their records.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <memory>
#include <string>

#include "palpate/classroom/broker_process.h"
#include "palpate/classroom/class_folder.h"
#include "palpate/classroom/mqtt_link.h"
#include "support/temporary_folder.h"

namespace palpate::classroom::brokers {

/// Nobody listens there at the moment.
inline int freePort() {
  const int handle = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  EXPECT_EQ(bind(handle, reinterpret_cast<sockaddr*>(&address), size), 0);
  getsockname(handle, reinterpret_cast<sockaddr*>(&address), &size);
  close(handle);
  return ntohs(address.sin_port);
}

inline ClassPlan smallClass(int stations, int port) {
  ClassPlan plan;
  plan.class_id = "osteo-1";
  plan.stations = stations;
  plan.hosts = {"localhost"};
  plan.port = port;
  return plan;
}

class BrokerTest : public testing::Test {
 protected:
  void SetUp() override {
    if (brokerProgram().empty()) GTEST_SKIP() << "mosquitto is not installed (apt install mosquitto)";
    folder_ = makeClassFolder(temporary_ / "class", smallClass(3, freePort()));
    broker_ = std::make_unique<BrokerProcess>(folder_, temporary_ / "broker.log");
  }

  Member station(const std::string& name) const { return readMember(folder_.station(name)); }
  Member instructor() const { return readMember(folder_.instructor()); }
  Member ingest() const { return readMember(folder_.ingest()); }

  const support::TemporaryFolder temporary_{};
  ClassFolder folder_;
  std::unique_ptr<BrokerProcess> broker_;
};

}  // namespace palpate::classroom::brokers
