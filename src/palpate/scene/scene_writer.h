// Writes a scene as the file that reads back the same: the way out of the viewer for all that was changed in it.
//
// Every key of the format says itself how its value stands in a file (key_table.h), so a new key is written without
// anything to add here. Keys that have their default value are left out: the file stays as short as a person's.
#pragma once

#include <filesystem>
#include <string>

#include "palpate/scene/scene.h"

namespace palpate::scene {

/// The text. Files that the scene names are written relative to `folder` where they lie under it, else with their full
/// path. Comments of the file the scene came from are lost; scene_patch.h keeps them.
std::string sceneAsToml(const Scene& scene, const std::filesystem::path& folder = {});

/// Writes it, complete or not at all. Throws Error naming the file.
void save(const Scene& scene, const std::filesystem::path& file);

}  // namespace palpate::scene
