// `palpate tissue moduli`: published values for soft tissue and skin's friction, and the defaults.
#include <fmt/format.h>

#include <memory>
#include <string>

#include "palpate/base/json.h"
#include "palpate/base/number_range.h"
#include "palpate/tissue/published.h"
#include "solve/commands/commands.h"

namespace palpate::app {

namespace {

std::string formatRange(double low, double high) {
  return low == high ? readableNumber(low) : readableNumber(low) + " to " + readableNumber(high);
}

std::string formatSource(std::string_view source, std::string_view doubt) {
  std::string words(source);
  if (!doubt.empty()) words += (words.empty() ? "" : "; ") + std::string(doubt);
  return words;
}

std::string moduliText() {
  std::string text = fmt::format("{:<8} {:>14}  {}\n", "tissue", "kPa", "how: source");
  for (const tissue::PublishedModulus& modulus : tissue::publishedModuli()) {
    text += fmt::format("{:<8} {:>14} {} {}: {}\n", modulus.tissue, formatRange(modulus.low_kpa, modulus.high_kpa),
                        modulus.is_default ? "*" : " ", modulus.how, formatSource(modulus.source, modulus.doubt));
  }
  text += "\n* the default. Young's modulus at rest.\n";
  text += std::string(tissue::moduliCaveat()) + "\n";
  text += fmt::format("\n{:<18} {:>14}  {}\n", "friction", "coefficient", "how: source");
  for (const tissue::PublishedFriction& friction : tissue::publishedFriction()) {
    text += fmt::format("{:<18} {:>14}  {}: {}\n", friction.surface, formatRange(friction.low, friction.high),
                        friction.how, friction.source);
  }
  text += fmt::format("\n{:<18} {:>6} {:>9}  {}\n", "preset", "still", "slipping", "why");
  for (const tissue::FrictionPreset& preset : tissue::frictionPresets()) {
    text += fmt::format("{:<18} {:>6} {:>9}  {}\n", preset.name, preset.still, preset.slipping, preset.why);
  }
  return text;
}

Json moduliJson() {
  Json json;
  for (const tissue::PublishedModulus& modulus : tissue::publishedModuli()) {
    json["moduli"].push_back({{"tissue", modulus.tissue},
                              {"low_kpa", modulus.low_kpa},
                              {"high_kpa", modulus.high_kpa},
                              {"default", modulus.is_default},
                              {"how", modulus.how},
                              {"source", modulus.source},
                              {"doubt", modulus.doubt}});
  }
  for (const tissue::PublishedFriction& friction : tissue::publishedFriction()) {
    json["friction"].push_back({{"surface", friction.surface},
                                {"low", friction.low},
                                {"high", friction.high},
                                {"how", friction.how},
                                {"source", friction.source}});
  }
  for (const tissue::FrictionPreset& preset : tissue::frictionPresets()) {
    json["friction_presets"].push_back(
        {{"name", preset.name}, {"static", preset.still}, {"kinetic", preset.slipping}, {"why", preset.why}});
  }
  json["note"] = tissue::moduliCaveat();
  return json;
}

}  // namespace

void addTissueModuliCommand(Command& parent) {
  const auto json = std::make_shared<bool>(false);
  Command& command = *parent.add_subcommand("moduli", "List published stiffness and friction, with their sources");
  command.add_flag("--json", *json, "Print one JSON object");
  command.callback([json] { fmt::print("{}", *json ? jsonDump(moduliJson(), 2) + "\n" : moduliText()); });
}

}  // namespace palpate::app
