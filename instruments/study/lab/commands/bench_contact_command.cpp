// `palpate study bench contact`: one finger along one trajectory over one mesh.
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/kit/choice_option.h"
#include "cli/kit/json.h"
#include "cli/kit/number_option.h"
#include "cli/kit/options.h"
#include "lab/commands/bench_arguments.h"
#include "lab/commands/bench_report.h"
#include "lab/commands/commands.h"
#include "lab/commands/peers_report.h"
#include "lab/peers/judge.h"
#include "lab/peers/peer.h"
#include "lab/runs/contact_run.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"

namespace palpate::app {

namespace {

// ---- printed results of a run

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
  json["allocations"] = orNull(f.counts.allocations);
  json["locks"] = orNull(f.counts.locks);
  json["page_faults"] = orNull(f.counts.page_faults);
  json["hash"] = fmt::format("{:016x}", f.hash);
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

std::string textOf(const bench::ContactFigures& f) {
  std::string text = fmt::format("triangles                {}\n", f.triangles);
  text += fmt::format("ticks                    {} ({} in contact)\n", f.ticks, f.contact_ticks);
  text += fmt::format("tick time                {}\n", percentilesText(f.tick_us));
  text += fmt::format("lag |anchor - tip|       p99 {:.3f}  max {:.3f} mm\n", f.lag_mm.p99, f.lag_mm.max);
  text += fmt::format("fall-throughs            {} ticks in {} events\n", f.falls.ticks, f.falls.events);
  text += fmt::format("first contacts           {}, worst delay {} ticks\n", f.falls.first_contacts,
                      f.falls.first_contact_delay_ticks);
  text += fmt::format("friction                 kinetic {:.6f} ({} ticks), break-away peak {:.6f}\n",
                      f.friction.kinetic, f.friction.slip_ticks, f.friction.static_peak);
  text += fmt::format("force                    peak {:.3f} N, largest step {:.3f} N (tick {})\n", f.peak_force_n,
                      f.max_force_step_n, f.max_force_step_tick);
  text += fmt::format("heap allocations         {}, locks {}, page faults {}\n", countText(f.counts.allocations),
                      countText(f.counts.locks), countText(f.counts.page_faults));
  return text + fmt::format("hash                     {:016x}\n", f.hash);
}

Json toJson(const bench::HdbFigures& f) {
  Json json = toJson(f.contact);
  json["hdb"] = {{"edge_mm", f.edge_mm}, {"leaves", f.leaves}, {"most_listed", f.most_listed}, {"queries", f.queries}};
  return json;
}

std::string textOf(const bench::HdbFigures& f) {
  return textOf(f.contact) +
         fmt::format("detecting box            {:.1f} mm; {} leaves, at most {} triangles listed, {} queries\n",
                     f.edge_mm, f.leaves, f.most_listed, f.queries);
}

// ---- the command

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
  bool json = false;
};

template <class Figures>
void print(const BenchContactArguments& arguments, const Figures& figures) {
  printReport(toJson(figures), textOf(figures), arguments.json);
}

void runHdb(const BenchContactArguments& arguments) {
  if (arguments.scale != 1.0 || arguments.finger.radius_mm != 0.0 || arguments.finger.force_shading) {
    throw Error("--source hdb touches with a point, without scale and shading");
  }
  if (arguments.peers.wanted) throw Error("--peers are compared with --source surface");
  bench::ContactWorld world = bench::buildContactWorld(meshFrom(arguments.mesh), 1.0, arguments.stiffness_n_per_mm);
  print(arguments, bench::measureHdb(world, trajectoryFrom(arguments.trajectory), arguments.finger, arguments.hdb,
                                     arguments.window));
}

void runTool(const BenchContactArguments& arguments) {
  if (arguments.scale != 1.0 || arguments.by_hdb || arguments.finger.force_shading) {
    throw Error("--tool touches the whole surface, without scale and shading");
  }
  runToolBench({arguments.mesh, arguments.trajectory, arguments.tool, arguments.stiffness_n_per_mm, arguments.finger,
                arguments.window, arguments.peers, arguments.json});
}

void runWithPeers(const BenchContactArguments& arguments, bench::ContactWorld& world) {
  const bench::ContactComparison comparison =
      bench::compareContact(world, trajectoryFrom(arguments.trajectory), arguments.finger, arguments.window,
                            arguments.peers.peers, arguments.peers.seconds);
  const double p50 = comparison.ours.tick_us.p50;
  Json json = toJson(comparison.ours);
  json["peer_queries"] = {{"segments", comparison.queries}, {"nearest", comparison.nearest_asked}};
  addPeers(json, comparison.peers, PeerTask::contact, p50);
  printReport(std::move(json), textOf(comparison.ours) + peersText(comparison.peers, PeerTask::contact, p50),
              arguments.json);
}

void runContact(const BenchContactArguments& arguments) {
  if (arguments.rounds > 1 && (arguments.peers.wanted || !arguments.tool.empty() || arguments.by_hdb)) {
    throw Error("--rounds times one finger on the whole surface, without --peers");
  }
  if (arguments.peers.wanted) handOverToPeersProgram(arguments.peers);
  if (!arguments.tool.empty()) return runTool(arguments);
  if (arguments.by_hdb) return runHdb(arguments);
  bench::ContactWorld world =
      bench::buildContactWorld(meshFrom(arguments.mesh), arguments.scale, arguments.stiffness_n_per_mm);
  if (arguments.peers.wanted) return runWithPeers(arguments, world);
  print(arguments, bench::measureContact(world, trajectoryFrom(arguments.trajectory), arguments.finger,
                                         arguments.window, arguments.rounds));
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

}  // namespace

void addBenchContactCommand(Command& parent, std::vector<bench::Peer> peers, std::vector<bench::ToolPeer> tool_peers) {
  const auto [command, arguments] =
      addCommand(parent, "contact", "Run one finger along a trajectory and report what it felt", runContact);
  arguments.peers.peers = std::move(peers);
  arguments.peers.tool_peers = std::move(tool_peers);
  command.add_option("--mesh", arguments.mesh, kMeshNamesHelp)->required();
  command.add_option("--trajectory", arguments.trajectory, "CSV file t_s,x_mm,y_mm,z_mm, or a benchmark's name")
      ->required();
  addFingerOptions(command, arguments);
  addHdbOptions(command, arguments);
  addPeersOption(command, arguments.peers);
  restrictTo(bench::toolNames(),
             command.add_option("--tool", arguments.tool, "Tool of several pads to touch with instead of one finger"));
  command.add_flag("--json", arguments.json, "Print one JSON object");
}

void addBenchContactCommand(Command& parent) {
  addBenchContactCommand(parent, bench::peersWithoutLibraries(), bench::toolPeersWithoutLibraries());
}

}  // namespace palpate::app
