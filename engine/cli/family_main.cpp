// The program of a family, which `palpate` starts (kit/families.h): the commands that PALPATE_ADD_COMMANDS, a function
// of the family's house, adds.
#include "cli/kit/commands.h"
#include "cli/kit/program.h"
#include "palpate/base/system/process.h"

namespace palpate::app {
void PALPATE_ADD_COMMANDS(Command& app);
}

int main(int argc, char** argv) {
  return palpate::app::runProgram([&] {
    palpate::app::Command app{"A part of Palpate: `palpate` starts it.", "palpate"};
    app.allow_windows_style_options(false);  // "/tmp" is a folder
    app.set_version_flag("--version", PALPATE_VERSION);
    app.require_subcommand(1);
    palpate::app::PALPATE_ADD_COMMANDS(app);
    return palpate::app::runCommandLine(app, palpate::system::commandLine(argc, argv));
  });
}
