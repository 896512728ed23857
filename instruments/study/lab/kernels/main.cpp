// The Google Benchmark suite: the engine's kernels (instruments/study/lab/kernels/kernel_list.h), one benchmark each.
//
// Based on: Google Benchmark's user guide, https://github.com/google/benchmark/blob/main/docs/user_guide.md
#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "lab/counters/machine.h"
#include "lab/kernels/kernel_list.h"
#include "palpate/base/system/signals.h"
#include "palpate/scene/host.h"

namespace palpate::bench {
namespace {

constexpr std::string_view kTrianglesOption = "--triangles=";
constexpr std::size_t kDefaultTriangles = 41582;  // the dissertation's largest model

/// Takes our own option out of the command line, where Google Benchmark would not know it.
std::size_t extractTrianglesOption(int& count, char** arguments) {
  std::size_t triangles = kDefaultTriangles;
  int kept = 0;
  for (int i = 0; i < count; ++i) {
    const std::string_view argument = arguments[i];
    if (argument.starts_with(kTrianglesOption)) {
      triangles = std::strtoul(argument.data() + kTrianglesOption.size(), nullptr, 10);
    } else {
      arguments[kept++] = arguments[i];
    }
  }
  count = kept;
  return triangles;
}

void run(benchmark::State& state, const Kernel& kernel) {
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(kernel.run());
  state.counters["per_" + kernel.item] = benchmark::Counter(kernel.items * static_cast<double>(state.iterations()),
                                                            benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

}  // namespace
}  // namespace palpate::bench

int main(int argc, char** argv) {
  using palpate::bench::Kernel;
  palpate::system::makeFailedWritesErrors();
  palpate::installHost();
  const std::size_t triangles = palpate::bench::extractTrianglesOption(argc, argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  if (triangles < 1000) {
    std::fputs("palpate_kernels: --triangles must be at least 1000\n", stderr);
    return 2;
  }
  benchmark::AddCustomContext("machine", palpate::lab::describeMachine(palpate::lab::thisMachine()));
  benchmark::AddCustomContext("triangles", std::to_string(triangles));
  for (const Kernel& kernel : palpate::bench::makeKernels(triangles)) {
    benchmark::RegisterBenchmark(kernel.name.c_str(), palpate::bench::run, kernel)->Unit(benchmark::kMicrosecond);
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
