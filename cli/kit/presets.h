// Scenes that are known by a word: `--preset vhb`. They are compiled in, as the default scene is.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "palpate/scene/scene.h"

namespace palpate::app {

/// "vhb", "vhb-literal"
std::vector<std::string> presetNames();

/// Adds --preset.
void addPresetOption(CLI::App& command, std::string& preset);

/// Throws Error for another name.
scene::Scene presetScene(const std::string& name);

}  // namespace palpate::app
