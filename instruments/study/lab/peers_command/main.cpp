// `palpate_peers`: the benchmark commands of `palpate` that know --peers, linked with the libraries that are compared.
// `palpate study bench ... --peers` runs this program; instruments/study/lab/commands/peers_report.h explains why it is
// separate.
#include "cli/kit/commands.h"
#include "cli/kit/program.h"
#include "lab/commands/commands.h"
#include "lab/commands/peers_report.h"
#include "lab/peers/peer.h"
#include "palpate/base/system/process.h"

int main(int argc, char** argv) {
  palpate::app::Command app{"Palpate's benchmarks beside other libraries.", "palpate_peers"};
  app.require_subcommand(1);
  palpate::app::Command& study = *app.add_subcommand("study", "Run the benchmarks of `palpate study` with peers");
  study.require_subcommand(1);
  palpate::app::Command& bench = *study.add_subcommand("bench", "Measure the finger, the partitions and their peers");
  bench.require_subcommand(1);
  palpate::app::addBenchContactCommand(bench, palpate::bench::linkedPeers(), palpate::bench::linkedToolPeers());
  palpate::app::addBenchPartitionCommand(bench, palpate::bench::linkedPeers());
  return palpate::app::runProgram(
      [&] { return palpate::app::runCommandLine(app, palpate::system::commandLine(argc, argv)); });
}
