// The chapters of the report: the studies of numbers, figures and errata, which have commands of their own, as pages
// like all others, and the pages of studies.h behind them.
#pragma once

#include <vector>

#include "palpate/scene/scene.h"
#include "study/studies.h"

namespace palpate::study {

/// In the order of the report. The errata are measured on this scene.
std::vector<Study> reportChapters(const scene::Scene& scene);

}  // namespace palpate::study
