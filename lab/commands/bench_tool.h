// `palpate study bench contact --tool`: a tool of several pads instead of one finger.
#pragma once

#include <string>
#include <vector>

#include "lab/runs/tool_run.h"

namespace palpate::app {

/// What --tool takes.
inline std::vector<std::string> benchToolNames() { return bench::toolNames(); }

struct BenchToolArguments {
  std::string mesh, trajectory, tool;
  double stiffness_n_per_mm = 0.5;
  contact::FingerSettings finger;  ///< its radius is not looked at
  bench::Window window;
  bool json = false;
};

/// Measures and prints. Throws Error.
void runToolBench(const BenchToolArguments& arguments);

}  // namespace palpate::app
