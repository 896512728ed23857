// `palpate bench deform`: how long the deformation of the skin takes.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "apps/palpate/commands.h"
#include "bench/deform_run.h"

namespace palpate::app {
namespace {

nlohmann::ordered_json jsonOf(const bench::DeformFigures& f) {
  nlohmann::ordered_json json;
  json["triangles"] = f.triangles;
  json["vertices"] = f.vertices;
  json["ns_per_vertex"] = f.ns_per_vertex;
  json["region_ns_per_vertex"] = f.region_ns_per_vertex;
  json["copy_floor_ns_per_vertex"] = f.copy_floor_ns_per_vertex;
  json["ratio_to_copy_floor"] = f.ratio_to_copy_floor;
  json["allocations"] = f.allocations ? nlohmann::ordered_json(*f.allocations) : nlohmann::ordered_json(nullptr);
  return json;
}

std::string textOf(const bench::DeformFigures& f) {
  std::string text = fmt::format("triangles             {}\nvertices moved        {:.0f}\n", f.triangles, f.vertices);
  text += fmt::format("whole apply           {:.3f} ns/vertex, {:.1f} us\n", f.ns_per_vertex,
                      f.ns_per_vertex * f.vertices * 1e-3);
  text += fmt::format("of it region search   {:.3f} ns/vertex\n", f.region_ns_per_vertex);
  text += fmt::format("copying 24 B/vertex   {:.3f} ns/vertex, ratio {:.1f}\n", f.copy_floor_ns_per_vertex,
                      f.ratio_to_copy_floor);
  return text +
         fmt::format("heap allocations      {}\n", f.allocations ? fmt::to_string(*f.allocations) : "not counted");
}

}  // namespace

void addBenchDeformCommand(CLI::App& parent) {
  struct Arguments {
    bench::DeformRun run;
    bool json = false;
  };
  auto arguments = std::make_shared<Arguments>();
  bench::DeformRun& run = arguments->run;
  CLI::App& command = *parent.add_subcommand("deform", "Time the deformation of the benchmark's back under one finger");
  command.add_option("--triangles", run.triangles, "Triangles of the back")
      ->capture_default_str()
      ->check(CLI::Range(8, 20000000));
  const auto number = [&](const char* name, double& value, const char* help, double low, double high) {
    command.add_option(name, value, help)->capture_default_str()->check(CLI::Range(low, high));
  };
  number("--half-major-mm", run.half_major_mm, "Half major axis of the regions (mm)", 0.001, 1000.0);
  number("--aspect", run.aspect, "Minor over major axis", 0.01, 1.0);
  number("--depth-mm", run.depth_mm, "Depth of the finger (mm)", 0.0, 100.0);
  number("--drag-mm", run.drag_mm, "Drag of the skin along x (mm); 0 presses only", 0.0, 100.0);
  number("--seconds", run.seconds, "How long to repeat (s); the best round counts", 0.0, 600.0);
  command.add_flag("--recompute-normals", run.recompute, "Recomputed instead of analytic normals");
  command.add_flag("--incremental-normals", run.incremental, "Normals from the list of changed triangles");
  command.add_flag("--strain", run.strain, "Also write the strain");
  command.add_flag("--principal-strain", run.principal, "Also write the principal strain");
  command.add_flag("--general", run.general, "The deformer of every form, even where the fast one would do");
  command.add_flag("--json", arguments->json, "Print one JSON object");
  command.callback([arguments] {
    const auto figures = bench::measureDeform(arguments->run);
    fmt::print("{}", arguments->json ? jsonOf(figures).dump(2) + "\n" : textOf(figures));
  });
}

}  // namespace palpate::app
