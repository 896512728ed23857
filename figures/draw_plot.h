// Paints a plot into a panel of the figure.
#pragma once

#include "figures/canvas.h"
#include "figures/plot.h"

namespace palpate::figures {

void drawPlot(Canvas& canvas, const Plot& plot, const Rect& panel);

}  // namespace palpate::figures
