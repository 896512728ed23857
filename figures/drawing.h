// Paints the panels of a figure: a plot, or a surface seen from afar.
#pragma once

#include "figures/canvas.h"
#include "figures/mesh_view.h"
#include "figures/plot.h"

namespace palpate::figures {

void drawPlot(Canvas& canvas, const Plot& plot, const Rect& panel);

void drawMeshView(Canvas& canvas, const MeshView& view, const Rect& panel);

}  // namespace palpate::figures
