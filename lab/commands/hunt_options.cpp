#include "lab/commands/hunt_options.h"

#include <fmt/format.h>

#include <cmath>

#include "cli/kit/number_option.h"
#include "cli/kit/progress_line.h"
#include "cli/kit/unit_option.h"
#include "lab/commands/named_mesh.h"
#include "palpate/base/error.h"

namespace palpate::app {

namespace {

/// A file whose body is smaller or larger than a finger can make sense of is brought to the size of a torso's half.
constexpr double kLeastDiagonalMm = 20.0, kMostDiagonalMm = 10000.0, kFittedDiagonalMm = 400.0;

/// `fit_mm` below 0: only where the size makes no sense. 0: never.
void fit(lab::NamedBody& body, double fit_mm) {
  const double diagonal = mesh::boundingBox(body.mesh).diagonal().norm();
  if (!std::isfinite(diagonal) || !(diagonal > 0.0) || fit_mm == 0.0) return;
  if (fit_mm < 0.0 && diagonal >= kLeastDiagonalMm && diagonal <= kMostDiagonalMm) return;
  const double factor = (fit_mm > 0.0 ? fit_mm : kFittedDiagonalMm) / diagonal;
  for (Vec3& p : body.mesh.positions) p *= factor;
  if (fit_mm < 0.0)
    say(fmt::format("palpate: {}: {:.3g} mm across, taken {:.6g} times as large (--fit-mm, --unit)\n", body.name,
                    diagonal, factor));
}

lab::NamedBody outsideBody(const std::string& name, const HuntArguments& arguments, const Progress& progress) {
  mesh::LoadOptions options;
  options.unit_mm = arguments.unit_mm;
  options.group = arguments.group;
  options.keep_wrong_indices = true;
  lab::NamedBody body{name, meshFrom(name, options, progress)};
  fit(body, arguments.fit_mm);
  return body;
}

void addBodyOptions(CLI::App& command, HuntArguments& a) {
  command.add_option(
      "--mesh", a.meshes,
      "Body from outside, repeatable; alone, or with --generated beside the others. " + std::string(kMeshNamesHelp));
  addUnit(command, a.unit_mm);
  command.add_option("--group", a.group, "Only this group or object of OBJ files");
  addNumber(command, "--fit-mm", a.fit_mm, between(0.0, 1e9, "mm"),
            "Scale each file's body to this diagonal; 0: never; left out: to 400 mm where it is below 20 mm or above "
            "10 m");
  command.add_flag("--generated", a.generated, "Generated bodies too, beside --mesh");
  addNumber(command, "--bodies", a.bodies, between(0, 1e9), "Generated bodies; 0: one for every 20,000 ticks")
      ->capture_default_str();
  addNumber(command, "--scale", a.scale, between(1e-6, 1e6),
            "Everything so many times as large: bodies, paths and fingers")
      ->capture_default_str();
}

}  // namespace

void addHuntOptions(CLI::App& command, HuntArguments& a) {
  CLI::Option* ticks =
      addNumber(command, "--ticks", a.ticks, between(1, 1e12), "Ticks (of 1 ms) to hunt for")->capture_default_str();
  addNumber(command, "--seconds", a.seconds, between(1e-3, 1e7, "s"),
            "Hunt for so long, by the clock, instead of --ticks")
      ->excludes(ticks);
  addNumber(command, "--seed", a.seed, {{0.0}}, "Of bodies and paths: the same seed gives the same hunt")
      ->capture_default_str();
  addNumber(command, "--radius-mm", a.radii_mm, between(0.0, 1000.0, "mm"),
            "Radius of the finger, repeatable; left out: 0, 0.5, 2, 5 and 8");
  addBodyOptions(command, a);
  addNumber(command, "--threads", a.threads, between(0, 1024), "Threads; 0: as many as there are processors")
      ->capture_default_str();
  command.add_option("-o,--out", a.out,
                     "Folder for failing cases, made short: body.ply, path.csv, scene.toml (palpate simulate runs it), "
                     "note.txt");
  addNumber(command, "--keep", a.keep, between(0, 1e6), "Cases that are written of each fault")->capture_default_str();
  command.add_option("--replay", a.replay, "Judge a written case again instead of hunting, repeatable")
      ->excludes("--mesh");
  command.add_flag("--json", a.json, "Print one JSON object");
}

lab::HuntPlan planOf(const HuntArguments& arguments, const Progress& progress) {
  lab::HuntPlan plan;
  plan.ticks = arguments.ticks;
  if (arguments.seconds > 0.0) plan.seconds = arguments.seconds;
  plan.seed = arguments.seed;
  if (!arguments.radii_mm.empty()) plan.radii_mm = arguments.radii_mm;
  for (const std::string& name : arguments.meshes) plan.meshes.push_back(outsideBody(name, arguments, progress));
  plan.generated = arguments.generated || arguments.meshes.empty();
  plan.bodies = arguments.bodies;
  plan.scale = arguments.scale;
  plan.threads = arguments.threads;
  return plan;
}

}  // namespace palpate::app
