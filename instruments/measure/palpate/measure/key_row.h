// A measurement as a row of a table of key points: the columns that maps read (maps/key_points.h), then the other
// measured values.
//
//   Measurement ─ keyRow ─► a line of key_points.csv ─► maps, `measure average`
#pragma once

#include <string>
#include <string_view>

#include "palpate/base/vec.h"
#include "palpate/measure/measurement.h"

namespace palpate::measure {

/// The names of the columns, with the line's end.
std::string keyRowHeader();

/// The row, with the line's end; empty where nothing was fitted. `place_mm` is where the contact lies on the body, seen
/// along z. A number that is not known is an empty field; so is tail_p of the half Gaussian, which is infinite.
std::string keyRow(const Measurement& measurement, std::string_view name, const Vec2& place_mm);

/// Returns the fault of a key point's name, which becomes a field of a table; empty: none.
std::string faultOfKeyName(std::string_view name);

}  // namespace palpate::measure
