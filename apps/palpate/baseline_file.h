// The file of `palpate bench --baseline`: ratios of kernels to fixed reference loops, measured on some machine.
#pragma once

#include <filesystem>
#include <vector>

#include "bench/kernel_times.h"

namespace palpate::app {

struct Baseline {
  std::size_t triangles = 0;  ///< of the back that the kernels ran on
  std::vector<bench::KernelTime> kernels;
};

/// Throws Error (file: cause) for a file that is no baseline or holds a ratio that is not above 0.
Baseline readBaseline(const std::filesystem::path& file);

/// With the machine it was measured on, for people. Throws Error if it cannot.
void writeBaseline(const std::filesystem::path& file, const Baseline& baseline);

}  // namespace palpate::app
