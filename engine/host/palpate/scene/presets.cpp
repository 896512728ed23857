#include "palpate/scene/presets.h"

#include <algorithm>
#include <array>

#include "palpate/base/error.h"
#include "palpate/base/language.h"
#include "palpate/base/nearest_name.h"
#include "palpate/scene/scene_file.h"

namespace palpate::scene {

namespace {

// clang-format off
constexpr std::array<Preset, 20> kPresets{{
    {"vhb", toTranslate("Virtual Haptic Back"), toTranslate("The dissertation's model of 2008: 2,962 triangles over its bones."), "virtual_haptic_back"},
    {"trunk", toTranslate("Built-in body"), toTranslate("A trunk in layers of skin, fat and muscle, with a stiff place to find."), "default"},
    {"dysfunctions", toTranslate("Hidden dysfunctions"), toTranslate("Find two stiff places and a soft one; key M shows them."), "dysfunctions"},
    {"lumps", toTranslate("Hidden lumps"), toTranslate("Find three lumps by touch; one of them slips away."), "lumps"},
    {"anatomy", toTranslate("Bones and names"), toTranslate("The structures under the skin and their names."), "anatomy"},
    {"thin", toTranslate("Thin person"), toTranslate("Ribs and spine can be felt just under the skin."), "thin"},
    {"heavy", toTranslate("Heavy person"), toTranslate("Soft fat that yields far; bones are deep."), "heavy"},
    {"prone", toTranslate("Prone on a table"), toTranslate("As seen by an examiner beside the table."), "prone"},
    {"sitting", toTranslate("Sitting"), toTranslate("A rounded back."), "sitting"},
    {"two-fingers", toTranslate("Two fingers"), toTranslate("Both sides of the spine at once; F7 plays them."), "two_fingers"},
    {"two-devices", toTranslate("Two devices"), toTranslate("Two simulated devices, each pushed with 1 N; yours can take their place."), "two_devices"},
    {"scan", toTranslate("Scan with a hole"), toTranslate("A raw scan of a back: rough, open, a piece missing."), "scan"},
    {"strain", toTranslate("Strain colours"), toTranslate("Where the skin is stretched and where compressed."), "strain_colours"},
    {"oiled", toTranslate("Oiled skin"), toTranslate("The finger slips where it would otherwise stick."), "oiled_skin"},
    {"relaxation", toTranslate("Relaxation"), toTranslate("Hold a press: the force falls with time."), "relaxation"},
    {"breathing", toTranslate("Breathing"), toTranslate("The back moves under the finger."), "breathing"},
    {"stereo", toTranslate("Stereo"), toTranslate("For red and cyan glasses."), "stereo"},
    {"detecting-box", toTranslate("Detecting box"), toTranslate("The dissertation's search: octree and haptic detecting box."), "dissertation_contact"},
    {"fine-mesh", toTranslate("Fine mesh"), toTranslate("600,000 triangles at the same rate."), "fine_mesh"},
    {"vhb-literal", toTranslate("Virtual Haptic Back, literal"), toTranslate("The formulae as printed, with their errors."), "virtual_haptic_back", true},
}};
// clang-format on

Scene parsePreset(std::string_view file) {
  Scene scene = parse(presetText(file), std::string(file) + ".toml");
  scene.file.clear();
  return scene;
}

}  // namespace

std::span<const Preset> presets() { return kPresets; }

std::vector<std::string> presetNames() {
  std::vector<std::string> names;
  for (const Preset& preset : kPresets) names.emplace_back(preset.name);
  return names;
}

const Preset& presetNamed(std::string_view name) {
  const auto preset = std::ranges::find(kPresets, name, &Preset::name);
  if (preset == kPresets.end()) throw Error(unknownName("preset", std::string(name), "--preset", presetNames()));
  return *preset;
}

Scene presetScene(std::string_view name) {
  const Preset& preset = presetNamed(name);
  Scene scene = parsePreset(preset.file);
  if (preset.as_printed) {
    scene.fidelity.setAll(true);
    scene.title += ", as printed";
  }
  return scene;
}

Scene standardScene() { return parsePreset("default"); }

}  // namespace palpate::scene
