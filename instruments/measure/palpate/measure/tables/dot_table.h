// Dots as a table in place of photographs: found by another program, or corrected by hand.
//
//   DOTS.csv ─ readDotTable ─► DotPair ─► measureDots (measurement.h)
//
// A row a mark: picture,x_px,y_px[,area_px], picture being before or after; the header names these columns. Pixels are
// counted from the centre of the top left one, x to the right, y down.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "palpate/measure/measurement.h"

namespace palpate::measure {

/// Throws Error with the line for a missing header, a wrong number of fields, another word than before and after, a
/// number that is invalid or out of range; with the file where a picture has no marks or more than kMaxTableMarks.
DotPair readDotTable(const std::filesystem::path& file);
DotPair parseDotTable(std::string_view text, std::string_view file);

inline constexpr std::size_t kMaxTableMarks = 20'000;

/// All marks of a measurement as such a table, to be corrected and measured again.
std::string formatDotTable(const Measurement& measurement);

}  // namespace palpate::measure
