// Saves a scene into the file that a person wrote: only the lines of what was changed are touched, so that comments,
// order and layout stay. The TOML library reads comments away and cannot write them again; it does say where each key
// and value stands.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "palpate/scene/scene.h"

namespace palpate::scene {

/// The text of a scene file, changed to say what `scene` says; `file` is where it will lie. Lines that hold nothing but
/// a comment are never lost. Nothing when the text does not read back as the scene: it is no scene file, or holds its
/// tables in a form that is not patched (keys to be added to `friction.static = 1`, or tables to a list in brackets).
std::optional<std::string> patchedScene(std::string_view text, const Scene& scene, const std::filesystem::path& file);

}  // namespace palpate::scene
