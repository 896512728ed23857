// Scenes that are compiled in: the default one, and those that are known by a word, `--preset vhb`.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/kit/cli11.h"
#include "palpate/scene/scene.h"

namespace palpate::app {

/// "vhb", "vhb-literal"
std::vector<std::string> presetNames();

/// Adds --preset.
void addPresetOption(CLI::App& command, std::string& preset);

/// Throws Error for another name.
scene::Scene presetScene(const std::string& name);

// The scene that runs when none is named, and those that presets.h names.

/// The text of scenes/default.toml, built into the command.
std::string_view defaultScene();

/// The text of scenes/virtual_haptic_back.toml, likewise.
std::string_view virtualHapticBack();

}  // namespace palpate::app
