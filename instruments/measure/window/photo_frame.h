// Where a photograph lies on the screen, and back: fitted into an area, zoomed about a place of it.
#pragma once

#include <algorithm>

#include "palpate/base/vec.h"
#include "palpate/measure/overlay.h"

struct ImDrawList;

namespace palpate::viewer {

/// Points of the screen; photographs count pixels from the centre of the top left one.
struct PhotoFrame {
  Vec2 corner = Vec2::Zero();  ///< upper left of the area
  Vec2 size = Vec2::Ones();
  Vec2 photo_px = Vec2::Ones();       ///< width and height
  double zoom = 1.0;                  ///< 1: the whole photograph
  Vec2 middle = Vec2::Constant(0.5);  ///< point in the middle of the area, in widths and heights

  double pointsPerPx() const { return zoom * size.cwiseQuotient(photo_px).minCoeff(); }
  Vec2 toScreen(const Vec2& px) const {
    return corner + 0.5 * size + pointsPerPx() * (px + Vec2::Constant(0.5) - middle.cwiseProduct(photo_px));
  }
  Vec2 toPhoto(const Vec2& screen) const {
    return middle.cwiseProduct(photo_px) + (screen - corner - 0.5 * size) / pointsPerPx() - Vec2::Constant(0.5);
  }
  /// In widths and heights.
  Vec2 share(const Vec2& screen) const { return (toPhoto(screen) + Vec2::Constant(0.5)).cwiseQuotient(photo_px); }
  bool holds(const Vec2& px) const { return px.minCoeff() >= -0.5 && (photo_px - px).minCoeff() >= 0.5; }
};

// A panel of a measurement's overlay, drawn with ImGui over its photograph.

void drawOverlay(ImDrawList& list, const measure::OverlayPanel& panel, const PhotoFrame& frame);
/// Title, legend and the bar of 50 mm, in the corners of the area: parts that do not fit are left out, the legend also
/// while a part of the photograph is seen.
void drawOverlayLabels(ImDrawList& list, const measure::OverlayPanel& panel, const PhotoFrame& frame);
void drawMark(ImDrawList& list, const Vec2& at, measure::MarkForm form, const measure::OverlayColour& colour,
              float radius);

}  // namespace palpate::viewer
