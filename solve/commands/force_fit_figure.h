// Measured forces and the laws that were fitted to them, as a picture.
#pragma once

#include "report/charts/figure.h"
#include "solve/commands/force_report.h"

namespace palpate::app {

/// Rows, laws and what they miss of one curve; of several curves all of them over each other, and their exponents.
figures::Figure forceFitFigure(const ForceResult& result);

}  // namespace palpate::app
