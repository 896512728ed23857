// The subcommands of `palpate class`, a file each.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "palpate/classroom/class_watch.h"

namespace palpate::app {

// `parent` is the class command.
void addClassInitCommand(CLI::App& parent);
void addClassAddStationCommand(CLI::App& parent);
void addClassRemoveStationCommand(CLI::App& parent);
void addClassAddInstructorCommand(CLI::App& parent);
void addClassRenewCommand(CLI::App& parent);
void addClassServeCommand(CLI::App& parent);
void addClassCheckCommand(CLI::App& parent);
void addClassWatchCommand(CLI::App& parent);
void addClassLoadCommand(CLI::App& parent);

/// What `palpate class watch --json` prints of a station.
nlohmann::ordered_json tileJson(const classroom::Tile& tile);

}  // namespace palpate::app
