#include "cli/kit/mesh_arguments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/kit/choice_option.h"
#include "cli/kit/number_option.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/text.h"
#include "palpate/scene/presets.h"
#include "palpate/scene/words.h"

namespace palpate::app {

void addMeshArguments(Command& command, MeshArguments& arguments) {
  command.add_option("mesh", arguments.file, "Mesh file: obj, stl, ply, off, gltf or glb")->required();
  addUnit(command, arguments.options.unit_mm);
  command.add_option("--group", arguments.options.group, "Use only this group or object of an OBJ file");
  command.add_flag("--foreign", arguments.options.allow_foreign,
                   "Read other formats (3mf, dae, fbx, ...) through assimp; only for files you trust");
}

namespace {

constexpr const char* kUnitOption = "--unit";

double millimetresFrom(const std::string& word) {
  if (const auto unit = valueNamed<scene::Unit>(word)) return millimetresOf(*unit);
  if (parseNumber(word)) return numberFrom(kUnitOption, word, between(0.0, 1e9, "mm"));
  throw UsageError(kUnitOption, fmt::format("'{}' is not a unit; expected one of {}, or a number of millimetres",
                                            oneLine(word), fmt::join(enumNames<scene::Unit>(), ", ")));
}

}  // namespace

Option* addUnit(Command& command, double& unit_mm) {
  const auto read = [&unit_mm](const std::string& word) { unit_mm = millimetresFrom(word); };
  return command
      .add_option_function(
          kUnitOption, read,
          "Unit of the mesh file, or its length in mm, e.g. 25.4; auto: metres for gltf and glb, otherwise mm")
      ->type_name(fmt::format("{}|{}", fmt::join(enumNames<scene::Unit>(), "|"), kNumberType))
      ->default_str("auto");
}

void useUnit(double unit_mm, scene::BodySettings& body) {
  for (const auto& [word, unit] : WordsOf<scene::Unit>::kAll) {
    if (scene::millimetresOf(unit) != unit_mm) continue;
    body.unit = unit;
    return;
  }
  body.unit = scene::Unit::millimetre;
  body.scale *= unit_mm;
}

void addPresetOption(Command& command, std::string& preset) {
  restrictTo(
      scene::presetNames(),
      command.add_option(
          "--preset", preset,
          "Built-in scene by name: vhb is the dissertation's Virtual Haptic Back (docs/reference/dissertation.md), "
          "vhb-literal the same with the formulae as printed; the others are the window's examples"));
}

}  // namespace palpate::app
