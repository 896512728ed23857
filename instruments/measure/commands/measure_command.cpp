// `palpate measure`: from photographs of a dotted back to a personal map; each subcommand has a file of its own. And
// the window of `palpate run` with the mode that measures photographs.
#include <memory>
#include <string>
#include <vector>

#include "cli/own/commands.h"
#include "cli/run/run_modes.h"
#include "measure/commands/commands.h"
#include "measure/window/measuring_mode.h"
#include "palpate/elements/lump_solver.h"

namespace palpate::app {

namespace {

ModeMaker addMeasuringMode(Command& command) {
  const auto photographs = std::make_shared<std::vector<std::string>>();
  command
      .add_option("--measure", *photographs,
                  "Measure how far skin follows: two photographs of dots, before and after it is dragged")
      ->type_name("BEFORE AFTER")
      ->expected(2);
  return [photographs] {
    auto mode = std::make_unique<viewer::MeasuringMode>();
    if (photographs->size() == 2) {
      mode->request(viewer::ShowPhoto{viewer::Photo::before, photographs->front()});
      mode->request(viewer::ShowPhoto{viewer::Photo::after, photographs->back()});
    }
    return mode;
  };
}

}  // namespace

void addMeasureCommand(Command& app) {
  Command& measure =
      *app.add_subcommand("measure", "Measure key ellipses of a person from photographs of dots on the skin");
  measure.require_subcommand(1);
  addMeasureDotsCommand(measure);
  addMeasureStiffnessCommand(measure);
  addMeasureStencilCommand(measure);
  addMeasureSessionCommand(measure);
  addMeasureAverageCommand(measure);
  addMeasureSynthesizeCommand(measure);
}

void addMeasureFamily(Command& app) {
  scene::setLumpSolver(elements::solveLump);
  offerRunMode(addMeasuringMode);
  addRunCommand(app);
  addMeasureCommand(app);
}

}  // namespace palpate::app
