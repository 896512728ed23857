// A panel of a measurement's overlay, drawn with ImGui over its photograph.
#pragma once

#include "measure/window/photo_frame.h"
#include "palpate/measure/overlay.h"

struct ImDrawList;

namespace palpate::viewer {

void drawOverlay(ImDrawList& list, const measure::OverlayPanel& panel, const PhotoFrame& frame);
/// Title, legend and the bar of 50 mm, in the corners of the area: what does not fit is left out, the
/// legend also while a part of the photograph is seen.
void drawOverlayWords(ImDrawList& list, const measure::OverlayPanel& panel, const PhotoFrame& frame);
void drawMark(ImDrawList& list, const Vec2& at, measure::MarkForm form, const measure::OverlayColour& colour,
              float radius);

}  // namespace palpate::viewer
