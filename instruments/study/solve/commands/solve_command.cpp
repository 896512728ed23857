// `palpate tissue solve`: layers over bone pressed and dragged by finite elements, written as a table.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/kit/interruption.h"
#include "cli/kit/json.h"
#include "cli/kit/number_option.h"
#include "cli/kit/output_place.h"
#include "cli/kit/progress_line.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/text.h"
#include "palpate/elements/finger_solver.h"
#include "palpate/elements/stack_solver.h"
#include "report/charts/picture_file.h"
#include "solve/commands/commands.h"
#include "solve/commands/layered_figure.h"

namespace palpate::app {

namespace {

struct SolveArguments {
  std::vector<std::string> layers;
  double poisson = 0.48;
  double indenter_radius_mm = 8.0;
  std::string depths = "2:10:2";
  double fineness = 1.0;
  double bone_radius_mm = 0.0;
  bool flat_bone = false;
  double contact_kpa_per_mm = 1500.0;
  bool no_drag = false;
  bool fingers = false;
  bool field = false;
  std::string lump;
  std::string output;
  std::string plot;
  bool json = false;
};

/// "1:10:1" (from, to, step) or "2,5,7.5".
std::vector<double> depthsFrom(const std::string& words) {
  const Limits limits = above(0.0, 500.0, "mm");
  if (words.find(':') == std::string::npos) return numbersFrom("--depths", words, limits);
  std::string with_commas = words;
  std::ranges::replace(with_commas, ':', ',');
  const std::vector<double> three = numbersFrom("--depths", with_commas, limits);
  if (three.size() != 3) throw Error(fmt::format("--depths {}: a range is FROM:TO:STEP, as in 1:10:1", words));
  constexpr double kMax = 200.0;
  const double steps = std::floor((three[1] - three[0]) / three[2] + 1e-9);
  if (!(steps >= 0.0 && steps < kMax)) {
    throw Error(fmt::format("--depths {}: it must hold 1 to {:g} depths", words, kMax));
  }
  std::vector<double> depths;
  for (int i = 0; i <= static_cast<int>(steps); ++i) depths.push_back(three[0] + i * three[2]);
  return depths;
}

tissue::LayerStack stackFrom(const SolveArguments& arguments) {
  tissue::LayerStack stack;
  for (const std::string& layer : arguments.layers) stack.layers.push_back(tissue::parseLayer(layer));
  stack.poisson = arguments.poisson;
  return stack;
}

/// "10mm:6mm:60kPa", "12x6mm:6mm:60kPa:0.5": diameter (across x into the body), depth of its top, modulus, softness of
/// its edge.
elements::Inclusion lumpFrom(const std::string& words) {
  const std::vector<std::string_view> parts = split(words, ':');
  const bool soft = parts.size() == 4;
  elements::Inclusion lump;
  if (parts.size() == 3 || soft) {
    const std::size_t by = parts[0].find('x');
    const auto across =
        by == std::string_view::npos ? tissue::parseMillimetres(parts[0]) : parseNumber(parts[0].substr(0, by));
    const auto into = by == std::string_view::npos ? across : tissue::parseMillimetres(parts[0].substr(by + 1));
    const auto depth = tissue::parseMillimetres(parts[1]);
    lump.young_kpa = tissue::parseKilopascals(parts[2]);
    const auto edge = soft ? parseNumber(parts[3]) : std::optional(0.0);
    if (across && into && depth && lump.young_kpa && edge) {
      lump.across_mm = 0.5 * *across;
      lump.into_mm = 0.5 * *into;
      lump.top_mm = *depth;
      lump.edge = *edge;
      return lump;
    }
  }
  throw Error(fmt::format("--lump {}: a lump is DIAMETER:DEPTH:MODULUS, such as 10mm:6mm:60kPa", oneLine(words)));
}

Json toJson(const elements::StackSolution& solution) {
  const elements::PressSolution& press = solution.press;
  Json json = {{"seconds", solution.seconds}};
  for (const char* key : {"depths", "force_n", "surface_mm", "contact_radius_mm"}) {
    json[key] = Json::array();
  }
  for (const tissue::PressedShape& shape : press.table.shapes) {
    json["depths"].push_back(shape.depth_mm);
    json["force_n"].push_back(shape.force_n);
    json["surface_mm"].push_back(shape.surface_mm);
    json["contact_radius_mm"].push_back(shape.contact_radius_mm);
  }
  json["converged_to_mm"] = press.converged_to_mm;
  json["stopped_by"] = press.stopped_by.empty() ? Json(nullptr) : Json(press.stopped_by);
  json["press_seconds"] = press.seconds;
  json["systems"] = 0;
  for (const elements::PressStep& step : press.path) json["systems"] = json["systems"].get<int>() + step.systems;
  json["stored_mj"] = press.path.empty() ? 0.0 : press.path.back().energy_mj;
  json["work_mj"] = press.work_mj;
  json["fingers"] = Json::array();
  for (const tissue::FingerForces& finger : press.table.fingers) {
    json["fingers"].push_back(
        {{"radius_mm", finger.radius_mm}, {"depths", finger.depths_mm}, {"force_n", finger.force_n}});
  }
  json["pressure_kpa"] = press.ring_pressures_kpa;
  json["field"] = nullptr;
  if (press.table.field) {
    const tissue::PressField& field = *press.table.field;
    json["field"] = {{"radii", field.radii_mm.size()},
                     {"rows", field.rows_mm.size()},
                     {"depths", field.depths_mm},
                     {"contact_radius_mm", Json::array()},
                     {"pressure_exponent", Json::array()}};
    for (const tissue::PressurePattern& pattern : field.patterns) {
      json["field"]["contact_radius_mm"].push_back(pattern.contact_radius_mm);
      json["field"]["pressure_exponent"].push_back(pattern.exponent);
    }
  }
  json["drag"] = nullptr;
  if (press.table.drag) {
    const tissue::DragShape& drag = *press.table.drag;
    json["drag"] = {{"exponent", drag.exponent},
                    {"along_mm", drag.along_mm},
                    {"across_mm", drag.across_mm},
                    {"fit_rms", solution.drag_rms},
                    {"tangential_over_normal", drag.tangential_over_normal},
                    {"tangential_n_per_mm", solution.drag_n_per_mm},
                    {"normal_n_per_mm", solution.press_n_per_mm}};
  }
  return json;
}

std::string textOf(const elements::StackSolution& solution) {
  const elements::PressSolution& press = solution.press;
  std::string text = fmt::format("{:>9}  {:>9}  {:>9}  {:>12}\n", "depth mm", "force N", "skin mm", "touches mm");
  for (const tissue::PressedShape& shape : press.table.shapes) {
    text += fmt::format("{:9.4g}  {:9.4f}  {:9.3f}  {:12.2f}\n", shape.depth_mm, shape.force_n, shape.surface_mm,
                        shape.contact_radius_mm);
  }
  if (press.table.drag) {
    const tissue::DragShape& drag = *press.table.drag;
    text += fmt::format(
        "drag      (1 + q^2)^-{:.3f}, {:.1f} mm along and {:.1f} mm across, {:.1f} % RMS from what was solved; {:.2f} "
        "of the stiffness of a press\n",
        drag.exponent, drag.along_mm, drag.across_mm, 100.0 * solution.drag_rms, drag.tangential_over_normal);
  }
  for (const tissue::FingerForces& finger : press.table.fingers) {
    text += fmt::format("finger of {:g} mm: {:.3f} N at {:.4g} mm\n", finger.radius_mm, finger.force_n.back(),
                        finger.depths_mm.back());
  }
  if (press.table.field) {
    const tissue::PressField& field = *press.table.field;
    text += fmt::format("field     {} radii, {} rows, {} presses from {:g} to {:g} mm\n", field.radii_mm.size(),
                        field.rows_mm.size(), field.depths_mm.size(), field.depths_mm.front(), field.depths_mm.back());
  }
  text += fmt::format("solved to {:.4g} mm in {:.1f} s\n", press.converged_to_mm, solution.seconds);
  return text;
}

void writeResults(const SolveArguments& arguments, const elements::StackSolution& solution) {
  const tissue::LayeredTable& table = solution.press.table;
  if (!arguments.output.empty()) writeLayeredTable(arguments.output, table);
  if (arguments.plot.empty()) return;
  const std::vector<NamedTable> tables = {{"solved", table}};
  LayeredFigureSettings settings;
  settings.title = "layers over bone under a press";
  writePicture(layeredFigure(tables, settings), arguments.plot);
}

void runSolve(const SolveArguments& arguments) {
  if (!arguments.plot.empty()) checkPictureName(arguments.plot);
  const tissue::LayerStack stack = stackFrom(arguments);
  elements::StackSettings settings;
  settings.press = elements::settingsOf(arguments.indenter_radius_mm, depthsFrom(arguments.depths));
  settings.press.fineness = arguments.fineness;
  settings.press.bone_radius_mm = arguments.bone_radius_mm;
  settings.press.bone_flat_top = arguments.flat_bone;
  settings.press.contact_kpa_per_mm = arguments.contact_kpa_per_mm;
  if (arguments.no_drag || !arguments.lump.empty()) settings.drag.reset();
  if (arguments.field) settings.press.field_depths_mm = elements::fieldDepths(settings.press.depths_mm.back());
  if (!arguments.lump.empty()) settings.press.lump = lumpFrom(arguments.lump);

  const FinishesInOrder in_order;
  ProgressLine progress;
  const auto stop = [] { return endingSignal() != 0; };
  elements::StackSolution solution = elements::solveStack(stack, settings, progress.display(), stop);
  if (arguments.fingers && !stop()) {
    solution.press.table.fingers = elements::solveFingers(stack, settings.press, progress.display(), stop);
  }
  progress.clear();
  const elements::PressSolution& press = solution.press;
  if (!press.table.shapes.empty()) writeResults(arguments, solution);
  fmt::print("{}", arguments.json ? jsonDump(toJson(solution), 2) + "\n" : textOf(solution));
  if (press.stopped_by.empty()) return;
  say(fmt::format("palpate: solved to {:.4g} of {:.4g} mm: {}\n", press.converged_to_mm,
                  settings.press.depths_mm.back(), press.stopped_by));
  throw ExitWith(1);
}

}  // namespace

void addTissueSolveCommand(Command& parent) {
  const auto [command, a] = addCommand(parent, "solve",
                                       "Press a sphere into layers over bone and drag their skin (finite elements); "
                                       "exit code 1: the table ends above the requested depth",
                                       runSolve);
  command
      .add_option("--layer", a.layers,
                  "NAME:THICKNESS:MODULUS, as in skin:2mm:150kPa; repeat it from the skin down to the bone")
      ->required()
      ->allow_extra_args(false);
  addSetting(command, "--poisson", a.poisson, between(0.0, 0.499), "Poisson's ratio of every layer");
  addSetting(command, "--indenter-radius-mm", a.indenter_radius_mm, between(0.5, 100.0, "mm"),
             "Radius of the rigid sphere");
  command.add_option("--depths", a.depths, "Depths to write (mm): FROM:TO:STEP or a list with commas")
      ->capture_default_str();
  addSetting(command, "--fineness", a.fineness, between(0.5, 4.0),
             "Fineness of the mesh; 2 halves the size of elements");
  Option* bone_radius =
      addSetting(command, "--bone-radius-mm", a.bone_radius_mm, between(0.0, 100.0, "mm"),
                 "Radius of the bone: 0 for a plane, otherwise a post with a round top within the deepest layer");
  command.add_flag("--flat-bone", a.flat_bone, "Make the top of the post flat")->needs(bone_radius);
  addSetting(command, "--contact-kpa-per-mm", a.contact_kpa_per_mm, between(100.0, 1e6),
             "Stiffness of the springs that model a rigid sphere");
  command.add_flag("--no-drag", a.no_drag, "Solve only the press");
  command.add_flag("--fingers", a.fingers,
                   "Also press spheres of 1 to 24 mm (about 20 s), so that a scene uses the table's own forces for a "
                   "finger's radius instead of the shipped ratio");
  Option& field = *command.add_flag(
      "--field", a.field,
      "Also write the strain energy under each press, down to the deepest of --depths; lumps need it");
  command
      .add_option("--lump", a.lump,
                  "Press over a lump, without drag and field: DIAMETER:DEPTH:MODULUS with the depth of its top, such "
                  "as 10mm:6mm:60kPa, or 12x6mm:6mm:60kPa for a flat one; a fourth part, 0 (sharp, default) to 1, "
                  "softens its edge")
      ->excludes(&field);
  namesFileToWrite(command.add_option("-o,--out", a.output, "Table to write (JSON)"));
  command.add_option("--plot", a.plot, "Picture to write: .png or .svg");
  command.add_flag("--json", a.json, "Print one JSON object");
}

}  // namespace palpate::app
