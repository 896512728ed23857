// `palpate study bench partition`: how long the haptic detecting box takes on a mesh.
#include <fmt/format.h>

#include <memory>
#include <utility>
#include <vector>

#include "cli/kit/json.h"
#include "cli/kit/number_option.h"
#include "cli/kit/progress_line.h"
#include "lab/commands/bench_arguments.h"
#include "lab/commands/bench_report.h"
#include "lab/commands/commands.h"
#include "lab/commands/peers_report.h"
#include "lab/peers/judge.h"
#include "lab/peers/peer.h"
#include "lab/runs/partition_run.h"
#include "palpate/base/json.h"

namespace palpate::app {
namespace {

struct BenchPartitionArguments {
  std::string mesh;
  bench::PartitionRun run;
  PeersOption peers;
  bool json = false;
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
  json["hash"] = fmt::format("{:016x}", f.hash);
  return json;
}

std::string textOf(const bench::PartitionFigures& f) {
  const auto line = [](const char* name, const lab::Percentiles& p) {
    return fmt::format("{:<22}{}\n", name, percentilesText(p));
  };
  std::string text = fmt::format("triangles             {}\nbox                   {:.2f} mm\n", f.triangles, f.edge_mm);
  text += line("exact triangles", f.hdb_query_us);
  text += line("  of it finding", f.ranges_us);
  text += line("leaves", f.leaves_us);
  text += fmt::format("found on average      {:.0f} triangles in {:.0f} ranges; leaves render {:.0f}\n",
                      f.mean_triangles, f.mean_ranges, f.mean_rendered);
  text += fmt::format("coherent list         {:.3f} us a tick, worst {:.1f} us, {} refreshes\n", f.hybrid_us_per_tick,
                      f.hybrid_worst_us, f.hybrid_refreshes);
  text += fmt::format("linked list           {:.3f} us a tick, worst {:.1f} us, {:.0f} boxes tested\n",
                      f.linked_us_per_tick, f.linked_worst_us, f.linked_boxes);
  text += fmt::format("memory, build         {:.1f} bytes, {:.0f} ns a triangle\n", f.bytes_per_triangle,
                      f.build_ns_per_triangle);
  return text +
         fmt::format("heap allocations      {}\nhash                  {:016x}\n", countText(f.allocations), f.hash);
}

std::vector<bench::PeerFigures> measurePeers(const BenchPartitionArguments& arguments, const mesh::TriangleMesh& mesh) {
  if (!arguments.peers.wanted) return {};
  const std::vector<Box3> boxes = bench::slidingBoxes(mesh, arguments.run);
  return bench::comparePeers(arguments.peers.peers, mesh, boxes, arguments.peers.seconds);
}

void runPartitionBench(const BenchPartitionArguments& arguments) {
  if (arguments.peers.wanted) handOverToPeersProgram(arguments.peers);
  ProgressLine progress;
  const mesh::TriangleMesh mesh = meshFrom(arguments.mesh, {}, progress.callback());
  progress.show("measuring", 0.0);
  const bench::PartitionFigures figures = bench::measurePartition(mesh, arguments.run);
  const std::vector<bench::PeerFigures> peers = measurePeers(arguments, mesh);
  progress.clear();
  Json json = toJson(arguments, figures);
  const double p50 = figures.hdb_query_us.p50;
  if (arguments.peers.wanted) addPeers(json, peers, PeerTask::boxes, p50);
  printReport(std::move(json), textOf(figures) + peersText(peers, PeerTask::boxes, p50), arguments.json);
}

}  // namespace

void addBenchPartitionCommand(Command& parent, std::vector<bench::Peer> peers) {
  const auto [command, arguments] =
      addCommand(parent, "partition", "Time the haptic detecting box of a finger that slides", runPartitionBench);
  arguments.peers.peers = std::move(peers);
  bench::PartitionRun& run = arguments.run;
  command.add_option("--mesh", arguments.mesh, kMeshNamesHelp)->required();
  addPartitionSettings(command, run.settings);
  addSetting(command, "--speed-mm-s", run.speed_mm_s, between(0.0, 1e6, "mm/s"), "Speed of the finger");
  addSetting(command, "--margin", run.margin, between(0.0, 10.0),
             "Margin of the coherent list, as a share of the box's edge");
  addSetting(command, "--ticks", run.ticks, between(1, 1e6), "Number of ticks of 1 ms to slide");
  addPeersOption(command, arguments.peers);
  command.add_flag("--json", arguments.json, "Print one JSON object");
}

void addBenchPartitionCommand(Command& parent) { addBenchPartitionCommand(parent, bench::peersWithoutLibraries()); }

}  // namespace palpate::app
