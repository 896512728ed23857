#include "palpate/base/error.h"

#include <fmt/format.h>

namespace palpate {

Error Error::inFile(std::string_view file, std::string_view cause) { return Error(fmt::format("{}: {}", file, cause)); }

Error Error::atLine(std::string_view file, std::size_t line, std::string_view cause) {
  return Error(fmt::format("{}:{}: {}", file, line, cause));
}

Error Error::atByte(std::string_view file, std::size_t offset, std::string_view cause) {
  return Error(fmt::format("{}: byte {}: {}", file, offset, cause));
}

}  // namespace palpate
