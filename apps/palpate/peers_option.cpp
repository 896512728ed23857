#include "apps/palpate/peers_option.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace palpate::app {

namespace {

/// This process's own arguments, as Linux keeps them: each ends with a zero byte.
std::vector<std::string> ownArguments() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> arguments;
  for (std::string argument; std::getline(file, argument, '\0');) arguments.push_back(argument);
  return arguments;
}

bool linksLibraries(const PeersOption& option) {
  for (const bench::Peer& peer : option.peers) {
    if (!peer.package.empty() && peer.contact != nullptr) return true;
  }
  return false;
}

}  // namespace

void addPeersOption(CLI::App& command, PeersOption& option) {
  command.add_flag("--peers", option.wanted,
                   "Put the same queries to Embree, CGAL, FCL and the literal dissertation, in the same run");
  command.add_option("--peer-seconds", option.seconds, "Time for the queries of each peer (s); building not counted")
      ->capture_default_str()
      ->check(CLI::Range(0.01, 3600.0));
}

void handOverToPeersProgram(const PeersOption& option) {
  std::error_code none;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", none);
  const std::filesystem::path program = self.parent_path() / "palpate_peers";
  if (linksLibraries(option) || self.filename() == program.filename() || !std::filesystem::exists(program, none))
    return;
  std::vector<std::string> arguments = ownArguments();
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  execv(program.c_str(), pointers.data());  // returns only when it cannot: then this program says what it has
}

}  // namespace palpate::app
