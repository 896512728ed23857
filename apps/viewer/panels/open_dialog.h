// The open dialog beyond drawing it (panels.h).
#pragma once

#include <filesystem>

namespace palpate::viewer {

/// Where it looks from now on; else where it looked last, in the beginning the working folder.
void showFolder(const std::filesystem::path& folder);

}  // namespace palpate::viewer
