// User-facing text of any exception.
#pragma once

#include <exception>
#include <new>
#include <string>

namespace palpate {

/// what() for all but memory that ran out, which the standard library names in its own words.
inline std::string textOf(const std::exception& error) {
  return dynamic_cast<const std::bad_alloc*>(&error) != nullptr ? "memory ran out" : error.what();
}

}  // namespace palpate
