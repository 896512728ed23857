// Keys as lines of a scene file: what the writer of whole files and the patch of a person's file have in common.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "palpate/scene/scene_file.h"

namespace palpate::scene {

/// The row's value as it stands in a file of this folder: names of files that lie under it are relative to it.
std::string valueIn(const std::filesystem::path& folder, const KeyRow& row);

/// "key = value", a line for each row that says something else than its row of `defaults`.
std::string linesOf(const std::vector<KeyRow>& rows, const std::vector<KeyRow>& defaults,
                    const std::filesystem::path& folder);

}  // namespace palpate::scene
