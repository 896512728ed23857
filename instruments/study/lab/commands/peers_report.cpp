#include "lab/commands/peers_report.h"

#include <fmt/format.h>
#include <unistd.h>
#include <filesystem>
#include <fstream>
#include <string>

#include "cli/kit/families.h"
#include "cli/kit/json.h"
#include "cli/kit/number_option.h"
#include "lab/commands/bench_report.h"
#include "palpate/base/json.h"
#include "palpate/base/system/process.h"

namespace palpate::app {

namespace {

using bench::PeerFigures;

/// This process's own arguments, as Linux keeps them: each ends with a zero byte.
std::vector<std::string> ownArguments() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> arguments;
  for (std::string argument; std::getline(file, argument, '\0');) arguments.push_back(argument);
  return arguments;
}

constexpr const char* kPeersProgram = "palpate_peers";

bool linksLibraries(const PeersOption& option) {
  for (const bench::Peer& peer : option.peers) {
    if (!peer.package.empty() && peer.contact != nullptr) return true;
  }
  return false;
}

bool isPeersProgram() { return system::ownProgram().filename() == kPeersProgram; }

/// This program has none of the libraries by design: whether they are installed, only the peers' own program can know.
bool lacksPeersProgram(const PeerFigures& figures) {
  return !figures.skipped.empty() && !figures.package.empty() && !isPeersProgram();
}

/// The reason for missing figures.
std::string explainSkip(const PeerFigures& f) {
  return lacksPeersProgram(f) ? fmt::format("not run, {} is not next to this program", kPeersProgram) : f.skipped;
}

Json toJson(const PeerFigures& f, PeerTask task) {
  Json json;
  if (!f.skipped.empty()) {
    json["skipped"] = explainSkip(f);
    json["package"] = f.package;
    return json;
  }
  json[task == PeerTask::boxes ? "hdb_query_us" : "tick_us"] = percentilesJson(f.query_us);
  json["queries"] = f.queries;
  if (task == PeerTask::contact) {
    json["mean_distance_mm"] = f.mean_distance_mm;
    json["hits"] = f.hits;
  } else if (task == PeerTask::tool) {
    json["mean_touching"] = f.mean_touching;
  } else {
    json["mean_triangles"] = f.mean_triangles;
  }
  json["disagreements"] = f.disagreements;
  json["bytes_per_triangle"] = orNull(f.bytes_per_triangle);
  json["build_ns_per_triangle"] = f.build_ns_per_triangle;
  json["hash"] = lab::hashText(f.hash);
  return json;
}

}  // namespace

void addPeersOption(Command& command, PeersOption& option) {
  command.add_flag("--peers", option.wanted,
                   "Also time the same queries in Embree, CGAL, FCL and the literal dissertation, those of a tool in "
                   "Bullet and FCL");
  addSetting(command, "--peer-seconds", option.seconds, between(0.01, 3600.0, "s"),
             "Time for the queries of each peer, without building");
}

void handOverToPeersProgram(const PeersOption& option) {
  std::error_code none;
  const std::filesystem::path program = system::ownProgram().parent_path() / kPeersProgram;
  if (linksLibraries(option) || isPeersProgram() || !std::filesystem::exists(program, none)) return;
  std::vector<std::string> arguments = ownArguments();
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  execv(program.c_str(), pointers.data());  // returns only on failure: then this program prints its own results
}

void addPeers(Json& json, std::span<const PeerFigures> peers, PeerTask task, double ours_p50) {
  Json all = Json::object();
  Json ratios = Json::object();
  for (const PeerFigures& f : peers) {
    all[f.name] = toJson(f, task);
    if (f.skipped.empty() && f.query_us.p50 > 0.0) ratios[f.name] = ours_p50 / f.query_us.p50;
  }
  json["peers"] = std::move(all);
  json["ratio_to"] = std::move(ratios);
}

}  // namespace palpate::app
