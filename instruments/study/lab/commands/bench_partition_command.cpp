// `palpate study bench partition`: how long the haptic detecting box takes on a mesh.
#include <utility>
#include <vector>

#include "cli/kit/json.h"
#include "cli/kit/number_option.h"
#include "lab/commands/bench_arguments.h"
#include "lab/commands/bench_report.h"
#include "lab/commands/commands.h"
#include "lab/commands/peers_report.h"
#include "lab/peers/judge.h"
#include "lab/peers/peer.h"
#include "lab/runs/partition_run.h"

namespace palpate::app {
namespace {

struct BenchPartitionArguments {
  std::string mesh;
  bench::PartitionRun run;
  PeersOption peers;
};

Json toJson(const BenchPartitionArguments& arguments, const bench::PartitionFigures& f) {
  Json json;
  json["mesh"] = arguments.mesh;
  json["triangles"] = f.triangles;
  json["tree"] = wordFor(arguments.run.settings.tree);
  json["assign"] = wordFor(arguments.run.settings.assignment);
  json["threshold"] = arguments.run.settings.threshold;
  json["edge_mm"] = f.edge_mm;
  json["hdb_query_us"] = percentilesJson(f.hdb_query_us);
  json["ranges_us"] = percentilesJson(f.ranges_us);
  json["leaves_us"] = percentilesJson(f.leaves_us);
  json["mean_triangles"] = f.mean_triangles;
  json["mean_ranges"] = f.mean_ranges;
  json["mean_rendered"] = f.mean_rendered;
  json["hybrid_us_per_tick"] = f.hybrid_us_per_tick;
  json["hybrid_worst_us"] = f.hybrid_worst_us;
  json["hybrid_refreshes"] = f.hybrid_refreshes;
  json["linked_us_per_tick"] = f.linked_us_per_tick;
  json["linked_worst_us"] = f.linked_worst_us;
  json["linked_boxes"] = f.linked_boxes;
  json["bytes_per_triangle"] = f.bytes_per_triangle;
  json["build_ns_per_triangle"] = f.build_ns_per_triangle;
  json["allocations"] = orNull(f.allocations);
  json["hash"] = lab::hashText(f.hash);
  return json;
}

Json measurePartitions(const BenchPartitionArguments& arguments, ProgressLine& progress) {
  if (arguments.peers.wanted) handOverToPeersProgram(arguments.peers);
  const mesh::TriangleMesh mesh = meshFrom(arguments.mesh, {}, progress.callback());
  progress.show("measuring", 0.0);
  const bench::PartitionFigures figures = bench::measurePartition(mesh, arguments.run);
  Json json = toJson(arguments, figures);
  if (!arguments.peers.wanted) return json;
  const std::vector<Box3> boxes = bench::slidingBoxes(mesh, arguments.run);
  addPeers(json, bench::comparePeers(arguments.peers.peers, mesh, boxes, arguments.peers.seconds), PeerTask::boxes,
           figures.hdb_query_us.p50);
  return json;
}

void addPartitionOptions(Command& command, BenchPartitionArguments& arguments) {
  bench::PartitionRun& run = arguments.run;
  command.add_option("--mesh", arguments.mesh, kMeshNamesHelp)->required();
  addPartitionSettings(command, run.settings);
  addSetting(command, "--speed-mm-s", run.speed_mm_s, between(0.0, 1e6, "mm/s"), "Speed of the finger");
  addSetting(command, "--margin", run.margin, between(0.0, 10.0),
             "Margin of the coherent list, as a share of the box's edge");
  addSetting(command, "--ticks", run.ticks, between(1, 1e6), "Number of ticks of 1 ms to slide");
  addPeersOption(command, arguments.peers);
}

}  // namespace

void addBenchPartitionCommand(Command& parent, std::vector<bench::Peer> peers) {
  addBench(parent, "partition", "Time the haptic detecting box of a finger that slides", addPartitionOptions,
           measurePartitions)
      .peers.peers = std::move(peers);
}

void addBenchPartitionCommand(Command& parent) { addBenchPartitionCommand(parent, bench::peersWithoutLibraries()); }

}  // namespace palpate::app
