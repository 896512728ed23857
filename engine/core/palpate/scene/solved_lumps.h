// Lumps that were solved with their lump in the mesh, for `[tissue] lumps = "solved"`: the force of a lump's table is
// then set right over its middle. The core has no solver and no files; programs give it both.
//
//   a program with palpate::elements ─────── setLumpSolver ─┐
//   installHost: the user's folder ───────── setLumpStore ──┴─► solvedPushes ─► placedLumps (lumps_of_body.h)
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "palpate/tissue/lump_energy.h"

namespace palpate::scene {

/// The force that a lump adds to a press over its middle.
struct SolvedPush {
  double depth_mm = 0.0;
  double extra_n = 0.0;
};

/// Takes seconds. Throws Error for a lump that it cannot solve.
using LumpSolver =
    std::function<std::vector<SolvedPush>(const tissue::LumpShape& lump, const tissue::LayerStack& stack)>;

/// Where solved lumps are kept, by a number that names the lump and its layers.
struct LumpStore {
  std::function<std::optional<std::vector<SolvedPush>>(std::uint64_t name)> find;
  std::function<void(std::uint64_t name, std::span<const SolvedPush> pushes)> save;
};

/// Given once each, while the program starts.
void setLumpSolver(LumpSolver solver);
void setLumpStore(LumpStore store);

/// Loads the stored pushes, or solves and stores them. Nothing if they are not stored and no solver is set. Throws
/// Error as the solver does.
std::optional<std::vector<SolvedPush>> solvedPushes(const tissue::LumpShape& lump, const tissue::LayerStack& stack);

/// Factors for a table's extra force on the axis; 1 where the table has hardly any.
std::vector<tissue::ForceCorrection> correctionOf(std::span<const SolvedPush> pushes, const tissue::LumpEnergy& table);

}  // namespace palpate::scene
