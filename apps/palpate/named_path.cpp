#include "apps/palpate/named_path.h"

#include <filesystem>

#include "bench/workload_paths.h"

namespace palpate::app {

device::Trajectory trajectoryFrom(const std::string& name) {
  if (std::filesystem::exists(name) || name.ends_with(".csv")) return device::readTrajectory(name);
  return bench::workloadPath(name);
}

}  // namespace palpate::app
