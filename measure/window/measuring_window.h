// The measuring view on the screen: a column of what is chosen, found and accepted, and the photographs beside it.
#pragma once

#include "measure/window/measuring_view.h"
#include "view/viewer/panels/panels.h"

namespace palpate::viewer {

/// Fills the area, in a Gui frame that has begun.
void measuringWindow(MeasuringView& view, const FreeArea& free, MeasuringRequests& requests);

}  // namespace palpate::viewer
