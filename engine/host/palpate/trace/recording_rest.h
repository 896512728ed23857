// When a finger rests: it touches nothing, no force is on its way, no fault is near. A finger that has rested for a
// while remembers nothing that later ticks could feel, so from there a recording can be felt again without what was
// before.
//
// The longest memory is the ring of forces that the passivity observer keeps (servo/passivity.h, 16 ticks); the
// motion of two ticks before decides about a soft toe. Skin that relaxes remembers for as long as its dent is there
// (contact/relaxation.h). Only the warning "too stiff" looks further back: it counts a
// second of contact (servo/limiter.h), and changes no force.
#pragma once

#include "palpate/trace/sample.h"

namespace palpate::trace {

/// So many samples of rest, one after the other, are enough.
inline constexpr int kRestTicks = 16;

inline bool rests(const Sample& sample) noexcept {
  return sample.contact.touch == contact::Touch::free && sample.contact.status == 0 && sample.safety == 0 &&
         sample.contact.force.isZero(0.0) && sample.device_force.isZero(0.0) && !(sample.loss_n_mm > 0.0) &&
         !(sample.contact.dent.rest_mm > 0.0);
}

/// Watches one finger.
class RestWatch {
 public:
  /// The next sample; true once it has rested for long enough.
  bool add(const Sample& sample) noexcept {
    ticks_ = rests(sample) ? ticks_ + 1 : 0;
    return longEnough();
  }
  /// Samples of rest, up to the last one.
  int ticks() const noexcept { return ticks_; }
  bool longEnough() const noexcept { return ticks_ >= kRestTicks; }

 private:
  int ticks_ = 0;
};

}  // namespace palpate::trace
