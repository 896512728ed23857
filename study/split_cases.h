// Figures 3.7 and 3.14: where the triangles go that a split crosses.
#pragma once

#include "figures/figure.h"

namespace palpate::study {

figures::Figure splitCasesFigure();
figures::Figure octantFigure();

}  // namespace palpate::study
