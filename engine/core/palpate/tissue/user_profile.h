// A displacement profile that the user measured or drew: rows of q and value in a text table, checked, interpolated.
//
// The table is comma-separated, a header and comments are allowed (base/csv.h): q ascends from 0 to 1, the value begins
// at 1 and ends at 0; in between it may go below 0 (a bulge around the finger).
// Based on: Fritsch, Butland, "A method for constructing local monotone piecewise cubic interpolants", 1984: no
// overshoot between the rows, hence no ripples on the skin that were not measured.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "palpate/tissue/force_law.h"
#include "palpate/tissue/profile_curve.h"

namespace palpate::tissue {

/// Throws Error naming file and line for a row that is not two finite numbers or breaks one of the rules above, and for
/// a table with less than two rows.
std::vector<ProfileKnot> parseProfileKnots(std::string_view text, std::string_view file);

/// The same from a file of at most 1 MB.
std::vector<ProfileKnot> readProfileKnots(const std::filesystem::path& file);

/// The same rules for rows that did not come from a file; messages count rows from 1.
void checkProfileKnots(std::span<const ProfileKnot> knots);

/// The slope at every row (monotone cubic), or of the line that begins there (linear).
std::vector<double> knotSlopes(std::span<const ProfileKnot> knots, UserInterpolation interpolation);

/// At 0 <= q <= 1. O(log rows), no allocation.
ProfilePoint interpolatedKnots(std::span<const ProfileKnot> knots, std::span<const double> slopes,
                               UserInterpolation interpolation, double q) noexcept;

// Reads a measured force law from a table: depth_mm,force_n, the force being that where the stiffness is 1 N/mm.

/// Rows `depth_mm,force_n`, a header line allowed. Depths increase, forces do not decrease; a first row 0,0 may be
/// written or left out. Throws Error: file:line for a row that is not two numbers or breaks that order, for more than
/// ForceTable::kMaxRows rows; the file's name when it has no row below the skin or cannot be read.
ForceTable readForceTable(const std::filesystem::path& file);

/// The same from text; `name` stands for the file in messages.
ForceTable parseForceTable(std::string_view text, std::string_view name);

}  // namespace palpate::tissue
