// Everything of the measuring view but the photographs: which they are, tools, settings, what was found, accepting.
#pragma once

#include "measure/window/measuring_view.h"

namespace palpate::viewer {

/// In the window that is being drawn.
void measuringColumn(MeasuringView& view, MeasuringRequests& requests);

}  // namespace palpate::viewer
