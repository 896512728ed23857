// `palpate class watch DIR`: the instructor's view, as a window or as a line of JSON each second.
#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "class/commands/class_commands.h"
#include "class/window/class_window.h"
#include "cli/kit/choice_option.h"
#include "cli/kit/interruption.h"
#include "cli/kit/json.h"
#include "cli/kit/number_option.h"
#include "cli/kit/options.h"
#include "cli/kit/progress_line.h"
#include "cli/kit/readable_text.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/language.h"
#include "palpate/base/stopwatch.h"
#include "palpate/base/text.h"
#include "palpate/classroom/class_folder.h"
#include "palpate/classroom/class_settings.h"
#include "palpate/classroom/class_watch.h"
#include "palpate/scene/presets.h"
#include "palpate/scene/scene_file.h"
#include "palpate/scene/world.h"
#include "palpate/training/records/store.h"
#include "teach/commands/results_commands.h"

namespace palpate::app {

namespace {

struct ClassWatchArguments {
  std::string folder;
  std::string records;
  std::string picture;
  std::string opened;
  double seconds = 0.0;
  bool json = false;
  std::string language;
};

/// Loads what was measured before the watch began.
void rememberRecords(const std::string& file, classroom::ClassWatch& watch) {
  training::Store store = recordsAt(file, training::Store::Open::read_only);
  for (const training::SessionRow& session : store.sessions()) {
    for (const training::BlockRow& block : store.blocks(session.id)) watch.remember(session.trainee_id, block);
  }
}

Json boardJson(const classroom::ClassWatch& watch) {
  const auto point_json = [](const classroom::CurvePoint& point) {
    return Json{{"number", point.number},
                {"trainees", point.trainees},
                {"median", point.median},
                {"low", point.low},
                {"high", point.high}};
  };
  return {{"connected", watch.connected()},
          {"trouble", watch.trouble()},
          {"tiles", listJson(watch.tiles(), tileJson)},
          {"learning_curve", listJson(watch.learningCurve(), point_json)}};
}

void printBoard(const ClassWatchArguments& arguments, const classroom::ClassWatch& watch) {
  const auto started = Clock::now();
  while (endingSignal() == 0) {
    std::this_thread::sleep_for(std::chrono::seconds(1));
    printReadable(jsonDump(boardJson(watch)) + "\n");
    std::fflush(stdout);
    if (arguments.seconds > 0.0 && secondsSince(started) >= arguments.seconds) return;
  }
}

void runClassWatch(const ClassWatchArguments& arguments) {
  useLanguage(arguments.language);
  const std::filesystem::path folder = arguments.folder;
  const bool whole = std::filesystem::exists(folder / "class.toml");
  const classroom::Member member = classroom::readMember(whole ? folder / "instructor" : folder);
  if (member.role != classroom::Role::instructor)
    throw Error(arguments.folder + ": must be the folder of a class or of its instructor");
  const int days = classroom::daysLeft(readFile(member.certificate, 65536));
  for (const std::string& line : classroom::certificateWarnings({{"this window", member.certificate, days}})) {
    say(fmt::format("palpate: {}\n", line));
  }
  viewer::ClassWindowSettings settings;
  if (!arguments.json) settings.world = scene::build(scene::standardScene());
  const FinishesInOrder in_order;
  classroom::ClassWatch watch(member);
  if (!arguments.records.empty()) rememberRecords(arguments.records, watch);
  if (arguments.json) return printBoard(arguments, watch);
  settings.title = fmt::format("{} - Palpate", member.class_id);
  settings.opened = arguments.opened;
  settings.seconds = arguments.seconds;
  settings.picture = arguments.picture;
  settings.ending = [] { return endingSignal() != 0; };
  viewer::runClassWindow(watch, settings);
}

}  // namespace

Json tileJson(const classroom::Tile& tile) {
  Json json = {{"station", tile.station},
               {"online", tile.online},
               {"device", tile.status.device},
               {"safety", tile.status.safety},
               {"needs", classroom::wordsOf(tile.need)},
               {"fresh", tile.fresh},
               {"age_s", orNull(tile.age_s)},
               {"force_n", tile.live.force_n},
               {"site", tile.live.site},
               {"sites_pressed", tile.live.sites_pressed}};
  if (!tile.state) {
    json["state"] = nullptr;
    return json;
  }
  json["state"] = {{"trainee", tile.state->trainee},
                   {"kind", wordFor(tile.state->kind)},
                   {"trial", tile.state->trial},
                   {"trials_at_most", tile.state->trials_at_most},
                   {"change", tile.state->change},
                   {"threshold", tile.state->threshold},
                   {"low", tile.state->low},
                   {"high", tile.state->high},
                   {"wrong_in_a_row", tile.state->wrong_in_a_row},
                   {"paused", tile.state->paused}};
  return json;
}

void addClassWatchCommand(Command& parent) {
  const auto [command, arguments] =
      addCommand(parent, "watch", "Watch every station of a class, those that need help first", runClassWatch);
  command.add_option("DIR", arguments.folder, "Folder of the class, or of its instructor")->required();
  command.add_option("--records", arguments.records,
                     "Earlier records for the learning curve: a file, or the address of PostgreSQL");
  command.add_option("--station", arguments.opened, "Station to show at the start");
  command.add_option("--picture", arguments.picture, "Write the last picture to this PNG file");
  addNumber(command, "--seconds", arguments.seconds, between(0.0, 1e6, "s"), "Stop after this time; 0: never");
  command.add_flag("--json", arguments.json, "Open no window; print one JSON object per second");
  addLanguage(command, arguments.language);
}

}  // namespace palpate::app
