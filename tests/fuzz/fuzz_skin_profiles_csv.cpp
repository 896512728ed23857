// Any bytes as measured skin: fits with finite shapes, or one Error.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "palpate/base/error.h"
#include "palpate/tissue/fitting/profile_fit.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace palpate::tissue;
  constexpr std::size_t kQuickBytes = 2000;
  if (size > kQuickBytes) return 0;
  try {
    const auto profiles = parseSkinProfiles({reinterpret_cast<const char*>(data), size}, "fuzz.csv");
    const std::vector<double> radii = tableRadii(profiles.front().radius_mm.back());
    for (const ProfileForm form : kProfileForms) {
      const PressedShape shape = shapeOf(fitProfile(profiles.front(), form), radii);
      for (const double share : shape.down) {
        if (!std::isfinite(share)) __builtin_trap();
      }
      for (const double share : shape.outward) {
        if (!std::isfinite(share)) __builtin_trap();
      }
    }
  } catch (const palpate::Error& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) __builtin_trap();
  }
  return 0;
}
