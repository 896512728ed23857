// Where a command is going to write: tried before its long work, and nothing empty is left where that fails.
#pragma once

#include <filesystem>

#include "cli/kit/options.h"

namespace palpate::app {

/// Throws what writing the file would: a folder that cannot be made, rights, a read-only disk. Leaves nothing; pipes
/// and devices are not tried.
void requireWritableFile(const std::filesystem::path& file);

/// Throws where no folder can be made there, or nothing be written into it. Leaves nothing.
void requireWritableFolder(const std::filesystem::path& folder);

// The same for an option, as soon as the command line is read; the option is handed back.

Option* namesFileToWrite(Option* option);
Option* namesFolderToWrite(Option* option);

}  // namespace palpate::app
