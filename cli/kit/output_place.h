// Where a command is going to write: tried before its long work, and nothing empty is left where that fails.
#pragma once

#include <filesystem>
#include <vector>

#include "cli/kit/options.h"

namespace palpate::app {

/// Throws what writing the file would: a folder that is missing, rights, a read-only disk. Leaves nothing; pipes and
/// devices are not tried.
void requireWritableFile(const std::filesystem::path& file);

/// Throws where no folder can be made there, or nothing be written into it. Leaves nothing.
void requireWritableFolder(const std::filesystem::path& folder);

// The same for an option, as soon as the command line is read; the option is handed back.

Option* namesFileToWrite(Option* option);
Option* namesFolderToWrite(Option* option);

/// A folder for results: made with those above it, and those that were made and are still empty go with this object.
class MadeFolder {
 public:
  /// Throws Error, with the system's reason. An empty name is the folder where we are.
  explicit MadeFolder(const std::filesystem::path& folder);
  ~MadeFolder();
  MadeFolder(const MadeFolder&) = delete;
  MadeFolder& operator=(const MadeFolder&) = delete;

 private:
  std::vector<std::filesystem::path> made_;  ///< the innermost first
};

}  // namespace palpate::app
