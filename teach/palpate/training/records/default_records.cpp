#include "palpate/training/records/default_records.h"

#include <cstdlib>

#include "palpate/base/error.h"

namespace palpate::training {

std::filesystem::path defaultRecords() {
  const std::filesystem::path name = "palpate/palpate.results";
  // The specification of base directories: a relative path there is to be ignored.
  if (const char* data = std::getenv("XDG_DATA_HOME"); data != nullptr && *data == '/') {
    return std::filesystem::path(data) / name;
  }
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0') {
    return std::filesystem::path(home) / ".local/share" / name;
  }
  throw Error("neither XDG_DATA_HOME nor HOME says where records are kept; name a file");
}

}  // namespace palpate::training
