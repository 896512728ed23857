// `palpate study bench deform`: how long the deformation of the skin takes, here and as the dissertation has it.
#include <fmt/format.h>

#include <memory>

#include "cli/kit/json.h"
#include "cli/kit/number_option.h"
#include "lab/commands/bench_arguments.h"
#include "lab/commands/bench_report.h"
#include "lab/commands/commands.h"
#include "lab/runs/deform_run.h"
#include "palpate/base/json.h"

namespace palpate::app {
namespace {

void addTo(Json& json, const bench::ApplyFigures& f) {
  json["vertices"] = f.vertices;
  json["ns_per_vertex"] = f.ns_per_vertex;
  json["us_per_frame"] = f.us_per_frame;
  json["apply_us"] = percentilesJson(f.apply_us);
  json["hash"] = fmt::format("{:016x}", f.hash);
}

Json toJson(const bench::DeformFigures& f, const bench::DeformRun& run, bool peers) {
  Json json;
  json["triangles"] = f.triangles;
  json["fingers"] = run.fingers;
  addTo(json, f.ours);
  json["region_ns_per_vertex"] = f.region_ns_per_vertex;
  json["speedup_over_literal"] = orNull(f.speedup_over_literal);
  json["copy_floor_ns_per_vertex"] = f.copy_floor_ns_per_vertex;
  json["ratio_to_copy_floor"] = f.ratio_to_copy_floor;
  json["allocations"] = orNull(f.allocations);
  if (!peers || !f.literal) return json;
  addTo(json["peers"]["literal"], *f.literal);
  json["ratio_to"]["literal"] = f.ours.ns_per_vertex / f.literal->ns_per_vertex;
  return json;
}

std::string textOf(const char* who, const bench::ApplyFigures& f) {
  return fmt::format("{:<21} {:.3f} ns/vertex, {:.1f} us for {:.0f} vertices, {}, hash {:016x}\n", who, f.ns_per_vertex,
                     f.us_per_frame, f.vertices, percentilesText(f.apply_us), f.hash);
}

std::string textOf(const bench::DeformFigures& f, const bench::DeformRun& run, bool peers) {
  std::string text =
      fmt::format("triangles             {}, {} finger{}\n", f.triangles, run.fingers, run.fingers == 1 ? "" : "s");
  text += textOf("whole apply", f.ours);
  text += fmt::format("of it region search   {:.3f} ns/vertex\n", f.region_ns_per_vertex);
  text += fmt::format("copying 24 B/vertex   {:.3f} ns/vertex, ratio {:.1f}\n", f.copy_floor_ns_per_vertex,
                      f.ratio_to_copy_floor);
  if (peers && f.literal) text += textOf("literal dissertation", *f.literal);
  if (f.speedup_over_literal) text += fmt::format("speed-up over literal {:.1f}\n", *f.speedup_over_literal);
  return text + fmt::format("heap allocations      {}\n", countText(f.allocations));
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

}  // namespace

void addBenchDeformCommand(Command& parent) {
  struct Arguments {
    bench::DeformRun run;
    std::string mesh;
    bool peers = false;
    bool skip_literal = false;
    bool json = false;
  };
  auto arguments = std::make_shared<Arguments>();
  bench::DeformRun& run = arguments->run;
  Command& command = *parent.add_subcommand("deform", "Time the deformation of the benchmark's back under fingers");
  addNumbers(command, run);
  command.add_option("--mesh", arguments->mesh, std::string("Use instead of the back: ") + kMeshNamesHelp)
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
  command.add_flag("--peers", arguments->peers, "Also print the dissertation's own deformation, timed in the same run");
  command.add_flag("--skip-literal", arguments->skip_literal,
                   "Leave out the dissertation's deformation, which takes 500 bytes of memory per vertex");
  command.add_flag("--json", arguments->json, "Print one JSON object");
  command.callback([arguments] {
    arguments->run.literal = !arguments->skip_literal;
    if (!arguments->mesh.empty()) arguments->run.body = meshFrom(arguments->mesh);
    const auto figures = bench::measureDeform(arguments->run);
    printReport(toJson(figures, arguments->run, arguments->peers), textOf(figures, arguments->run, arguments->peers),
                arguments->json);
  });
}

}  // namespace palpate::app
