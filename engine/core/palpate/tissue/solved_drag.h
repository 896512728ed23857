// How the skin over layers and bone follows a dragged patch, as solved by finite elements: the third form of the fit.
//
// In round layers the whole motion follows from two curves: a place at the angle a from the drag moves by along(r) cos
// a outwards and by -across(r) sin a round the contact, shares of the drag. Six stacks from the shortest tail to the
// longest, blended in between; `palpate tissue library --solve --drag -o
// engine/core/palpate/tissue/solved_drag_numbers.txt` solves them again.
#pragma once

#include <array>
#include <cstddef>

namespace palpate::tissue {

/// The patch that was dragged, mm: rho = 1 is its rim.
inline constexpr double kSolvedPatchMm = 6.0;
/// `tail` of the stack with the longest tail; 0 is the shortest.
inline constexpr double kSolvedLongestTail = 2.0;

/// Skin of 2 mm, fat of 10 kPa, muscle of 27 kPa, over bone.
struct SolvedStack {
  double skin_kpa = 0.0;
  double fat_mm = 0.0;
  double muscle_mm = 0.0;
};
inline constexpr std::array<SolvedStack, 6> kSolvedStacks = {{{50.0, 4.0, 6.0},
                                                              {150.0, 4.0, 6.0},
                                                              {150.0, 9.0, 14.0},
                                                              {150.0, 13.0, 30.0},
                                                              {400.0, 13.0, 30.0},
                                                              {1000.0, 13.0, 30.0}}};

/// Distances of the table from the contact, at equal steps of ln(1 + rho^2); the last one and what is farther is at
/// rest.
inline constexpr std::size_t kSolvedKnots = 42;
double solvedKnotMm(std::size_t i);

struct SolvedDrag {
  double along = 0.0;
  double across = 0.0;
  double along_by_rho2 = 0.0;
  double across_by_rho2 = 0.0;
  double along_by_tail = 0.0;
  double across_by_tail = 0.0;
};

/// At rho^2 >= 0; a tail out of range counts as the nearest; 0 far away.
SolvedDrag solvedDragAt(double rho2, double tail);

}  // namespace palpate::tissue
