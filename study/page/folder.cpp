#include "study/page/folder.h"

#include <system_error>

#include "palpate/base/error.h"

namespace palpate::study {

void makeFolder(const std::filesystem::path& folder) {
  std::error_code trouble;
  std::filesystem::create_directories(folder, trouble);
  if (trouble) throw Error::inFile(folder.string(), "cannot be made: " + trouble.message());
  if (!std::filesystem::is_directory(folder)) throw Error::inFile(folder.string(), "is not a folder");
}

}  // namespace palpate::study
