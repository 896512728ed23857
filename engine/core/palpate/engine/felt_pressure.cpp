// A pattern takes a microsecond or less; what is made of the world is shared by all of them.
#include "palpate/engine/felt_pressure.h"

#include <fmt/format.h>

#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/number_range.h"
#include "palpate/engine/touching.h"
#include "palpate/scene/lumps_of_body.h"
#include "palpate/servo/finger_solver.h"

namespace palpate::engine {

namespace {

// Ranges of the scene file's keys pad and pad_mm.
constexpr NumberRange kTaxels{static_cast<double>(contact::kMinTaxels), static_cast<double>(contact::kMaxTaxels)};
constexpr NumberRange kSizesMm{1.0, 100.0};

}  // namespace

bool isPad(const contact::PressurePad& pad) noexcept {
  return kTaxels.holds(static_cast<double>(pad.taxels)) && kSizesMm.holds(pad.size_mm);
}

void checkPad(const contact::PressurePad& pad) {
  if (!kTaxels.holds(static_cast<double>(pad.taxels))) {
    throw Error(fmt::format("pad = {}", outOfRange(fmt::format("{}", pad.taxels), kTaxels)));
  }
  if (!kSizesMm.holds(pad.size_mm)) {
    throw Error(fmt::format("pad_mm = {}", outOfRange(fmt::format("{}", pad.size_mm), kSizesMm)));
  }
}

FeltPressure::FeltPressure(std::shared_ptr<const scene::World> world)
    : world_(std::move(world)), ground_(scene::pressureGround(*world_)) {}

contact::PadSums FeltPressure::at(const contact::FingerOutput& felt, std::uint64_t tick,
                                  const contact::PressurePad& pad, std::span<double> kpa,
                                  std::span<Vec2> shear_kpa) const noexcept {
  const contact::Lumps* lumps = world_->surface.lumps.get();
  if (!world_->breath) return contact::pressureField(*ground_, lumps, felt, pad, kpa, shear_kpa);
  const contact::FingerOutput rested = servo::atRest(*world_->breath, felt, liftAt(*world_, tick));
  return contact::pressureField(*ground_, lumps, rested, pad, kpa, shear_kpa);
}

}  // namespace palpate::engine
