// The pictures of the interpolation study: surfaces of Table 5.1, maps of the back.
#pragma once

#include "palpate/maps/measured_data.h"
#include "report/charts/figure.h"

namespace palpate::study {

/// Figures 5.9 and 5.10 as surfaces, for three effect radii each. `cells` along a side.
figures::Figure widthSurfaces(int cells);
/// Sections along the y axis of (5.7) and (5.16) with the printed values, and (5.7) at the keys over the effect radius.
figures::Figure widthSections();
/// Figure 5.11 for three effect radii. `step_mm` between two values.
figures::Figure backOverWidths(double step_mm);
/// The half major axis over the back by GRI, thin plate and plane.
figures::Figure backByInterpolator(double step_mm);
/// Maps of ellipses dragged up and down, and what they differ by.
figures::Figure upAndDown(double step_mm);

/// The effect radii between which (5.7) gives both numbers of Figure 5.9 to the printed digit, mm.
struct RadiusRange {
  double from = 0.0;
  double to = 0.0;
};
RadiusRange radiiOfFigure59();

}  // namespace palpate::study
