// A new archive for minizip, whose own functions take file names in the system's code page.
#pragma once

#include <zip.h>

#include <filesystem>

namespace palpate::app {

/// Null where it cannot be made.
zipFile newZipArchive(const std::filesystem::path& file);

}  // namespace palpate::app
