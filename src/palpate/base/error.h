// The one exception type of the cold paths (load, validate, build, command line).
//
// A message reads `where: cause`, in one line, so that a command can print it as it is. Hot paths never throw.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace palpate {

class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : std::runtime_error(message) {}

  /// `file: cause`
  static Error inFile(std::string_view file, std::string_view cause);
  /// `file:line: cause`, line counted from 1.
  static Error atLine(std::string_view file, std::size_t line, std::string_view cause);
  /// `file: byte offset: cause`, offset counted from 0.
  static Error atByte(std::string_view file, std::size_t offset, std::string_view cause);
};

}  // namespace palpate
