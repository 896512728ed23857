// Photographs measured in the window: what `palpate run` gets from this product.
#include <string>
#include <vector>

#include "cli/kit/commands.h"
#include "cli/run/run_modes.h"
#include "measure/window/measuring_mode.h"

namespace palpate::app {

namespace {

ModeMaker addMeasuringMode(CLI::App& command) {
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

void offerMeasuringMode() { offerRunMode(addMeasuringMode); }

}  // namespace palpate::app
