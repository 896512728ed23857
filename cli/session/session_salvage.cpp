#include "cli/session/session_salvage.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/kit/json.h"
#include "cli/kit/progress_line.h"
#include "cli/kit/readable_text.h"
#include "cli/session/session_text.h"
#include "palpate/trace/session_repair.h"

namespace palpate::app {

namespace {

using Json = nlohmann::ordered_json;

/// "index: 150 samples, 0.300 to 0.449 s (ticks 300 to 449)"
std::string textOf(const trace::SessionRepair& repair, const trace::MissingTicks& missing) {
  return fmt::format("{}: {} samples, {:.3f} to {:.3f} s (ticks {} to {})", repair.fingers.at(missing.finger),
                     missing.count, static_cast<double>(missing.first) / repair.ticks_per_s,
                     static_cast<double>(missing.last) / repair.ticks_per_s, missing.first, missing.last);
}

std::string textOf(const std::filesystem::path& out, const trace::SessionRepair& repair) {
  std::string text =
      fmt::format("{}: {} samples in {} blocks, {} events, {} worlds, {} attachments salvaged\n", out.string(),
                  repair.samples, repair.blocks, repair.events, repair.worlds, repair.attachments);
  if (repair.nothingLost()) text += "  nothing was lost\n";
  if (repair.blocks_lost > 0) {
    text += fmt::format("  lost  {} blocks, {} samples that are known by their time\n", repair.blocks_lost,
                        repair.samplesLost());
  }
  for (const trace::MissingTicks& lost : repair.lost) text += "  lost  " + textOf(repair, lost) + "\n";
  if (repair.bytes_missing > 0) text += fmt::format("  lost  {} bytes at the file's end\n", repair.bytes_missing);
  if (repair.header_lost) text += "  lost  the header: when it began, its rate (taken as 1000 a second), notes\n";
  for (const std::string& other : repair.other) text += "  lost  " + other + "\n";
  for (const std::string& note : repair.notes) text += "  note  " + note + "\n";
  for (const trace::MissingTicks& gap : repair.gaps) text += "  gap   never recorded: " + textOf(repair, gap) + "\n";
  return text;
}

Json jsonOf(const trace::SessionRepair& repair, const std::vector<trace::MissingTicks>& missing) {
  Json list = Json::array();
  for (const trace::MissingTicks& one : missing) {
    list.push_back({{"finger", repair.fingers.at(one.finger)},
                    {"first_tick", one.first},
                    {"last_tick", one.last},
                    {"samples", one.count}});
  }
  return list;
}

Json jsonOf(const std::filesystem::path& out, const trace::SessionRepair& repair) {
  return {{"file", out.string()},
          {"nothing_lost", repair.nothingLost()},
          {"samples", repair.samples},
          {"blocks", repair.blocks},
          {"events", repair.events},
          {"worlds", repair.worlds},
          {"attachments", repair.attachments},
          {"samples_lost", repair.samplesLost()},
          {"blocks_lost", repair.blocks_lost},
          {"lost", jsonOf(repair, repair.lost)},
          {"bytes_missing", repair.bytes_missing},
          {"header_lost", repair.header_lost},
          {"other_lost", repair.other},
          {"gaps", jsonOf(repair, repair.gaps)},
          {"notes", repair.notes}};
}

}  // namespace

bool isOrWasSession(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  return isSessionFile(file) || name.ends_with(".session") || name.find(".session.") != std::string::npos;
}

void salvageSession(const std::filesystem::path& file, const std::filesystem::path& out, bool json) {
  ProgressLine progress;
  const trace::SessionRepair repair = trace::repairSession(file, out, progress.callback());
  progress.clear();
  printReadable(json ? jsonText(jsonOf(out, repair)) : textOf(out, repair));
}

}  // namespace palpate::app
