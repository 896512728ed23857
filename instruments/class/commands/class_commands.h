// The subcommands of `palpate class`, one file per command.
#pragma once

#include "cli/kit/options.h"
#include "palpate/base/json.h"
#include "palpate/classroom/class_board.h"

namespace palpate::app {

// `parent` is the class command.
void addClassInitCommand(Command& parent);
void addClassAddStationCommand(Command& parent);
void addClassRemoveStationCommand(Command& parent);
void addClassAddInstructorCommand(Command& parent);
void addClassRenewCommand(Command& parent);
void addClassServeCommand(Command& parent);
void addClassCheckCommand(Command& parent);
void addClassWatchCommand(Command& parent);
void addClassLoadCommand(Command& parent);

/// A station as `palpate class watch --json` prints it.
Json tileJson(const classroom::Tile& tile);

}  // namespace palpate::app
