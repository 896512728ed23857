// Measures kernels against two fixed loops, and compares the ratios with those of another day: the regression guard of
// `palpate study bench --baseline`.
//
// A kernel's time divided by a loop's, taken at the same moment, says more about the kernel than its time does: a
// slower processor, or a busy one, slows both.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lab/kernels/kernel_list.h"

namespace palpate::bench {

/// Two fixed pieces of work that never change.
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

struct KernelTime {
  std::string name;
  std::string item;
  double ns = 0.0;     ///< an item
  double ratio = 0.0;  ///< `ns` over a step of the reference loop that suits the kernel's burden
};

/// Goes round all kernels, each with its reference loop, for about `seconds`; at least three rounds, the shortest
/// processor times count.
std::vector<KernelTime> timeKernels(std::span<const Kernel> kernels, double seconds);

struct Comparison {
  std::string name;
  std::optional<double> before, now;  ///< ratios; none where one side does not know the kernel
  bool slower = false;                ///< by more than the tolerance
  /// Now over before: above 1 is slower.
  double change() const { return before && now ? *now / *before : 1.0; }
};

/// In the order of `now`, then what only `before` knows. `tolerance` 0.3 lets a ratio grow by 30 %.
std::vector<Comparison> compared(std::span<const KernelTime> before, std::span<const KernelTime> now, double tolerance);

}  // namespace palpate::bench
