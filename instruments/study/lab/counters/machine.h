// The machine behind a result, so that a number is never shown without it.
#pragma once

#include <string>

namespace palpate::lab {

struct Machine {
  std::string cpu;         ///< the processor's own name, or "unknown"
  unsigned cores = 0;      ///< usable by this process
  double memory_gb = 0.0;  ///< machine's, 1e9 bytes
  std::string kernel;      ///< name, release and processor family of the system
  std::string compiler;    ///< name and version of what built the benchmark kit
  std::string build;       ///< build type and compiler flags
  std::string simd;        ///< widest instruction set that the kernels chose on this processor, as Highway calls it
  std::string palpate;     ///< version of this project
};

/// Reads system and build each time; some microseconds. Any thread.
Machine thisMachine();

/// One line without a line end.
std::string describeMachine(const Machine& machine);

}  // namespace palpate::lab
