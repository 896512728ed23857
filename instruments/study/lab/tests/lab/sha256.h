// SHA-256 of bytes, to compare what we generate with published check sums.
#pragma once

#include <string>
#include <string_view>

namespace palpate::test {

/// 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

/// A check sum that was published.
struct Published {
  const char* name;
  const char* sha256;
};

}  // namespace palpate::test
