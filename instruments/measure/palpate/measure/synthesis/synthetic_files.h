// A synthetic pair as a folder of files: pictures as a camera leaves them, and the truth.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/measure/synthesis/synthetic_pair.h"

namespace palpate::measure {

/// "compact", "long", "half-space", "windowed".
std::string_view nameOf(TailFamily family);

/// One JSON object: the ellipses, contact, peak, drag, the body's motion, camera, marks, and every dot in both
/// pictures.
std::string truthJson(const SyntheticCase& made, const SyntheticTruth& truth);

/// before.jpg, before2.jpg (again before the press), after.jpg, with the times they were taken, and truth.json. The
/// folder must exist. Returns the files. Throws Error naming a file that cannot be written.
std::vector<std::filesystem::path> writeSynthetic(const std::filesystem::path& folder, const SyntheticCase& made,
                                                  const Progress& progress = {});

}  // namespace palpate::measure
