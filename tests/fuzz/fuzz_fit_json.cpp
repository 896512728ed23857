// Any bytes as a fit that fit-body kept beside a scene: a placement that can be used, the same when written and read
// again, or one Error that names the place.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "palpate/base/error.h"
#include "palpate/body/fitting/body_fit.h"

namespace {

bool usable(const palpate::body::BodyFit& fit) {
  const palpate::body::BodyPlacement& at = fit.placement;
  bool sound = at.rotation.allFinite() && at.translation.allFinite() && std::abs(at.rotation.determinant() - 1) < 1e-3;
  sound = sound && at.scale() > 0 && std::isfinite(fit.certainty) && std::isfinite(fit.rms_mm);
  for (const palpate::body::Move& move : fit.skin_moves) sound = sound && move.place.allFinite() && move.by.allFinite();
  for (const palpate::body::NamedPoint& point : fit.points) sound = sound && point.position.allFinite();
  for (const double expected : fit.expected_mm) sound = sound && std::isfinite(expected);
  return sound;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  palpate::body::BodyFit fit;
  try {
    fit = palpate::body::fitFromJson({reinterpret_cast<const char*>(data), size}, "fuzz.fit.json");
  } catch (const palpate::Error& error) {
    const std::string_view said = error.what();
    if (!said.starts_with("fuzz.fit.json") || said.find('\n') != std::string_view::npos) __builtin_trap();
    return 0;
  }
  if (!usable(fit)) __builtin_trap();
  const std::string written = palpate::body::fitAsJson(fit);
  if (palpate::body::fitAsJson(palpate::body::fitFromJson(written, "again")) != written) __builtin_trap();
  return 0;
}
