// The skin under a press as it was measured or simulated: places by their distance from the axis, depth by depth.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace palpate::tissue {

/// Under one depth of the indenter. By radius.
struct SkinProfile {
  double depth_mm = 0.0;
  std::vector<double> radius_mm;   ///< of the place at rest, >= 0
  std::vector<double> down_mm;     ///< into the body
  std::vector<double> outward_mm;  ///< away from the axis; empty: not measured
};

/// A header names the columns depth_mm, r_mm, down_mm and, where it was measured, outward_mm; other columns are left
/// alone. Rows of one depth belong together. By depth. Throws Error: file:line for a row that is not that, the file's
/// name when it holds no row. Files of at most 64 MB.
std::vector<SkinProfile> readSkinProfiles(const std::filesystem::path& file);

/// The same from text; `name` stands for the file in messages.
std::vector<SkinProfile> parseSkinProfiles(std::string_view text, std::string_view name);

}  // namespace palpate::tissue
