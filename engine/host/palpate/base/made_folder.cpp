#include "palpate/base/made_folder.h"

#include "palpate/base/error.h"

namespace palpate {

namespace fs = std::filesystem;

MadeFolder::MadeFolder(const fs::path& folder, std::error_code& error) {
  error.clear();
  const fs::path whole = folder.has_filename() ? folder : folder.parent_path();  // "monday/" is "monday"
  if (whole.empty()) return;
  std::error_code ignored;
  std::vector<fs::path> missing;
  for (fs::path part = whole; !part.empty() && !fs::exists(part, ignored); part = part.parent_path()) {
    missing.push_back(part);
  }
  fs::create_directories(whole, error);
  const bool stands = fs::is_directory(whole, ignored);
  if (stands) {
    error.clear();
    made_ = std::move(missing);
    return;
  }
  if (!error) error = std::make_error_code(std::errc::not_a_directory);
  for (const fs::path& part : missing) fs::remove(part, ignored);
}

MadeFolder::MadeFolder(const fs::path& folder) {
  std::error_code error;
  MadeFolder made(folder, error);
  if (error) throw Error::inFile(folder.string(), "cannot be created as a results folder: " + error.message());
  made_.swap(made.made_);
}

MadeFolder::~MadeFolder() {
  for (const fs::path& part : made_) {
    std::error_code ignored;
    fs::remove(part, ignored);  // refuses non-empty folders
  }
}

}  // namespace palpate
