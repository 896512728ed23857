// Paints a surface seen from afar into a panel of the figure.
#pragma once

#include "figures/canvas.h"
#include "figures/mesh_view.h"

namespace palpate::figures {

void drawMeshView(Canvas& canvas, const MeshView& view, const Rect& panel);

}  // namespace palpate::figures
