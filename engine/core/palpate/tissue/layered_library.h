// The stacks of a body's regions, solved once and shipped: skin of 2 mm, fat and muscle of every thickness over bone.
//
// Made by `palpate tissue library --solve` (docs/explanation/tissue.md says how, with which moduli and how far apart
// published ones lie); between the stacks nodes are blended (docs/explanation/tissue.md says how well).
#pragma once

#include <span>
#include <vector>

#include "palpate/tissue/layered_tissue.h"

namespace palpate::tissue {

/// The stack of a place: skin, fat as a share of what lies under the skin, muscle for the rest.
LayerStack libraryStack(double thickness_mm, double fat_share);

/// The thicknesses (mm) and shares of fat that were solved.
std::span<const double> libraryThicknesses();
std::span<const double> libraryFatShares();

/// The share of the tissue under the skin that this much fat takes; less where the muscle would be thinner than 3 mm.
double libraryFatShare(double thickness_mm, double fat_mm);

/// A node for each thickness of the library, with this much fat (libraryFatShare).
std::vector<LayeredNode> libraryNodes(double fat_mm);

/// A node as the shipped file has it.
std::vector<double> libraryNumbers(const LayeredNode& node);

/// Forces of other fingers on a stack that was solved for one sphere alone: as they change with the radius in the
/// shipped stack of its thickness and fat (the softest layer under the first).
std::vector<FingerSecants> fingersLikeLibrary(const LayerStack& stack, double indenter_radius_mm,
                                              const LayeredNode& node);

}  // namespace palpate::tissue
