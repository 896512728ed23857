// Any bytes as measured forces: a law with finite numbers and a table that a scene reads, or one Error.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "palpate/base/error.h"
#include "palpate/tissue/fitting/force_fit.h"
#include "palpate/tissue/fitting/force_rows.h"
#include "palpate/tissue/user_profile.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace palpate::tissue;
  constexpr std::size_t kQuickBytes = 2000;
  if (size > kQuickBytes) return 0;
  try {
    const auto curves = parseForceCurves({reinterpret_cast<const char*>(data), size}, "fuzz.csv");
    for (const ForceForm form : kForceForms) {
      const ForceFit fit = fitForce(curves.front(), form, {.free_offset = size % 2 == 0});
      if (!std::isfinite(fit.secant.value) || !std::isfinite(fit.rms)) __builtin_trap();
      const ForceTable table = tableOf(fit);
      if (table.rows == 0 || !std::isfinite(forceIn(table, 5.0))) __builtin_trap();
    }
  } catch (const palpate::Error& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) __builtin_trap();
  }
  return 0;
}
