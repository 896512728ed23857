// The scene that runs when none is named, and those that presets.h names.
#pragma once

#include <string_view>

namespace palpate::app {

/// The text of scenes/default.toml, built into the command.
std::string_view defaultScene();

/// The text of scenes/virtual_haptic_back.toml, likewise.
std::string_view virtualHapticBack();

}  // namespace palpate::app
