// The folder a study writes into.
#pragma once

#include <filesystem>

namespace palpate::study {

/// Makes the folder and its parents where they are missing. Throws Error naming it.
void makeFolder(const std::filesystem::path& folder);

}  // namespace palpate::study
