// Measured forces by depth, as a stranger's table holds them: one curve a place, or all of one.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace palpate::tissue {

/// Rows as they were measured, in any order; depths count from where the tip met the skin or was thought to.
struct ForceCurve {
  std::string name;              ///< name of the place; empty: the table names none
  std::vector<double> depth_mm;  ///< may be below 0: before the contact
  std::vector<double> force_n;
};

/// A header names the columns: depth_mm, force_n and, wanted or not, one of curve, place, id; other columns are left
/// alone. Without a header a row is depth_mm,force_n. Curves in the order in which they first appear. Throws Error:
/// file:line for a row that is not that, the file's name when it holds no row. Files of at most 64 MB.
std::vector<ForceCurve> readForceCurves(const std::filesystem::path& file);

/// The same from text; messages call the file `name`.
std::vector<ForceCurve> parseForceCurves(std::string_view text, std::string_view name);

}  // namespace palpate::tissue
