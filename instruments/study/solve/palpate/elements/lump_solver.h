// Solves a lump on the axis of a press: the force that it adds.
//
//   shape, layers ─► press without the lump ─┐
//                └─► press with the lump ────┴─► SolvedPush at 1, 2, 3 ... mm ─► the table of the lump in a world
//
// A program that gives solveLump to scene::setLumpSolver solves the lumps of scenes with `lumps = "solved"`.
#pragma once

#include <vector>

#include "palpate/elements/press_solver.h"
#include "palpate/scene/solved_lumps.h"
#include "palpate/tissue/lump_energy.h"

namespace palpate::elements {

/// Presses over a lump to 8 mm, or half of the tissue, in steps of 1 mm: without it, but on its mesh, and with it. The
/// first `common` depths were reached by both.
struct LumpPresses {
  PressSolution without, with;
  std::size_t common = 0;
};
LumpPresses solveLumpPresses(const tissue::LumpShape& lump, const tissue::LayerStack& stack);

/// Presses with the lump and without it, on one mesh: some 4 s. Both meshes are the same, so that what differs is the
/// lump and not the mesh. Depths that the solver does not come to are missing; it ends where soft skin would fold over
/// a hard ball. Throws Error as check(lump, stack) does, and where it comes to none.
std::vector<scene::SolvedPush> solveLump(const tissue::LumpShape& lump, const tissue::LayerStack& stack);

}  // namespace palpate::elements
