// A picture without its background: drawn once on white and once on black, each pixel tells how much of it was covered.
// So edges, transparent skin and everything else that lets the background through stay as transparent as they are.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "palpate/view/image.h"

namespace palpate::view {

/// Colours not mixed with any background, and how opaque each pixel is (0 to 255).
struct CutOut {
  Image image;
  std::vector<std::uint8_t> opacity;
};

/// Both pictures show the same and have one size.
CutOut cutOut(const Image& on_white, const Image& on_black);

/// With transparency. Throws Error naming the file.
void writePng(const std::filesystem::path& file, const CutOut& picture);

}  // namespace palpate::view
