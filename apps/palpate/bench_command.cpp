// `palpate bench`: measures the finger on known meshes and trajectories.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/palpate/bench_report.h"
#include "apps/palpate/commands.h"
#include "apps/palpate/named_mesh.h"
#include "bench/contact_run.h"
#include "bench/hdb_run.h"
#include "bench/heldout_meshes.h"
#include "bench/workload_meshes.h"
#include "bench/workload_paths.h"
#include "palpate/base/error.h"
#include "palpate/mesh/save.h"

namespace palpate::app {
namespace {

using Words = std::vector<std::string>;
// Each in the order of its enumerators.
const Words kSources = {"surface", "hdb"};
const Words kTrees = {"bsp", "octree"};
const Words kAssignments = {"A", "B", "C"};
const Words kQueries = {"leaves", "triangles", "coherent"};
const Words kTraversals = {"tight", "else-if", "half-space", "cell-box", "sphere-corners"};

/// For --source hdb.
struct HdbArguments {
  std::string source = "surface", tree = "octree", assign = "C", query = "leaves", traversal = "tight";
  Index threshold = 1024;
  double edge_mm = 0.0;
  std::uint32_t refresh_ticks = 1;
};

struct ContactArguments {
  std::string mesh, trajectory;
  double scale = 1.0;
  double stiffness_n_per_mm = 0.5;
  contact::FingerSettings finger;
  bench::Window window;
  HdbArguments hdb;
  bool json = false;
};

device::Trajectory trajectoryFrom(const std::string& name) {
  if (std::filesystem::exists(name) || name.ends_with(".csv")) return device::readTrajectory(name);
  return bench::workloadPath(name);
}

nlohmann::ordered_json jsonOf(const bench::ContactFigures& f) {
  nlohmann::ordered_json json;
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
  json["allocations"] = countJson(f.counts.allocations);
  json["locks"] = countJson(f.counts.locks);
  json["page_faults"] = countJson(f.counts.page_faults);
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
  std::string text = fmt::format(
      "triangles                {}\nticks           "
      "         {} ({} in contact)\n",
      f.triangles, f.ticks, f.contact_ticks);
  text += fmt::format(
      "tick time                p50 {:.2f}  p99 {:.2f}  p99.9 "
      "{:.2f}  max {:.1f} us\n",
      f.tick_us.p50, f.tick_us.p99, f.tick_us.p99_9, f.tick_us.max);
  text += fmt::format("lag |anchor - tip|       p99 {:.3f}  max {:.3f} mm\n", f.lag_mm.p99, f.lag_mm.max);
  text += fmt::format("fall-throughs            {} ticks in {} events\n", f.falls.ticks, f.falls.events);
  text += fmt::format("first contacts           {}, worst delay {} ticks\n", f.falls.first_contacts,
                      f.falls.first_contact_delay_ticks);
  text += fmt::format(
      "friction                 kinetic {:.6f} ({} ticks), "
      "break-away peak {:.6f}\n",
      f.friction.kinetic, f.friction.slip_ticks, f.friction.static_peak);
  text += fmt::format(
      "force                    peak {:.3f} N, largest step {:.3f} "
      "N (tick {})\n",
      f.peak_force_n, f.max_force_step_n, f.max_force_step_tick);
  text += fmt::format("heap allocations         {}, locks {}, page faults {}\n", countText(f.counts.allocations),
                      countText(f.counts.locks), countText(f.counts.page_faults));
  return text + fmt::format("hash                     {:016x}\n", f.hash);
}

/// `word` is one of `words`.
int placeOf(const std::string& word, const Words& words) {
  return static_cast<int>(std::find(words.begin(), words.end(), word) - words.begin());
}

bench::HdbRunSettings settingsOf(const HdbArguments& arguments) {
  bench::HdbRunSettings settings;
  settings.build.tree = static_cast<partition::TreeKind>(placeOf(arguments.tree, kTrees));
  settings.build.assignment = static_cast<partition::Assignment>(placeOf(arguments.assign, kAssignments));
  settings.build.threshold = arguments.threshold;
  settings.edge_mm = arguments.edge_mm;
  settings.hdb.query = static_cast<contact::HdbQuery>(placeOf(arguments.query, kQueries));
  const int traversal = placeOf(arguments.traversal, kTraversals);
  if (traversal > 0) settings.hdb.literal = static_cast<partition::LiteralTraversal>(traversal - 1);
  settings.hdb.ticks_per_refresh = arguments.refresh_ticks;
  return settings;
}

void runHdb(const ContactArguments& arguments) {
  if (arguments.scale != 1.0 || arguments.finger.radius_mm != 0.0 || arguments.finger.force_shading) {
    throw Error("--source hdb touches with a point, without scale and shading");
  }
  bench::ContactWorld world = bench::buildContactWorld(meshFrom(arguments.mesh), 1.0, arguments.stiffness_n_per_mm);
  const bench::HdbFigures figures = bench::measureHdb(world, trajectoryFrom(arguments.trajectory), arguments.finger,
                                                      settingsOf(arguments.hdb), arguments.window);
  nlohmann::ordered_json json = jsonOf(figures.contact);
  json["hdb"] = {{"edge_mm", figures.edge_mm},
                 {"leaves", figures.leaves},
                 {"most_listed", figures.most_listed},
                 {"queries", figures.queries}};
  const std::string text =
      textOf(figures.contact) + fmt::format(
                                    "detecting box            {:.1f} mm; {} leaves, at most {} triangles listed, {} "
                                    "queries\n",
                                    figures.edge_mm, figures.leaves, figures.most_listed, figures.queries);
  printReport(std::move(json), text, arguments.json);
}

void runContact(const ContactArguments& arguments) {
  if (arguments.hdb.source == "hdb") return runHdb(arguments);
  bench::ContactWorld world =
      bench::buildContactWorld(meshFrom(arguments.mesh), arguments.scale, arguments.stiffness_n_per_mm);
  const bench::ContactFigures figures =
      bench::measureContact(world, trajectoryFrom(arguments.trajectory), arguments.finger, arguments.window);
  printReport(jsonOf(figures), textOf(figures), arguments.json);
}

void addHdbOptions(CLI::App& command, HdbArguments& hdb) {
  const auto choice = [&](const char* name, std::string& value, const Words& words, const char* help) {
    command.add_option(name, value, help)->check(CLI::IsMember(words))->capture_default_str();
  };
  choice("--source", hdb.source, kSources, "What is touched: the whole surface, or what the detecting box (HDB) finds");
  choice("--tree", hdb.tree, kTrees, "HDB: how space is divided");
  choice("--assign", hdb.assign, kAssignments, "HDB: a triangle across a plane is cut, goes to both sides or to one");
  choice("--query", hdb.query, kQueries, "HDB: what the box gives");
  choice("--traversal", hdb.traversal, kTraversals, "HDB: how leaves are found; all but the first as printed");
  command.add_option("--threshold", hdb.threshold, "HDB: triangles in a leaf")->capture_default_str();
  command.add_option("--hdb-edge-mm", hdb.edge_mm, "HDB: edge of the box; 0 is a quarter of the longest edge")
      ->capture_default_str();
  command.add_option("--refresh-ticks", hdb.refresh_ticks, "HDB: the box follows the proxy every so many ticks")
      ->capture_default_str();
}

void addContactCommand(CLI::App& parent) {
  auto arguments = std::make_shared<ContactArguments>();
  CLI::App& command = *parent.add_subcommand("contact", "Run one finger along a trajectory and report what it felt");
  command.add_option("--mesh", arguments->mesh, kMeshNamesHelp)->required();
  command.add_option("--trajectory", arguments->trajectory, "CSV file t_s,x_mm,y_mm,z_mm, or a benchmark's name")
      ->required();
  const auto number = [&](const char* name, double& value, const char* help, double low) {
    command.add_option(name, value, help)->capture_default_str()->check(CLI::Range(low, 1e9));
  };
  number("--scale", arguments->scale, "Multiplies mesh, trajectory and finger lengths; results stay in mm", 1e-9);
  number("--radius-mm", arguments->finger.radius_mm, "Radius of the fingertip (mm); 0 is a point", 0.0);
  number("--mu-static", arguments->finger.mu_static, "Static friction coefficient", 0.0);
  number("--mu-dynamic", arguments->finger.mu_dynamic, "Dynamic friction coefficient", 0.0);
  number("--stiffness", arguments->stiffness_n_per_mm, "Stiffness of the skin (N/mm), the same everywhere", 1e-9);
  number("--stiffness-ratio", arguments->finger.stiffness_ratio, "Tangential over normal stiffness", 1e-9);
  command.add_option("--from", arguments->window.from_s, "Measure ticks from this time on (s); falls always whole run");
  command.add_option("--to", arguments->window.until_s, "Measure ticks before this time (s)");
  command.add_flag("--force-shading", arguments->finger.force_shading, "Smooth the force across triangles");
  addHdbOptions(command, arguments->hdb);
  command.add_flag("--json", arguments->json, "Print one JSON object");
  command.callback([arguments] { runContact(*arguments); });
}

/// Trajectories are written as .csv, meshes as what the extension says.
void writeWorkload(const std::string& name, const std::string& file) {
  if (file.ends_with(".csv")) {
    device::writeTrajectory(file, trajectoryFrom(name));
  } else {
    mesh::save(file, meshFrom(name));
  }
}

void addWorkloadCommand(CLI::App& parent) {
  struct Arguments {
    std::string name, file;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App& command = *parent.add_subcommand("workload", "Write a benchmark mesh (.stl, .obj, .ply) or path (.csv)");
  command.add_option("name", arguments->name, "Name, as `palpate bench list` prints it")->required();
  command.add_option("-o,--output", arguments->file, "File to write")->required();
  command.callback([arguments] { writeWorkload(arguments->name, arguments->file); });
}

void printNames() {
  fmt::print("meshes\n");
  for (const std::string& name : bench::workloadMeshNames()) fmt::print("  {}\n", name);
  fmt::print("held-out meshes\n");
  for (const std::string& name : bench::heldoutMeshNames()) fmt::print("  {}\n", name);
  fmt::print("trajectories (and the mesh each was made for)\n");
  for (const bench::PathName& name : bench::workloadPathNames()) fmt::print("  {:18} {}\n", name.path, name.mesh);
}

}  // namespace

void addBenchCommand(CLI::App& app) {
  CLI::App& bench =
      *app.add_subcommand("bench", "Measure the finger, the deformation, the partitions and the pictures");
  bench.require_subcommand(1);
  addContactCommand(bench);
  addBenchDeformCommand(bench);
  addBenchFrameCommand(bench);
  addBenchPartitionCommand(bench);
  addWorkloadCommand(bench);
  bench.add_subcommand("list", "Name the benchmark meshes and trajectories")->callback(printNames);
}

}  // namespace palpate::app
