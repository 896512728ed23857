// A preset is the text of a file of scenes/ and, for the printed reading of it, every switch of fidelity.
#include "cli/kit/presets.h"

#include <algorithm>
#include <array>

#include "cli/kit/choice_option.h"
#include "cli/kit/cli11.h"
#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/scene/scene_file.h"

namespace palpate::app {

namespace {

struct Preset {
  const char* name;
  std::string_view (*text)();
  const char* file;
  bool as_printed;
};

constexpr std::array<Preset, 2> kPresets{{
    {"vhb", virtualHapticBack, "virtual_haptic_back.toml", false},
    {"vhb-literal", virtualHapticBack, "virtual_haptic_back.toml", true},
}};

}  // namespace

std::vector<std::string> presetNames() {
  std::vector<std::string> names;
  for (const Preset& preset : kPresets) names.emplace_back(preset.name);
  return names;
}

void addPresetOption(CLI::App& command, std::string& preset) {
  takesOneOf(presetNames(),
             command.add_option("--preset", preset,
                                "Built-in scene by name: vhb is the dissertation's Virtual Haptic Back "
                                "(docs/reference/dissertation.md), vhb-literal the same with its formulae as printed"));
}

scene::Scene presetScene(const std::string& name) {
  const auto preset = std::ranges::find(kPresets, name, &Preset::name);
  if (preset == kPresets.end()) throw Error(unknownName("preset", name, "--preset", presetNames()));
  scene::Scene scene = scene::parse(preset->text(), preset->file);
  scene.file.clear();  // of no file: there is none that it could be saved to
  if (preset->as_printed) {
    scene.fidelity.setAll(true);
    scene.title += ", as printed";
  }
  return scene;
}

}  // namespace palpate::app
