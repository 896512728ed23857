// How the skin over layers and bone follows a dragged patch, as solved by finite elements: the third form of the fit.
//
// Of round layers the whole motion follows from two curves: a place at the angle a from the drag moves by along(r) cos
// a outwards and by -across(r) sin a round the contact, shares of the drag. Six stacks, from the shortest tail to the
// longest, between them blended (`palpate tissue solve --layer skin:2mm:150kPa ...`, patch of radius 6 mm): skin of 2
// mm with 50, 150, 150, 150, 400, 1000 kPa; fat of 4, 4, 9, 13, 13, 13 mm with 10 kPa; muscle of 6, 6, 14, 30, 30, 30
// mm with 27 kPa.
#pragma once

namespace palpate::measure {

/// The patch that was dragged, mm: rho = 1 is its rim.
inline constexpr double kSolvedPatchMm = 6.0;
/// `tail` of the stack with the longest tail; 0 is the shortest.
inline constexpr double kSolvedLongestTail = 2.0;

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

}  // namespace palpate::measure
