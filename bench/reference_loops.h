// Two fixed pieces of work that never change. A kernel's time divided by theirs, taken at the same moment, says more
// about the kernel than its time does: a slower processor, or a busy one, slows both.
#pragma once

#include <vector>

namespace palpate::bench {

class ReferenceLoops {
 public:
  ReferenceLoops();

  /// Arithmetic on triangles that are found by following indices through 256 KB, more than a first cache holds: one
  /// dependent read, two cross products, one division and one square root a step. Does `kSteps` steps.
  double arithmetic();
  /// Adds to 256 KB of floats in place. Does `kFloats` floats.
  double memory();

  static constexpr int kSteps = 4096;
  static constexpr int kFloats = 65536;

 private:
  struct Triangle {
    double corners[7];  // seven numbers and the link: one cache line
    long next;
  };
  std::vector<Triangle> triangles_;
  std::vector<float> floats_;
  long place_ = 0;
};

}  // namespace palpate::bench
