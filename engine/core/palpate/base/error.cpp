// Puts each message together once. Its parts are found again by their lengths, so the file must come first and the
// cause last; a byte's offset goes into the cause. Cold paths only.
#include "palpate/base/error.h"

#include <fmt/format.h>

namespace palpate {

Error Error::inFile(std::string_view file, std::string_view cause) {
  return {fmt::format("{}: {}", file, cause), file, 0, cause};
}

Error Error::atLine(std::string_view file, std::size_t line, std::string_view cause) {
  return {fmt::format("{}:{}: {}", file, line, cause), file, line, cause};
}

Error Error::atByte(std::string_view file, std::uint64_t offset, std::string_view cause) {
  return inFile(file, fmt::format("byte {}: {}", offset, cause));
}

}  // namespace palpate
