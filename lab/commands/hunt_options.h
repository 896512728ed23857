// What `palpate study hunt` is asked, and the plan that it makes.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "lab/hunt/hunt.h"

namespace palpate::app {

struct HuntArguments {
  std::size_t ticks = 1000000;
  double seconds = 0.0;  ///< 0: by ticks
  std::uint64_t seed = 1;
  std::vector<double> radii_mm;
  std::vector<std::string> meshes;
  double unit_mm = 0.0, fit_mm = -1.0;
  std::string group;
  bool generated = false;
  std::size_t bodies = 0;
  double scale = 1.0;
  std::size_t threads = 0;
  std::string out;
  std::size_t keep = 6;
  std::vector<std::string> replay;
  bool json = false;
};

/// `arguments` must outlive the command.
void addHuntOptions(CLI::App& command, HuntArguments& arguments);

/// Reads the meshes. Throws Error naming the file.
lab::HuntPlan planOf(const HuntArguments& arguments, const Progress& progress);

}  // namespace palpate::app
