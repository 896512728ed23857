// Tables of presses: results of several measurements at the same places, of one person or of many.
//
//   measure dots, or a user's notes ─ readPresses ─► PressRow ─ averagePresses (average.h) ─► key points
//
// A header names the columns. Needed: name (or point), x_mm, y_mm, direction_deg, and the size as half_major_mm and
// major_over_minor or, as the dissertation prints it, as full axes major_cm and minor_cm (E16). Wanted where known:
// drag_deg, subject, press, sd_half_major_mm, sd_ratio, sd_direction_deg, half_major_4_mm, peak_mm,
// stiffness_n_per_mm; a field may be empty. Other columns are left alone.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/vec.h"

namespace palpate::measure {

/// One measured ellipse. A ratio below 1: the longer axis lies across the direction (E30).
struct PressRow {
  std::string point;
  Vec2 place_mm = Vec2::Zero();
  double half_major_mm = 0.0;
  double major_over_minor = 1.0;
  double direction_deg = 90.0;
  std::string subject = {};             ///< empty: all rows are of one
  std::optional<double> drag_deg = {};  ///< the way the skin was pulled, against +x
  std::optional<double> sd_half_major_mm = {};
  std::optional<double> sd_ratio = {};
  std::optional<double> sd_direction_deg = {};
  std::optional<double> half_major_4_mm = {};
  std::optional<double> peak_mm = {};
  std::optional<double> stiffness_n_per_mm = {};
};

/// Throws Error with the line for a missing column, a wrong number of fields, an invalid number or one out of range;
/// with the file for a table without rows. Files of at most 64 MB.
std::vector<PressRow> readPresses(const std::filesystem::path& file);
std::vector<PressRow> parsePresses(std::string_view text, std::string_view file);

}  // namespace palpate::measure
