// `palpate tissue`: layered tissue solved and shown, and published values; each subcommand has a file of its own.
#include "solve/commands/commands.h"

namespace palpate::app {

namespace {

/// `palpate tissue fit`: laws and shapes of tissue from measurements.
void addFitCommand(Command& tissue) {
  Command& fit = *tissue.add_subcommand("fit", "Find force laws and skin profiles of measured tissue");
  fit.require_subcommand(1);
  addFitForceCommand(fit);
  addFitProfileCommand(fit);
}

}  // namespace

void addTissueCommand(Command& app) {
  Command& tissue = *app.add_subcommand(
      "tissue", "Solve and show layered tissue, fit force laws and profiles, check realism, list published moduli");
  tissue.require_subcommand(1);
  addTissueLibraryCommand(tissue);
  addTissueModuliCommand(tissue);
  addTissueShowCommand(tissue);
  addTissueSolveCommand(tissue);
  addFitCommand(tissue);
  addRealismCommand(tissue);
}

}  // namespace palpate::app
