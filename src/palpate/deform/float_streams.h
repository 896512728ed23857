// Several float arrays of one length in one allocation, each on a cache line and none on the same place of its page.
//
// A kernel that walks fifteen arrays side by side stalls when they all start at the same offset of a 4 KiB page: loads
// and stores then look as if they hit each other (4K aliasing). Array i starts 256 (first_phase + i) bytes further into
// its page than the allocation does; large allocations start at the same place of a page.
#pragma once

#include <span>

#include "palpate/base/aligned.h"

namespace palpate::deform {

class FloatStreams {
 public:
  FloatStreams() = default;
  FloatStreams(std::size_t count, std::size_t length, std::size_t first_phase)
      : stride_(paddedToPage(length) + kPhaseFloats), first_(first_phase * kPhaseFloats) {
    values_.assign(first_ + count * stride_, 0.0f);
  }

  float* operator[](std::size_t i) { return values_.data() + first_ + i * stride_; }
  const float* operator[](std::size_t i) const { return values_.data() + first_ + i * stride_; }

 private:
  static constexpr std::size_t kPageFloats = 1024;
  static constexpr std::size_t kPhaseFloats = 64;
  static std::size_t paddedToPage(std::size_t n) { return (n + kPageFloats - 1) / kPageFloats * kPageFloats; }

  AlignedVector<float> values_;
  std::size_t stride_ = 0;
  std::size_t first_ = 0;
};

}  // namespace palpate::deform
