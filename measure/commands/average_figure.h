// Averaged ellipses with their 95 % bands, as a picture.
#pragma once

#include "palpate/measure/average.h"
#include "report/charts/figure.h"

namespace palpate::app {

/// All points over the back at a fifth of their size, then a panel a point: the mean, its band, the means of its drags.
figures::Figure averageFigure(const measure::Averages& averages);

}  // namespace palpate::app
