// A trajectory by file or by name.
#pragma once

#include <string>

#include "palpate/device/trajectory.h"

namespace palpate::app {

/// A CSV file if one of that name exists or the name ends in .csv; else a benchmark's trajectory. Throws Error.
device::Trajectory trajectoryFrom(const std::string& name);

}  // namespace palpate::app
