// `palpate_peers`: the benchmark commands of `palpate` that know --peers, linked with the libraries that are compared.
// `palpate bench ... --peers` runs this program; why it is one of its own says apps/palpate/peers_option.h.
#include <fmt/format.h>

#include <exception>

#include "apps/palpate/peers_option.h"
#include "bench/peers/peer_list.h"

namespace {

constexpr int kWrongInput = 2;  // as `palpate`

int run(int argc, char** argv) {
  CLI::App app{"Palpate's benchmarks beside other libraries.", "palpate_peers"};
  app.require_subcommand(1);
  CLI::App& bench = *app.add_subcommand("bench", "Measure the finger and the partitions, and their peers");
  bench.require_subcommand(1);
  palpate::app::addBenchContactCommand(bench, palpate::bench::linkedPeers());
  palpate::app::addBenchPartitionCommand(bench, palpate::bench::linkedPeers());
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help
    fmt::print(stderr, "palpate: {} (see --help)\n", error.what());
    return kWrongInput;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "palpate: {}\n", error.what());
    return kWrongInput;
  }
}
