// A picture file that a program wrote, read back.
#pragma once

#include <filesystem>

#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "palpate/view/image.h"

namespace palpate::support {

/// Throws Error naming the file.
inline view::Image readPng(const std::filesystem::path& file) {
  constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 30;
  view::Image image = view::decodeImage(readFile(file, kMaxBytes));
  if (image.pixels.empty()) throw Error::inFile(file.string(), "is not a picture that can be read");
  return image;
}

}  // namespace palpate::support
