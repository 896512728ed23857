// Reports of `palpate tissue realism` next to its figure: with --living and with --radius.
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "palpate/base/json.h"
#include "palpate/base/progress.h"

namespace palpate::app {

/// `palpate tissue realism --living`, for programs and for people. Throws Error as lab::readLivingTests does.
std::pair<Json, std::string> judgeLiving(const std::filesystem::path& list_or_folder, const Progress& progress);

/// `palpate tissue realism --radius`: solves spheres of 2, 4, 8, 12 and 16 mm at three depths each over six places of a
/// body, and presses the product's own fingers there (some two minutes).
Json judgeRadius(const Progress& progress);

}  // namespace palpate::app
