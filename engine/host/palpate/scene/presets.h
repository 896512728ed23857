// Scenes that are compiled in and known by a word: the standard one, those of `--preset`, and the examples of the
// window's start page. Each is a file of examples/scenes/.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/scene/scene.h"

namespace palpate::scene {

struct Preset {
  std::string_view name;    ///< "heavy"
  std::string_view title;   ///< "A heavy person"
  std::string_view what;    ///< a sentence: what to feel or see
  std::string_view file;    ///< name in examples/scenes/, without .toml
  bool as_printed = false;  ///< with the dissertation's formulae as printed
};

/// In the order in which a newcomer may want them.
std::span<const Preset> presets();
std::vector<std::string> presetNames();

/// Without a file to save to. Throws Error for another name.
Scene presetScene(std::string_view name);
/// Throws Error for an unknown name.
const Preset& presetNamed(std::string_view name);

/// Text of examples/scenes/<file>.toml, compiled in (engine/host/CMakeLists.txt); empty if unknown.
std::string_view presetText(std::string_view file);

/// examples/scenes/default.toml: ten seconds of two fingers on the built-in trunk, where no scene is named. Without a
/// file.
Scene standardScene();

}  // namespace palpate::scene
