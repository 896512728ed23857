// `palpate info MESH`: what a mesh file holds and what is wrong with it.
#include <fmt/format.h>

#include <memory>

#include "apps/palpate/common/commands.h"
#include "apps/palpate/common/mesh_arguments.h"
#include "apps/palpate/common/progress_line.h"
#include "apps/palpate/model/mesh_report.h"

namespace palpate::app {

namespace {

struct InfoArguments {
  MeshArguments mesh;
  bool quick = false;
  bool json = false;
};

mesh::ValidationReport inspect(const InfoArguments& arguments) {
  ProgressLine progress;
  mesh::LoadOptions options = arguments.mesh.options;
  options.keep_wrong_indices = true;  // to be counted, not refused
  const mesh::TriangleMesh surface = mesh::load(arguments.mesh.file, options, progress.callback());
  return mesh::validate(surface, {.self_intersections = !arguments.quick}, progress.callback());
}

void runInfo(const InfoArguments& arguments) {
  const mesh::ValidationReport report = inspect(arguments);
  if (arguments.json) {
    nlohmann::ordered_json json = {{"file", arguments.mesh.file}};
    json.update(jsonOf(report));
    fmt::print("{}\n", json.dump(2));
  } else {
    fmt::print("{}", textOf(report));
  }
}

}  // namespace

void addInfoCommand(CLI::App& app) {
  auto arguments = std::make_shared<InfoArguments>();
  CLI::App& command = *app.add_subcommand("info", "Report what a mesh file holds and what is wrong with it");
  addMeshArguments(command, arguments->mesh);
  command.add_flag("--no-self-intersections", arguments->quick,
                   "Do not look for self-intersections (the slowest check)");
  command.add_flag("--json", arguments->json, "Print one JSON object");
  command.callback([arguments] { runInfo(*arguments); });
}

}  // namespace palpate::app
