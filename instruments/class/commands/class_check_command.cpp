// `palpate class check DIR`: what of a class works, step by step, from the certificates to the database and back.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "class/commands/class_commands.h"
#include "cli/kit/options.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/stopwatch.h"
#include "palpate/base/text.h"
#include "palpate/classroom/certificates.h"
#include "palpate/classroom/class_folder.h"
#include "palpate/classroom/messages.h"
#include "palpate/classroom/mqtt_link.h"
#include "palpate/training/records/trainee_code.h"

namespace palpate::app {

namespace {

using classroom::Member;
using classroom::MqttLink;
using classroom::MqttSettings;

constexpr double kPatienceS = 5.0;
constexpr double kShutOutS = 1.5;  // a broker that refuses us says so sooner
constexpr std::uint64_t kMaxPemBytes = 65536;

struct Finding {
  std::string what = {};
  bool good = false;
  std::string detail = {};
  bool warns = false;  ///< good today, and not for long
};

bool within(double seconds, const std::function<bool()>& so) {
  const auto started = Clock::now();
  while (secondsSince(started) < seconds) {
    if (so()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return so();
}

Finding reportCertificateLife(const classroom::CertificateLife& life) {
  Finding finding{fmt::format("certificate of {}", life.whose), life.days_left >= 0, {}};
  finding.detail = finding.good ? fmt::format("valid for {} days", life.days_left) : "no longer valid";
  finding.warns = life.days_left <= classroom::kWarnDays;
  if (finding.warns) finding.detail += "; `palpate class renew` makes a new one";
  return finding;
}

Finding checkCertificate(const std::string& whose, const std::filesystem::path& file) {
  try {
    return reportCertificateLife({whose, file, classroom::daysLeft(readFile(file, kMaxPemBytes))});
  } catch (const Error& error) {
    return {fmt::format("certificate of {}", whose), false, error.what()};
  }
}

Finding checkKeys(const std::vector<std::filesystem::path>& files) {
  for (const auto& file : files) {
    const std::string fault = classroom::keyFileFault(file);
    if (!fault.empty()) return {"keys are their owner's alone", false, fmt::format("{} {}", file.string(), fault)};
  }
  return {"keys are their owner's alone", true, fmt::format("{} files", files.size())};
}

std::vector<std::filesystem::path> keysIn(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> keys;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".key") keys.push_back(entry.path());
  }
  std::ranges::sort(keys);
  return keys;
}

Finding checkConfiguration(const classroom::ClassFolder& folder) {
  const std::string outdated = classroom::outdatedConfiguration(folder);
  return {"configuration of the broker", outdated.empty(),
          outdated.empty() ? "" : outdated + "; `palpate class renew` writes it again"};
}

Finding checkConnection(const Member& member) {
  const MqttLink link(classroom::makeMqttSettings(member), {});
  const bool good = within(kPatienceS, [&] { return link.connected(); });
  return {fmt::format("{} connects to {}:{}", member.name, member.host, member.port), good, link.trouble()};
}

Finding checkCertificateNeeded(const Member& member) {
  MqttSettings settings = classroom::makeMqttSettings(member);
  settings.certificate.clear();
  settings.key.clear();
  settings.client_id += "-nobody";
  const MqttLink link(settings, {});
  const bool let_in = within(kShutOutS, [&] { return link.connected(); });
  return {"the broker refuses connections without a certificate", !let_in,
          let_in ? "the broker accepts connections without a certificate" : ""};
}

/// Sends a question to the collector and its database, and expects an acknowledgement.
Finding checkCollector(const Member& member) {
  Finding finding{"a station's records reach the database"};
  const training::Uuid key = training::makeUuidV7(training::utcMs(), training::systemRandom());
  std::atomic<bool> acknowledged = false;
  MqttSettings settings = classroom::makeMqttSettings(member);
  settings.subscriptions = {{classroom::topicText({member.class_id, member.name, "ack"}), 1}};
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
  link.publish({classroom::topicText({member.class_id, member.name, std::string(classroom::kCheckKind)}),
                classroom::rowText({1, key, 0.0}, "{}"), 1, false, 0});
  finding.good = within(kPatienceS, [&] { return acknowledged.load(); });
  if (!finding.good) finding.detail = "no acknowledgement: is `palpate class serve` running, and its database?";
  return finding;
}

/// Uses a certificate of its own: a certificate allows one connection, and no member may lose theirs to the check.
std::vector<Finding> findingsOfClass(const classroom::ClassFolder& folder) {
  std::vector<Finding> findings;
  for (const classroom::CertificateLife& life : classroom::certificateLives(folder))
    findings.push_back(reportCertificateLife(life));
  findings.push_back(checkKeys(keysIn(folder.folder)));
  findings.push_back(checkConfiguration(folder));
  if (!std::filesystem::exists(folder.checker() / "checker.toml")) {
    findings.push_back({"certificate of the checker", false, "of an older class; `palpate class renew` makes it"});
    return findings;
  }
  const Member checker = classroom::readMember(folder.checker());
  findings.push_back(checkConnection(checker));
  if (!findings.back().good) return findings;
  findings.push_back(checkCertificateNeeded(checker));
  findings.push_back(checkCollector(checker));
  return findings;
}

/// A training that runs with this certificate is off for a second or two; its rows wait.
std::vector<Finding> findingsOfMember(const Member& member) {
  std::vector<Finding> findings = {checkCertificate(member.name, member.certificate), checkKeys({member.key}),
                                   checkConnection(member)};
  const bool asks = member.role == classroom::Role::station || member.role == classroom::Role::checker;
  if (findings.back().good && asks) findings.push_back(checkCollector(member));
  return findings;
}

void runClassCheck(const std::string& folder, bool json) {
  const bool whole = std::filesystem::exists(std::filesystem::path(folder) / "class.toml");
  const std::vector<Finding> findings =
      whole ? findingsOfClass(classroom::readClassFolder(folder)) : findingsOfMember(classroom::readMember(folder));
  const bool good = std::ranges::all_of(findings, [](const Finding& finding) { return finding.good; });
  if (json) {
    Json all = {{"ok", good}, {"steps", Json::array()}};
    for (const Finding& finding : findings) {
      all["steps"].push_back(
          {{"what", finding.what}, {"ok", finding.good}, {"warning", finding.warns}, {"detail", finding.detail}});
    }
    fmt::print("{}\n", jsonDump(all, 2));
  } else {
    for (const Finding& finding : findings) {
      fmt::print("{:<4}{}{}{}\n", finding.good ? "ok" : "NO", finding.what, finding.detail.empty() ? "" : ": ",
                 finding.detail);
    }
  }
  if (!good) throw ExitWith(1);
}

}  // namespace

void addClassCheckCommand(Command& parent) {
  struct CheckArguments {
    std::string folder;
    bool json = false;
  };
  const auto [command, arguments] =
      addCommand<CheckArguments>(parent, "check", "Whether a class works: certificates, broker, collector, database",
                                 [](const CheckArguments& a) { runClassCheck(a.folder, a.json); });
  command.add_option("DIR", arguments.folder, "Folder of the class, or of one station")->required();
  command.add_flag("--json", arguments.json, "Print one JSON object");
}

}  // namespace palpate::app
