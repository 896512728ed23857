// Writes a figure to the requested file, in the format that its name implies.
#pragma once

#include <filesystem>

#include "report/charts/figure.h"

namespace palpate::app {

/// Throws Error for a name that ends in neither .png nor .svg: ask before the work that the picture shows.
void checkPictureName(const std::filesystem::path& file);

/// `png_scale`: pixels a CSS pixel.
void writePicture(const figures::Figure& figure, const std::filesystem::path& file,
                  double png_scale = figures::kPngScale);

}  // namespace palpate::app
