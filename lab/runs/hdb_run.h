// Runs a finger of the HDB source along a benchmark path, to be compared with the default source of contact_run.h.
#pragma once

#include "lab/runs/contact_run.h"
#include "palpate/hdb/hdb_candidates.h"

namespace palpate::bench {

struct HdbRunSettings {
  hdb::BuildSettings build;
  double edge_mm = 0.0;  ///< of the box; 0: a quarter of the longest edge
  hdb::HdbSettings hdb;  ///< its edges are set from edge_mm
};

struct HdbFigures {
  ContactFigures contact;
  std::size_t leaves = 0;
  std::size_t most_listed = 0;  ///< triangles in the box's list
  std::uint64_t queries = 0;    ///< of the partition
  double edge_mm = 0.0;
};

/// In a world of scale 1. Throws Error for settings that do not go together.
HdbFigures measureHdb(ContactWorld& world, const device::Trajectory& trajectory, const contact::FingerSettings& finger,
                      const HdbRunSettings& settings, const Window& window = {});

}  // namespace palpate::bench
