// `palpate measure stencil -o stencil.svg`: the sheet to punch, at true size.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

#include "cli/kit/choice_option.h"
#include "cli/kit/number_option.h"
#include "cli/kit/output_place.h"
#include "measure/commands/commands.h"
#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "palpate/measure/stencil.h"

namespace palpate::app {

namespace {

struct MeasureStencilArguments {
  measure::StencilSettings settings;
  std::string output;
};

void runMeasureStencil(const MeasureStencilArguments& arguments) {
  const std::filesystem::path file = arguments.output;
  if (file.extension() != ".svg") throw Error::inFile(arguments.output, "a stencil's name must end in .svg");
  for (const measure::StencilSheet& sheet : stencilSheets(arguments.settings)) {
    std::filesystem::path of_sheet = file;
    if (!sheet.name.empty()) of_sheet.replace_filename(file.stem().string() + "-" + sheet.name + ".svg");
    writeFile(of_sheet, sheet.svg);
    fmt::print("-> {}\n", of_sheet.string());
  }
}

}  // namespace

void addMeasureStencilCommand(Command& parent) {
  using measure::StencilPage;
  const auto [command, arguments] =
      addCommand(parent, "stencil", "Draw the sheet to punch for the dots, at true size", runMeasureStencil);
  measure::StencilSettings& s = arguments.settings;
  addSetting(command, "--spacing-mm", s.spacing_mm, between(5.0, 100.0, "mm"), "Spacing of neighbouring dots");
  addSetting(command, "--columns", s.columns, between(2, 60), "Dots across");
  addSetting(command, "--rows", s.rows, between(2, 60), "Dots along the spine");
  addSetting(command, "--hole-mm", s.hole_mm, between(1.0, 50.0, "mm"), "Diameter of a hole; at most half the spacing");
  addChoice(command, "--page", s.page,
            Choices<StencilPage>{{"auto", StencilPage::fitting},
                                 {"a4", StencilPage::a4},
                                 {"a3", StencilPage::a3},
                                 {"a2", StencilPage::a2},
                                 {"tiled-a4", StencilPage::tiled_a4}},
            "Paper size; tiled-a4: one file per sheet, to glue together");
  command.add_flag("--scale-target", s.scale_target, "Add a ruler of 100 mm to tape onto the skin");
  namesFileToWrite(command.add_option("-o,--out", arguments.output, "Drawing to write: .svg"))->required();
}

}  // namespace palpate::app
