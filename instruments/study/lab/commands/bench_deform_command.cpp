// `palpate study bench deform`: how long the deformation of the skin takes, here and as the dissertation has it.
#include "cli/kit/json.h"
#include "cli/kit/number_option.h"
#include "lab/commands/bench_arguments.h"
#include "lab/commands/bench_report.h"
#include "lab/commands/commands.h"
#include "lab/runs/deform_run.h"

namespace palpate::app {
namespace {

void addTo(Json& json, const bench::ApplyFigures& f) {
  json["vertices"] = f.vertices;
  json["ns_per_vertex"] = f.ns_per_vertex;
  json["us_per_frame"] = f.us_per_frame;
  json["apply_us"] = percentilesJson(f.apply_us);
  json["hash"] = lab::hashText(f.hash);
}

struct DeformArguments {
  bench::DeformRun run;
  std::string mesh;
  bool peers = false;
  bool skip_literal = false;
};

Json measureDeformations(const DeformArguments& arguments, ProgressLine&) {
  bench::DeformRun run = arguments.run;
  run.literal = !arguments.skip_literal;
  if (!arguments.mesh.empty()) run.body = meshFrom(arguments.mesh);
  const bench::DeformFigures f = bench::measureDeform(run);
  Json json;
  json["triangles"] = f.triangles;
  json["fingers"] = run.fingers;
  addTo(json, f.ours);
  json["region_ns_per_vertex"] = f.region_ns_per_vertex;
  json["speedup_over_literal"] = orNull(f.speedup_over_literal);
  json["copy_floor_ns_per_vertex"] = f.copy_floor_ns_per_vertex;
  json["ratio_to_copy_floor"] = f.ratio_to_copy_floor;
  json["allocations"] = orNull(f.allocations);
  if (!arguments.peers || !f.literal) return json;
  addTo(json["peers"]["literal"], *f.literal);
  json["ratio_to"]["literal"] = f.ours.ns_per_vertex / f.literal->ns_per_vertex;
  return json;
}

void addNumbers(Command& command, bench::DeformRun& run) {
  const auto number = [&](const char* name, double& value, const char* help, double low, double high) {
    addSetting(command, name, value, between(low, high), help);
  };
  addSetting(command, "--triangles", run.triangles, between(8, 2e7), "Triangles of the back");
  addSetting(command, "--fingers", run.fingers, between(1, 8), "Number of fingers, 40 mm apart");
  number("--half-major-mm", run.half_major_mm, "Half major axis of the regions (mm)", 0.001, 1000.0);
  number("--aspect", run.aspect, "Minor over major axis", 0.01, 1.0);
  number("--depth-mm", run.depth_mm, "Depth of the fingers (mm)", 0.0, 100.0);
  number("--drag-mm", run.drag_mm, "Drag of the skin along x (mm); 0 presses only", 0.0, 100.0);
  number("--seconds", run.seconds, "How long to repeat (s); the best round counts", 0.0, 600.0);
}

void addDeformOptions(Command& command, DeformArguments& arguments) {
  bench::DeformRun& run = arguments.run;
  addNumbers(command, run);
  command.add_option("--mesh", arguments.mesh, std::string("Use instead of the back: ") + kMeshNamesHelp)
      ->excludes("--triangles");
  addPlace(command, "--at", run.at, "With --mesh: where the fingers wander, mm (default: around the highest place)")
      ->needs("--mesh");
  command.add_flag("--recompute-normals", run.recompute, "Recompute normals instead of computing them analytically");
  command.add_flag("--incremental-normals", run.incremental, "Compute normals from the list of changed triangles");
  command.add_flag("--strain", run.strain, "Also write the strain");
  command.add_flag("--principal-strain", run.principal, "Also write the principal strain");
  command.add_flag(
      "--layered", run.layered,
      "Use curves of layered tissue instead of the half Gaussian, with separate regions, 40 mm over the bone");
  command.add_flag("--general", run.general, "Use the general deformer even where the fast one would do");
  command.add_flag("--peers", arguments.peers, "Also print the dissertation's own deformation, timed in the same run");
  command.add_flag("--skip-literal", arguments.skip_literal,
                   "Leave out the dissertation's deformation, which takes 500 bytes of memory per vertex");
}

}  // namespace

void addBenchDeformCommand(Command& parent) {
  addBench(parent, "deform", "Time the deformation of the benchmark's back under fingers", addDeformOptions,
           measureDeformations);
}

}  // namespace palpate::app
