// The scene that runs when none is named.
#pragma once

#include <string_view>

namespace palpate::app {

/// The text of scenes/default.toml, built into the command.
std::string_view defaultScene();

}  // namespace palpate::app
