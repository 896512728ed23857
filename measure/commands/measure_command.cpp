// `palpate measure`: from photographs of a dotted back to a personal map; each subcommand has a file of its own.
#include "cli/kit/commands.h"
#include "measure/study/measuring_study.h"

namespace palpate::app {

void offerMeasuringStudies() { study::offerStudy(study::measuringStudy()); }

void addMeasureCommand(CLI::App& app) {
  CLI::App& measure = *app.add_subcommand("measure", "Key ellipses of a person from photographs of dots on the skin");
  measure.require_subcommand(1);
  addMeasureDotsCommand(measure);
  addMeasureStiffnessCommand(measure);
  addMeasureStencilCommand(measure);
  addMeasureSessionCommand(measure);
  addMeasureAverageCommand(measure);
  addMeasureSynthesizeCommand(measure);
}

}  // namespace palpate::app
