// `palpate class`: a class over the network; each subcommand has a file of its own, the two that make folders are here.
#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "class/commands/class_commands.h"
#include "class/commands/commands.h"
#include "cli/kit/number_option.h"
#include "cli/kit/progress_line.h"
#include "palpate/base/json.h"
#include "palpate/base/text.h"
#include "palpate/classroom/class_folder.h"
#include "palpate/classroom/class_part.h"
#include "teach/commands/class_part.h"
#include "teach/commands/commands.h"

namespace palpate::app {

namespace {

struct ClassInitArguments {
  std::string folder;
  classroom::ClassPlan plan;
  std::vector<std::string> hosts;
  bool json = false;
};

void runClassInit(const ClassInitArguments& arguments) {
  classroom::ClassPlan plan = arguments.plan;
  if (!arguments.hosts.empty()) plan.hosts = arguments.hosts;
  const classroom::ClassFolder made = classroom::makeClassFolder(arguments.folder, plan);
  if (arguments.json) {
    const Json json = {{"folder", arguments.folder},
                       {"class", made.class_id},
                       {"host", made.host},
                       {"port", made.port},
                       {"stations", made.stations}};
    fmt::print("{}\n", jsonDump(json, 2));
    return;
  }
  fmt::print("{}: class {} with {} station{}, {} to {}\n\n", arguments.folder, made.class_id, made.stations.size(),
             made.stations.size() == 1 ? "" : "s", made.stations.front(), made.stations.back());
  fmt::print("On this computer:   palpate class serve {} --broker\n", arguments.folder);
  fmt::print("                    palpate class watch {}\n", arguments.folder);
  fmt::print("At each station:    its own folder of {}/stations, then palpate train --class FOLDER\n",
             arguments.folder);
  fmt::print("Does it work?       palpate class check {}\n", arguments.folder);
}

struct StationArguments {
  std::string folder;
  std::string name;
  bool yes = false;
};

void runRemoveStation(const StationArguments& arguments) {
  const classroom::ClassFolder folder = classroom::readClassFolder(arguments.folder);
  if (!arguments.yes) {
    say(fmt::format("Let station {} in no longer? Its certificate stays revoked for ever. Type yes: ", arguments.name));
    std::string answer;
    std::getline(std::cin, answer);
    if (trimmed(answer) != "yes") {
      fmt::print(stderr, "nothing was removed (--yes skips the question)\n");
      throw ExitWith(1);
    }
  }
  classroom::removeStation(folder, arguments.name);
  fmt::print(
      "{} can no longer connect. `palpate class serve --broker` updates automatically; restart any other broker.\n"
      "The name is free: palpate class add-station {} {}\n",
      arguments.name, arguments.folder, arguments.name);
}

struct RenewArguments {
  std::string folder;
  std::vector<std::string> names;
  int days = classroom::kMemberDays;
};

void runClassRenew(const RenewArguments& arguments) {
  const classroom::ClassFolder folder = classroom::readClassFolder(arguments.folder);
  for (const auto& renewed : classroom::renewCertificates(folder, arguments.names, arguments.days)) {
    fmt::print("{}\n", renewed.string());
  }
  fmt::print(
      "Copy each station its folder again; its old certificate stays valid until it expires. `palpate class serve "
      "--broker` updates automatically; restart any other broker.\n");
}

}  // namespace

void addClassRenewCommand(Command& parent) {
  const auto [command, arguments] =
      addCommand(parent, "renew", "Renew certificates, and add what an older class lacks", runClassRenew);
  command.add_option("DIR", arguments.folder, "Folder of the class")->required();
  command.add_option("NAME", arguments.names,
                     "Members to renew: broker, instructor, instructor-2, ingest, checker, s01 (default: all)");
  addSetting(command, "--days", arguments.days, between(1, 3650, "days"), "Validity of the new certificates");
}

void addClassAddInstructorCommand(Command& parent) {
  const auto [command, arguments] = addCommand<StationArguments>(
      parent, "add-instructor", "Make a certificate for one more window; the broker needs no change",
      [](const StationArguments& a) {
        fmt::print("{}\n", classroom::addInstructor(classroom::readClassFolder(a.folder)).string());
      });
  command.add_option("DIR", arguments.folder, "Folder of the class")->required();
}

void addClassInitCommand(Command& parent) {
  const auto [command, arguments] =
      addCommand(parent, "init", "Make certificates and configuration of a class", runClassInit);
  command.add_option("DIR", arguments.folder, "Folder to create for the teacher, with the keys")->required();
  command.add_option("--class", arguments.plan.class_id, "Name of the class in messages, such as osteo-1")->required();
  addSetting(command, "--stations", arguments.plan.stations, between(1, 999), "Number of stations, from s01 on");
  command.add_option("--host", arguments.hosts,
                     "Name or address at which stations reach this computer, repeatable; stations use the first");
  addSetting(command, "--port", arguments.plan.port, between(1, 65535), "Port of the broker");
  addSetting(command, "--retain-days", arguments.plan.retention.days, between(1, 36500, "days"),
             "How long to keep rows after a session");
  addSetting(command, "--retain-samples-days", arguments.plan.retention.samples_days, between(1, 36500, "days"),
             "How long stations keep recordings");
  command.add_option("--label", arguments.plan.label, "Display name of the class");
  command.add_flag("--json", arguments.json, "Print one JSON object");
}

void addClassAddStationCommand(Command& parent) {
  const auto [command, arguments] = addCommand<StationArguments>(
      parent, "add-station", "Add a station; the broker needs no change", [](const StationArguments& a) {
        const classroom::ClassFolder folder = classroom::readClassFolder(a.folder);
        fmt::print("{}\n", folder.station(classroom::addStation(folder, a.name)).string());
      });
  command.add_option("DIR", arguments.folder, "Folder of the class")->required();
  command.add_option("NAME", arguments.name, "Name of the station (default: the next number)");
}

void addClassRemoveStationCommand(Command& parent) {
  const auto [command, arguments] = addCommand(
      parent, "remove-station", "Revoke a station's certificate, e.g. when its folder was lost", runRemoveStation);
  command.add_option("DIR", arguments.folder, "Folder of the class")->required();
  command.add_option("NAME", arguments.name, "Station to remove, such as s01")->required();
  command.add_flag("--yes", arguments.yes, "Do not ask for confirmation");
}

void addClassCommand(Command& app) {
  Command& command = *app.add_subcommand("class", "Run a class over the network: broker, collector, instructor's view");
  command.require_subcommand(1);
  addClassInitCommand(command);
  addClassAddStationCommand(command);
  addClassRemoveStationCommand(command);
  addClassAddInstructorCommand(command);
  addClassRenewCommand(command);
  addClassServeCommand(command);
  addClassCheckCommand(command);
  addClassWatchCommand(command);
  addClassLoadCommand(command);
}

void addClassFamily(Command& app) {
  installClassPart(classroom::makeClassPart());
  addTeachFamily(app);
  addClassCommand(app);
}

}  // namespace palpate::app
