// Tests where a command is going to write, before its long work; leaves nothing behind on failure.
#pragma once

#include <filesystem>

#include "cli/kit/options.h"

namespace palpate::app {

/// Throws as writing the file would: a folder that cannot be made, rights, a read-only disk. Leaves nothing; pipes and
/// devices are not tried.
void requireWritableFile(const std::filesystem::path& file);

/// Throws where no folder can be made or written to. Leaves nothing.
void requireWritableFolder(const std::filesystem::path& folder);

// The same for an option, as soon as the command line is read; returns the option.

Option* namesFileToWrite(Option* option);
Option* namesFolderToWrite(Option* option);

}  // namespace palpate::app
