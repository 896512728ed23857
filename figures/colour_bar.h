// The colour bar beside a map: which colour means which value.
#pragma once

#include "figures/plot_layout.h"

namespace palpate::figures {

/// A vertical bar with ticks and a label on its right.
void drawColourBar(Canvas& canvas, const Rect& bar, ColourMap colours, const Range& range,
                   const std::vector<Tick>& ticks, const std::string& label);

}  // namespace palpate::figures
