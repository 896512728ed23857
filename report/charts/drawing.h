// Paints the panels of a figure: a plot, or a surface seen from afar.
#pragma once

#include "report/charts/canvas.h"
#include "report/charts/mesh_view.h"
#include "report/charts/plot.h"

namespace palpate::figures {

void drawPlot(Canvas& canvas, const Plot& plot, const Rect& panel);

void drawMeshView(Canvas& canvas, const MeshView& view, const Rect& panel);

}  // namespace palpate::figures
