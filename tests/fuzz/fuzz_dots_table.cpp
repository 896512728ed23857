// Any bytes as a table of dots, and what it holds measured where that is soon done: a Measurement or one Error.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "palpate/base/error.h"
#include "palpate/measure/overlay.h"
#include "palpate/measure/tables/dot_table.h"

namespace {

/// Enough for a grid and a fit; of more dots the contour takes seconds under the sanitizers.
constexpr std::size_t kMaxMarks = 40;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace palpate::measure;
  try {
    const DotPair pair = parseDotTable({reinterpret_cast<const char*>(data), size}, "fuzz.csv");
    if (pair.before.size() > kMaxMarks || pair.after.size() > kMaxMarks) return 0;
    const Measurement measured = measureDots(pair);
    if (measured.accepted() && !std::isfinite(measured.fit->at_2_mm.half_major_mm.value)) __builtin_trap();
    for (const OverlayPanel& panel : buildOverlay(measured).panels) {
      for (const OverlayLine& line : panel.lines) {
        for (const palpate::Vec2& place : line.places_px) {
          if (!place.allFinite()) __builtin_trap();
        }
      }
    }
  } catch (const palpate::Error& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) __builtin_trap();
  }
  return 0;
}
