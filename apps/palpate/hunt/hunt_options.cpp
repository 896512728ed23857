#include "apps/palpate/hunt/hunt_options.h"

#include <fmt/format.h>

#include <cmath>

#include "apps/palpate/common/named_mesh.h"
#include "apps/palpate/common/progress_line.h"
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
    say(fmt::format("palpate: {}: {:.3g} mm across, taken {:.6g} times as large (--fit-mm, --unit-mm)\n", body.name,
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
  command.add_option("--unit-mm", a.unit_mm, "Millimetres per unit of the files; 0: as the format says")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1e9));
  command.add_option("--group", a.group, "Only this group or object of OBJ files");
  command
      .add_option(
          "--fit-mm", a.fit_mm,
          "Scale each file's body to this diagonal (mm); 0: never; left out: to 400 mm where it is below 20 mm or "
          "above 10 m")
      ->check(CLI::Range(0.0, 1e9));
  command.add_flag("--generated", a.generated, "Generated bodies too, beside --mesh");
  command.add_option("--bodies", a.bodies, "Generated bodies; 0: one for every 20,000 ticks")->capture_default_str();
  command.add_option("--scale", a.scale, "Everything so many times as large: bodies, paths and fingers")
      ->capture_default_str()
      ->check(CLI::Range(1e-6, 1e6));
}

}  // namespace

void addHuntOptions(CLI::App& command, HuntArguments& a) {
  CLI::Option* ticks = command.add_option("--ticks", a.ticks, "Ticks (of 1 ms) to hunt for")
                           ->capture_default_str()
                           ->check(CLI::Range(std::size_t{1}, std::size_t{1} << 40));
  command.add_option("--seconds", a.seconds, "Hunt for so long (s, by the clock) instead of --ticks")
      ->check(CLI::Range(1e-3, 1e7))
      ->excludes(ticks);
  command.add_option("--seed", a.seed, "Of bodies and paths: the same seed gives the same hunt")->capture_default_str();
  command.add_option("--radius-mm", a.radii_mm, "Radius of the finger (mm), repeatable; left out: 0, 0.5, 2, 5 and 8")
      ->check(CLI::Range(0.0, 1000.0));
  addBodyOptions(command, a);
  command.add_option("--threads", a.threads, "Threads; 0: as many as there are processors")
      ->capture_default_str()
      ->check(CLI::Range(0, 1024));
  command.add_option("--out", a.out,
                     "Folder for failing cases, made short: body.ply, path.csv, scene.toml (palpate simulate runs it), "
                     "note.txt");
  command.add_option("--keep", a.keep, "Cases that are written of each fault")->capture_default_str();
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
