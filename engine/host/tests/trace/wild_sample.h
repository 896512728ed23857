// Samples of any bits at all.
#pragma once

#include <cstdint>

#include "palpate/base/random.h"
#include "palpate/trace/sample_block.h"

namespace palpate::trace {

/// Also such that are no number; they do not pack, so a file of them is large.
inline Sample wildSample(Random& random, std::uint64_t tick, std::uint32_t finger) {
  Sample sample;
  for (const SampleColumn& column : sampleColumns()) {
    const std::uint64_t bits =
        (std::uint64_t{random.below(1u << 31)} << 33) ^ (std::uint64_t{random.below(1u << 31)} << 7);
    column.set(sample, column.name == "touch" ? random.below(3) : bits);
  }
  sample.tick = tick;
  sample.finger = finger;
  return sample;
}

}  // namespace palpate::trace
