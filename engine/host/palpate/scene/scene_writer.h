// Writes a scene as the file that reads back the same: the way out of the viewer for all that was changed in it.
//
// Every key of the format writes its own value (key_table.h), so a new key is written without anything to add here.
// Keys that have their default value are left out: the file stays as short as a person's.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/scene/scene.h"
#include "palpate/scene/scene_file.h"

namespace palpate::scene {

/// The text. Files that the scene names are written relative to `folder` where they lie under it, else with their full
/// path. Comments of the file the scene came from are lost; patchedScene keeps them.
std::string sceneAsToml(const Scene& scene, const std::filesystem::path& folder = {});

/// The row's value as in a file of this folder: names of files under it are relative to it.
std::string valueIn(const std::filesystem::path& folder, const KeyRow& row);
/// "key = value", a line for each row that differs from its row of `defaults`.
std::string linesOf(const std::vector<KeyRow>& rows, const std::vector<KeyRow>& defaults,
                    const std::filesystem::path& folder);

/// Writes it, complete or not at all. Throws Error naming the file.
void save(const Scene& scene, const std::filesystem::path& file);

/// Saves a scene into the file that a person wrote: only the changed lines are touched, so that comments, order and
/// layout stay. The TOML library reads comments away and cannot write them again; it does say where each key and value
/// is.
///
/// The text of a scene file, changed to mean `scene`; `file` is where it will lie. Lines that hold nothing but a
/// comment are never lost. Nothing when the text does not read back as the scene: it is not a scene file, or holds its
/// tables in a form that is not patched (keys to be added to `friction.static = 1`, or tables to a list in brackets).
std::optional<std::string> patchedScene(std::string_view text, const Scene& scene, const std::filesystem::path& file);

}  // namespace palpate::scene
