// Any bytes as a table of contours: a map of finite radii, or one Error.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "palpate/base/error.h"
#include "palpate/maps/contour_map.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace palpate::maps;
  try {
    const PolarContourMap map(parseContourPoints({reinterpret_cast<const char*>(data), size}, "fuzz.csv"));
    const PolarContour contour = map.at(1.0, 2.0);
    for (std::size_t i = 0; i < map.radii(); ++i) {
      if (!(std::exp(contour.log_radii[i]) > 0.0) || !std::isfinite(contour.log_radii[i])) __builtin_trap();
    }
  } catch (const palpate::Error& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) __builtin_trap();
  }
  return 0;
}
