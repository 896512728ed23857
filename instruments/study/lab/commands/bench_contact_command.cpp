// `palpate study bench contact`: one finger along one trajectory over one mesh.
#include <string>
#include <utility>
#include <vector>

#include "cli/kit/choice_option.h"
#include "cli/kit/number_option.h"
#include "lab/commands/bench_arguments.h"
#include "lab/commands/bench_report.h"
#include "lab/commands/commands.h"
#include "lab/commands/peers_report.h"
#include "lab/peers/judge.h"
#include "lab/peers/peer.h"
#include "lab/runs/tool_run.h"
#include "palpate/base/error.h"

namespace palpate::app {

namespace {

Json toJson(const bench::ContactFigures& f) {
  Json json;
  json["triangles"] = f.triangles;
  json["ticks"] = f.ticks;
  json["tick_us"] = percentilesJson(f.tick_us);
  json["lag_mm"] = {{"p99", f.lag_mm.p99}, {"max", f.lag_mm.max}};
  json["fall_throughs"] = f.falls.ticks;
  json["first_contact_delay_ticks"] = f.falls.first_contact_delay_ticks;
  json["friction"] = {{"kinetic", f.friction.kinetic},
                      {"static", f.friction.static_peak},
                      {"kinetic_min", f.friction.kinetic_min},
                      {"kinetic_max", f.friction.kinetic_max}};
  json["peak_force_n"] = f.peak_force_n;
  json["max_force_step_n"] = f.max_force_step_n;
  json["max_force_step_tick"] = f.max_force_step_tick;
  addCounts(json, f.counts);
  json["hash"] = lab::hashText(f.hash);
  json["contact_ticks"] = f.contact_ticks;
  json["stick_ticks"] = f.friction.stick_ticks;
  json["slip_ticks"] = f.friction.slip_ticks;
  json["first_contacts"] = f.falls.first_contacts;
  json["fall_events"] = f.falls.events;
  json["peak_depth_mm"] = f.peak_depth_mm;
  json["teleport_ticks"] = f.teleports;
  if (f.sphere) {
    json["sphere"] = {{"least_distance_over_radius", f.sphere->least_distance},
                      {"infeasible_ticks", f.sphere->infeasible_ticks},
                      {"missed_ticks", f.sphere->missed_ticks}};
  }
  return json;
}

struct BenchContactArguments {
  std::string mesh, trajectory;
  double scale = 1.0;
  double stiffness_n_per_mm = 0.5;
  contact::FingerSettings finger;
  bench::Window window;
  int rounds = 1;
  bool by_hdb = false;
  bench::HdbRunSettings hdb;
  PeersOption peers;
  std::string tool;  ///< empty: one finger
};

Json measureByHdb(const BenchContactArguments& arguments) {
  if (arguments.scale != 1.0 || arguments.finger.radius_mm != 0.0 || arguments.finger.force_shading) {
    throw Error("--source hdb touches with a point, without scale and shading");
  }
  if (arguments.peers.wanted) throw Error("--peers are compared with --source surface");
  bench::ContactWorld world = bench::buildContactWorld(meshFrom(arguments.mesh), 1.0, arguments.stiffness_n_per_mm);
  const bench::HdbFigures f =
      bench::measureHdb(world, trajectoryFrom(arguments.trajectory), arguments.finger, arguments.hdb, arguments.window);
  Json json = toJson(f.contact);
  json["hdb"] = {{"edge_mm", f.edge_mm}, {"leaves", f.leaves}, {"most_listed", f.most_listed}, {"queries", f.queries}};
  return json;
}

Json measureByTool(const BenchContactArguments& arguments) {
  if (arguments.scale != 1.0 || arguments.by_hdb || arguments.finger.force_shading) {
    throw Error("--tool touches the whole surface, without scale and shading");
  }
  const bench::ContactWorld world =
      bench::buildContactWorld(meshFrom(arguments.mesh), 1.0, arguments.stiffness_n_per_mm);
  const device::Trajectory trajectory = trajectoryFrom(arguments.trajectory);
  const contact::ToolShape shape = bench::toolNamed(arguments.tool);
  Json json = {{"tool", arguments.tool}};
  json.update(bench::measureTool(world, trajectory, shape, arguments.finger, arguments.window));
  if (!arguments.peers.wanted) return json;
  const bench::ToolQueries queries{shape,
                                   bench::posesOnSkin(world, trajectory, shape, arguments.finger, arguments.window)};
  addPeers(json, bench::comparePeers(arguments.peers.tool_peers, world, queries, arguments.peers.seconds),
           PeerTask::tool, json["any_tick_us"]["p50"].get<double>());
  return json;
}

Json measureWithPeers(const BenchContactArguments& arguments, bench::ContactWorld& world) {
  const bench::ContactComparison comparison =
      bench::compareContact(world, trajectoryFrom(arguments.trajectory), arguments.finger, arguments.window,
                            arguments.peers.peers, arguments.peers.seconds);
  Json json = toJson(comparison.ours);
  json["peer_queries"] = {{"segments", comparison.queries}, {"nearest", comparison.nearest_asked}};
  addPeers(json, comparison.peers, PeerTask::contact, comparison.ours.tick_us.p50);
  return json;
}

Json measureFinger(const BenchContactArguments& arguments, ProgressLine&) {
  if (arguments.rounds > 1 && (arguments.peers.wanted || !arguments.tool.empty() || arguments.by_hdb)) {
    throw Error("--rounds times one finger on the whole surface, without --peers");
  }
  if (arguments.peers.wanted) handOverToPeersProgram(arguments.peers);
  if (!arguments.tool.empty()) return measureByTool(arguments);
  if (arguments.by_hdb) return measureByHdb(arguments);
  bench::ContactWorld world =
      bench::buildContactWorld(meshFrom(arguments.mesh), arguments.scale, arguments.stiffness_n_per_mm);
  if (arguments.peers.wanted) return measureWithPeers(arguments, world);
  return toJson(bench::measureContact(world, trajectoryFrom(arguments.trajectory), arguments.finger, arguments.window,
                                      arguments.rounds));
}

void addFingerOptions(Command& command, BenchContactArguments& arguments) {
  const auto number = [&](const char* name, double& value, const char* help, double low) {
    addSetting(command, name, value, between(low, 1e9), help);
  };
  number("--scale", arguments.scale, "Multiplies mesh, trajectory and finger lengths; results stay in mm", 1e-9);
  number("--radius-mm", arguments.finger.radius_mm, "Radius of the fingertip (mm); 0 is a point", 0.0);
  number("--mu-static", arguments.finger.mu_static, "Static friction coefficient", 0.0);
  number("--mu-dynamic", arguments.finger.mu_dynamic, "Dynamic friction coefficient", 0.0);
  number("--stiffness", arguments.stiffness_n_per_mm, "Stiffness of the skin (N/mm), the same everywhere", 1e-9);
  number("--stiffness-ratio", arguments.finger.stiffness_ratio, "Tangential over normal stiffness", 1e-9);
  addNumber(command, "--from", arguments.window.from_s, between(-1e9, 1e9, "s"),
            "Measure ticks from this time on; falls always whole run");
  addNumber(command, "--to", arguments.window.until_s, between(-1e9, 1e9, "s"), "Measure ticks before this time");
  addSetting(command, "--rounds", arguments.rounds, between(1, 1000),
             "For one finger: run this many times and use each tick's shortest time, without single interruptions");
  command.add_flag("--force-shading", arguments.finger.force_shading, "Smooth the force across triangles");
}

void addHdbOptions(Command& command, BenchContactArguments& arguments) {
  bench::HdbRunSettings& settings = arguments.hdb;
  addChoice<bool>(command, "--source", arguments.by_hdb, {{"surface", false}, {"hdb", true}},
                  "Triangles to touch: the whole surface, or those that the detecting box (HDB) finds, as set by the "
                  "options below");
  addPartitionSettings(command, settings.build);
  addChoice(command, "--query", settings.hdb.query, "HDB: contents of the box");
  addChoice(command, "--traversal", settings.hdb.literal, "HDB: search for leaves; all but the first as printed");
  addSetting(command, "--hdb-edge-mm", settings.edge_mm, between(0.0, 1e9, "mm"),
             "HDB: edge of the box; 0: a quarter of the longest edge");
  addSetting(command, "--refresh-ticks", settings.hdb.ticks_per_refresh, between(1, 1e6),
             "HDB: number of ticks after which the box follows the proxy");
}

void addContactOptions(Command& command, BenchContactArguments& arguments) {
  command.add_option("--mesh", arguments.mesh, kMeshNamesHelp)->required();
  command.add_option("--trajectory", arguments.trajectory, "CSV file t_s,x_mm,y_mm,z_mm, or a benchmark's name")
      ->required();
  addFingerOptions(command, arguments);
  addHdbOptions(command, arguments);
  addPeersOption(command, arguments.peers);
  restrictTo(bench::toolNames(),
             command.add_option("--tool", arguments.tool, "Tool of several pads to touch with instead of one finger"));
}

}  // namespace

void addBenchContactCommand(Command& parent, std::vector<bench::Peer> peers, std::vector<bench::ToolPeer> tool_peers) {
  BenchContactArguments& arguments = addBench(
      parent, "contact", "Run one finger along a trajectory and report what it felt", addContactOptions, measureFinger);
  arguments.peers.peers = std::move(peers);
  arguments.peers.tool_peers = std::move(tool_peers);
}

void addBenchContactCommand(Command& parent) {
  addBenchContactCommand(parent, bench::peersWithoutLibraries(), bench::toolPeersWithoutLibraries());
}

}  // namespace palpate::app
