// `palpate tissue fit`: laws and shapes of tissue from what was measured; each subcommand has a file of its own.
#include "cli/kit/commands.h"

namespace palpate::app {

void addFitCommand(CLI::App& tissue) {
  CLI::App& fit = *tissue.add_subcommand("fit", "Find force laws and skin profiles of measured tissue");
  fit.require_subcommand(1);
  addFitForceCommand(fit);
  addFitProfileCommand(fit);
}

}  // namespace palpate::app
