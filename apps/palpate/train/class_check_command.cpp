// `palpate class check DIR`: what of a class works, step by step, from the certificates to the database and back.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "apps/palpate/common/commands.h"
#include "apps/palpate/train/class_commands.h"
#include "palpate/base/error.h"
#include "palpate/base/stopwatch.h"
#include "palpate/base/text.h"
#include "palpate/classroom/certificates.h"
#include "palpate/classroom/class_folder.h"
#include "palpate/classroom/messages.h"
#include "palpate/classroom/mqtt_link.h"
#include "palpate/training/records/row_json.h"

namespace palpate::app {

namespace {

using classroom::Member;
using classroom::MqttLink;
using classroom::MqttSettings;

constexpr double kPatienceS = 5.0;
constexpr double kShutOutS = 1.5;  // a broker that lets nobody in says so sooner
constexpr std::uint64_t kMostPemBytes = 65536;

struct Finding {
  std::string what = {};
  bool good = false;
  std::string detail = {};
};

bool within(double seconds, const std::function<bool()>& so) {
  const auto started = Clock::now();
  while (secondsSince(started) < seconds) {
    if (so()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return so();
}

/// Beside whoever uses this certificate now, not instead of them.
MqttSettings besides(const Member& member) {
  MqttSettings settings = classroom::linkOf(member);
  settings.client_id += "-check";
  return settings;
}

Finding checkCertificate(const std::string& whose, const std::filesystem::path& file) {
  Finding finding{fmt::format("certificate of {}", whose)};
  try {
    const int days = classroom::daysLeft(readFile(file, kMostPemBytes));
    finding.good = days >= 0;
    finding.detail = finding.good ? fmt::format("valid for {} days", days) : "no longer valid";
  } catch (const Error& error) {
    finding.detail = error.what();
  }
  return finding;
}

Finding checkConnection(const Member& member) {
  const MqttLink link(besides(member), {});
  const bool good = within(kPatienceS, [&] { return link.connected(); });
  return {fmt::format("{} connects to {}:{}", member.name, member.host, member.port), good, link.trouble()};
}

Finding checkShutOut(const Member& member) {
  MqttSettings settings = besides(member);
  settings.certificate.clear();
  settings.key.clear();
  settings.client_id += "-nobody";
  const MqttLink link(settings, {});
  const bool let_in = within(kShutOutS, [&] { return link.connected(); });
  return {"nobody gets in without a certificate", !let_in, let_in ? "the broker lets anybody in" : ""};
}

/// A station's own row goes to the database, and its acknowledgement comes back.
Finding checkCollector(const Member& station) {
  Finding finding{"what a station records reaches the database"};
  training::StationRow row;
  row.id = station.station_id;
  row.name = station.name;
  row.certificate_sha256 = classroom::fingerprintOf(readFile(station.certificate, kMostPemBytes));
  const training::Uuid key = training::outboxKey(row);
  std::atomic<bool> acknowledged = false;
  MqttSettings settings = besides(station);
  settings.subscriptions = {{classroom::topicText({station.class_id, station.name, "ack"}), 1}};
  MqttLink link(settings, {[&](std::string_view, std::string_view text) {
                             const auto keys = classroom::parseAck(text);
                             if (keys && std::ranges::find(*keys, key) != keys->end()) acknowledged = true;
                           },
                           {}});
  if (!within(kPatienceS, [&] { return link.connected(); })) {
    finding.detail = link.trouble();
    return finding;
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(200));  // its subscription
  link.publish({classroom::topicText({station.class_id, station.name, "station"}),
                classroom::rowText({1, key, 0.0}, training::rowJson(row)), 1, false, 0});
  finding.good = within(kPatienceS, [&] { return acknowledged.load(); });
  if (!finding.good) finding.detail = "no acknowledgement: is `palpate class serve` running, and its database?";
  return finding;
}

std::vector<Finding> findingsOfClass(const classroom::ClassFolder& folder) {
  const Member instructor = classroom::readMember(folder.instructor());
  std::vector<Finding> findings = {checkCertificate("the broker", folder.broker() / "server.crt"),
                                   checkCertificate("the instructor", instructor.certificate)};
  findings.push_back(checkConnection(instructor));
  if (!findings.back().good) return findings;
  findings.push_back(checkShutOut(instructor));
  if (folder.stations.empty()) return findings;
  const Member station = classroom::readMember(folder.station(folder.stations.front()));
  findings.push_back(checkConnection(station));
  findings.push_back(checkCollector(station));
  return findings;
}

std::vector<Finding> findingsOfMember(const Member& member) {
  std::vector<Finding> findings = {checkCertificate(member.name, member.certificate), checkConnection(member)};
  if (findings.back().good && member.role == classroom::Role::station) findings.push_back(checkCollector(member));
  return findings;
}

void runClassCheck(const std::string& folder, bool json) {
  const bool whole = std::filesystem::exists(std::filesystem::path(folder) / "class.toml");
  const std::vector<Finding> findings =
      whole ? findingsOfClass(classroom::readClassFolder(folder)) : findingsOfMember(classroom::readMember(folder));
  const bool good = std::ranges::all_of(findings, [](const Finding& finding) { return finding.good; });
  if (json) {
    nlohmann::ordered_json all = {{"ok", good}, {"steps", nlohmann::ordered_json::array()}};
    for (const Finding& finding : findings) {
      all["steps"].push_back({{"what", finding.what}, {"ok", finding.good}, {"detail", finding.detail}});
    }
    fmt::print("{}\n", all.dump(2));
  } else {
    for (const Finding& finding : findings) {
      fmt::print("{:<4}{}{}{}\n", finding.good ? "ok" : "NO", finding.what, finding.detail.empty() ? "" : ": ",
                 finding.detail);
    }
  }
  if (!good) throw CLI::RuntimeError(1);
}

}  // namespace

void addClassCheckCommand(CLI::App& parent) {
  struct CheckArguments {
    std::string folder;
    bool json = false;
  };
  const auto arguments = std::make_shared<CheckArguments>();
  CLI::App& command =
      *parent.add_subcommand("check", "Whether a class works: certificates, broker, collector, database");
  command.add_option("DIR", arguments->folder, "Folder of the class, or of one station")->required();
  command.add_flag("--json", arguments->json, "Print one JSON object");
  command.callback([arguments] { runClassCheck(arguments->folder, arguments->json); });
}

}  // namespace palpate::app
