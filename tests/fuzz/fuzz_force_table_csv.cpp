// Any bytes as a force table: a law whose force never falls with depth by more than rounding (on a flat stretch it is
// secant x depth), or one Error.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "palpate/base/error.h"
#include "palpate/tissue/user_profile.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace palpate::tissue;
  ForceLaw law;
  law.kind = ForceLaw::Kind::table;
  try {
    law.table = parseForceTable({reinterpret_cast<const char*>(data), size}, "fuzz.csv");
    check(law);
  } catch (const palpate::Error& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) __builtin_trap();
    return 0;
  }
  double last = 0.0;
  for (double depth = 0.0; depth <= 60.0; depth += 0.5) {
    const double force = normalForce(law, 1.0, depth);
    if (!(force >= last * (1.0 - 1e-12))) __builtin_trap();
    last = force;
  }
  return 0;
}
