// Reads /proc, the scheduler and the build. SIMD is the best set that was compiled and that this processor has.
#include "lab/counters/machine.h"

#include <fmt/format.h>
#include <hwy/targets.h>

#include <fstream>
#include <thread>

#include "palpate/base/text.h"

#ifdef __linux__
#include <sched.h>
#include <sys/utsname.h>
#include <unistd.h>
#endif

namespace palpate::lab {

namespace {

/// The value of the first line "<key> : <value>" of a file.
std::string readProcField(const char* file, std::string_view key) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const std::size_t colon = line.find(':');
    if (colon != std::string::npos && trimmed(std::string_view(line).substr(0, colon)) == key) {
      return std::string(trimmed(std::string_view(line).substr(colon + 1)));
    }
  }
  return "unknown";
}

std::string compilerName() {
#if defined(__clang__)
  return fmt::format("clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#elif defined(__GNUC__)
  return fmt::format("gcc {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#else
  return "unknown";
#endif
}

/// Dispatch takes the best of the sets that were compiled and that the processor has; better sets are lower bits.
std::string simdName() {
  const std::int64_t usable = hwy::SupportedTargets() & HWY_TARGETS;
  return hwy::TargetName(usable & -usable);
}

#ifdef __linux__

unsigned usableCores() {
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) != 0) return std::thread::hardware_concurrency();
  return static_cast<unsigned>(CPU_COUNT(&set));
}

double memoryGb() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE)) * 1e-9;
}

std::string kernelName() {
  utsname names{};
  if (uname(&names) != 0) return "unknown";
  return fmt::format("{} {} {}", names.sysname, names.release, names.machine);
}

#else

unsigned usableCores() { return std::thread::hardware_concurrency(); }
double memoryGb() { return 0.0; }
std::string kernelName() { return "unknown"; }

#endif

}  // namespace

Machine thisMachine() {
  return {.cpu = readProcField("/proc/cpuinfo", "model name"),
          .cores = usableCores(),
          .memory_gb = memoryGb(),
          .kernel = kernelName(),
          .compiler = compilerName(),
          .build = std::string(trimmed(PALPATE_BUILD_FLAGS)),
          .simd = simdName(),
          .palpate = PALPATE_VERSION};
}

std::string describeMachine(const Machine& m) {
  return fmt::format("{}, {} cores, {:.1f} GB, {}, SIMD {}; palpate {}, {}, {}", m.cpu, m.cores, m.memory_gb, m.kernel,
                     m.simd, m.palpate, m.compiler, m.build);
}

}  // namespace palpate::lab
