// A new archive for minizip, whose own functions take the name of a file as the system's code page has it.
#pragma once

#include <zip.h>

#include <filesystem>

namespace palpate::app {

/// Null where it cannot be made.
zipFile newZipArchive(const std::filesystem::path& file);

}  // namespace palpate::app
