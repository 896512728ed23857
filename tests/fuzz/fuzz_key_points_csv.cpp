// Any bytes as a table of key points: usable ellipses or one Error.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "palpate/base/error.h"
#include "palpate/maps/ellipse_map.h"
#include "palpate/maps/key_points.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace palpate::maps;
  std::vector<KeyPoint> keys;
  try {
    keys = parseKeyPoints({reinterpret_cast<const char*>(data), size}, "fuzz.csv");
  } catch (const palpate::Error& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) __builtin_trap();
    return 0;
  }
  const Ellipse ellipse = EllipseMap(keys).at(0.0, 0.0);
  if (!(ellipse.aspect > 0.0 && ellipse.aspect <= 1.0)) __builtin_trap();
  return 0;
}
