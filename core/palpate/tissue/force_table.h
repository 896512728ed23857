// Reads a measured force law from a table: depth_mm,force_n, the force being that where the stiffness is 1 N/mm.
#pragma once

#include <filesystem>
#include <string_view>

#include "palpate/tissue/force_law.h"

namespace palpate::tissue {

/// Rows `depth_mm,force_n`, a header line allowed. Depths increase, forces do not decrease; a first row 0,0 may be
/// written or left out. Throws Error: file:line for a row that is not two numbers or breaks that order, for more than
/// ForceTable::kMostRows rows; the file's name when it has no row below the skin or cannot be read.
ForceTable readForceTable(const std::filesystem::path& file);

/// The same from text; `name` stands for the file in messages.
ForceTable parseForceTable(std::string_view text, std::string_view name);

}  // namespace palpate::tissue
