// A photograph with what was found in it, to be zoomed, shifted, clicked and dragged on.
#pragma once

#include "measure/window/measuring_view.h"

namespace palpate::viewer {

/// What a panel shows.
struct PhotoPanel {
  Photo photo = Photo::before;
  const measure::OverlayPanel* overlay = nullptr;  ///< or none yet
  bool faded = false;
  const char* path = "";  ///< "measuring/before"
};
/// In the rest of the window that is being drawn, so wide and high.
void photoPanel(MeasuringView& view, const PhotoPanel& panel, const Vec2& size);

}  // namespace palpate::viewer
