// The engine's inner loops one by one, on the benchmark's back: timed by the Google Benchmark suite
// (instruments/study/lab/kernels/) and watched by the regression guard (kernel_times.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace palpate::bench {

/// Main cost of a kernel; decides which fixed loop it is compared with.
enum class Burden : std::uint8_t {
  arithmetic,  ///< arithmetic and dependent reads that mostly hit the caches
  memory       ///< streaming through arrays
};

struct Kernel {
  std::string name;
  std::string item;    ///< unit of `items`: "tick", "vertex", ...
  double items = 0.0;  ///< done by one call of `run`
  Burden burden = Burden::arithmetic;
  std::function<double()> run;  ///< the same work in every call; a sum over all results, so that none is optimised away
};

/// All kernels on a back of this many triangles. Takes about a microsecond a triangle, once; kernels share the data
/// that they read and keep it alive.
std::vector<Kernel> makeKernels(std::size_t triangles);

/// Parts of makeKernels.
std::vector<Kernel> contactKernels(std::size_t triangles);
std::vector<Kernel> partitionKernels(std::size_t triangles);
std::vector<Kernel> deformationKernels(std::size_t triangles);

}  // namespace palpate::bench
