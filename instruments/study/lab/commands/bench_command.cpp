// `palpate study bench`: measures the engine on known meshes and trajectories; what each subcommand does is in a file
// of its own.
#include <fmt/format.h>

#include <memory>
#include <string>

#include "cli/kit/options.h"
#include "cli/kit/output_place.h"
#include "lab/commands/bench_arguments.h"
#include "lab/commands/bench_report.h"
#include "lab/commands/commands.h"
#include "lab/workloads/heldout_meshes.h"
#include "lab/workloads/workload_meshes.h"
#include "lab/workloads/workload_paths.h"
#include "palpate/mesh/files/save.h"

namespace palpate::app {
namespace {

/// Trajectories are written as .csv, meshes by the extension.
void writeWorkload(const std::string& name, const std::string& file) {
  if (file.ends_with(".csv")) {
    device::writeTrajectory(file, trajectoryFrom(name));
  } else {
    mesh::save(file, meshFrom(name));
  }
}

void addWorkloadCommand(Command& parent) {
  struct Arguments {
    std::string name, file;
  };
  auto arguments = std::make_shared<Arguments>();
  Command& command = *parent.add_subcommand("workload", "Write a benchmark mesh (.stl, .obj, .ply) or path (.csv)");
  command.add_option("name", arguments->name, "Name, as listed by `palpate study bench list`")->required();
  namesFileToWrite(command.add_option("-o,--out", arguments->file, "File to write"))->required();
  command.callback([arguments] { writeWorkload(arguments->name, arguments->file); });
}

void printNames() {
  fmt::print("meshes\n");
  for (const std::string& name : lab::workloadMeshNames()) fmt::print("  {}\n", name);
  fmt::print("held-out meshes\n");
  for (const std::string& name : lab::heldoutMeshNames()) fmt::print("  {}\n", name);
  fmt::print("trajectories (and the mesh each was made for)\n");
  for (const lab::PathName& name : lab::workloadPathNames()) fmt::print("  {:18} {}\n", name.path, name.mesh);
}

}  // namespace

void addBenchCommand(Command& study) {
  Command& bench = *study.add_subcommand(
      "bench",
      "Measure the finger, batches, lumps, deformation, edits, partitions, loading, servo loop, recordings, pictures");
  bench.require_subcommand(0, 1);  // none: the regression guard
  addBenchBaseline(bench);
  addBenchBatchCommand(bench);
  addBenchContactCommand(bench);
  addBenchDeformCommand(bench);
  addBenchEditCommand(bench);
  addBenchFrameCommand(bench);
  addBenchLoadCommand(bench);
  addBenchLumpCommand(bench);
  addBenchPartitionCommand(bench);
  addBenchServoCommand(bench);
  addBenchRecordingCommand(bench);
  addWorkloadCommand(bench);
  bench.add_subcommand("list", "List the benchmark meshes and trajectories")->callback(printNames);
}

}  // namespace palpate::app
