// The colour bar: which value a colour of the skin stands for, and where the finger's value is.
#pragma once

#include <string>
#include <vector>

#include "palpate/view/colour_scale.h"
#include "palpate/view/drawing.h"

namespace palpate::view {

struct Legend {
  std::string title;
  std::string unit;
  std::string low_word, high_word;  ///< what the ends mean, in words; may be empty
  ColourRange range;
  ColourMap map = ColourMap::viridis;
  struct Mark {
    double value;
    ColourBytes colour;
  };
  std::vector<Mark> marks;  ///< one a finger that touches
};

/// Where the bar of a legend lies on its page.
struct LegendPlace {
  Vec2f corner = Vec2f::Zero();  ///< upper left of the bar
  Vec2f size = {16.0f, 160.0f};
};

/// Height above the bar's lower end, 0 to 1 within the bar, for a value.
double heightOnBar(const Legend& legend, double value);

/// Bar, numbers, title with unit, pointed ends (values beyond have the colour of the end), marks of the fingers.
void drawLegend(Drawing& page, const Legend& legend, const LegendPlace& place);

}  // namespace palpate::view
