// What docs/howto/head-tracker.md takes for given.
#pragma once

#include "view/viewer/viewer.h"

namespace palpate::snippet {
extern viewer::Viewer viewer;
extern const double x, y, z, now_s;
}  // namespace palpate::snippet
