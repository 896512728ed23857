// A folder made for the files that will be written into it.
#pragma once

#include <filesystem>
#include <system_error>
#include <vector>

namespace palpate {

/// Made with those above it; those that were made and are still empty go with this object.
class MadeFolder {
 public:
  /// Throws Error, with the system's reason. An empty name is the folder where we are.
  explicit MadeFolder(const std::filesystem::path& folder);
  /// The same with the reason in `error`, which is clear if the folder exists.
  MadeFolder(const std::filesystem::path& folder, std::error_code& error);
  ~MadeFolder();
  MadeFolder(const MadeFolder&) = delete;
  MadeFolder& operator=(const MadeFolder&) = delete;

 private:
  std::vector<std::filesystem::path> made_;  ///< the innermost first
};

}  // namespace palpate
