// `palpate info MESH`: what a mesh file holds.
#include "apps/palpate/commands.h"

namespace palpate::app {

void addInfoCommand(CLI::App& app) {
  app.add_subcommand("info", "Report what a mesh file holds")->callback([] {});
}

}  // namespace palpate::app
