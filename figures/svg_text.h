// Finishing touches on the SVG that cairo writes.
#pragma once

#include <string>
#include <vector>

#include "figures/figure.h"

namespace palpate::figures {

/// cairo draws letters as outlines and numbers its elements by a counter of the process. Adds the drawn texts as the
/// picture's description, so that it can be searched and read aloud, and counts the elements from 1, so that equal
/// drawings give equal files.
std::string tidiedSvg(std::string svg, const std::vector<DrawnText>& texts);

}  // namespace palpate::figures
