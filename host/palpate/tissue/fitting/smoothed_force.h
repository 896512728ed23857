// Measured rows as a force table: averaged where they lie close, and never falling.
#pragma once

#include <string>

#include "palpate/tissue/fitting/force_rows.h"
#include "palpate/tissue/force_law.h"

namespace palpate::tissue {

/// Rows below the skin as at most `most_rows` rows of a table; throws Error where no force is above 0.
ForceTable smoothedTable(const ForceRows& rows, const Eigen::ArrayXd& weights, std::size_t most_rows = 24);

/// N, as the rows say: straight between them, from the origin, on with the last slope. Without the law's scaling.
double forceIn(const ForceTable& table, double depth_mm);

/// As force_table.h reads it.
std::string forceTableText(const ForceTable& table);

}  // namespace palpate::tissue
