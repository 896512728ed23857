// Any bytes as a displacement profile: finite values from 1 to 0, or one Error.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "palpate/base/error.h"
#include "palpate/tissue/profile_curve.h"
#include "palpate/tissue/user_profile.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace palpate::tissue;
  ProfileSettings settings;
  settings.kind = ProfileKind::user;
  try {
    settings.knots = parseProfileKnots({reinterpret_cast<const char*>(data), size}, "fuzz.csv");
    const ProfileCurve curve(settings);
    if (curve.at(0.0).value != 1.0 || curve.at(1.0).value != 0.0) __builtin_trap();
    for (double q = 0.0; q <= 1.0; q += 0.01) {
      if (!std::isfinite(curve.at(q).value)) __builtin_trap();
    }
  } catch (const palpate::Error& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) __builtin_trap();
  }
  return 0;
}
