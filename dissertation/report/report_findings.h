// What the chapters on numbers, figures and errata say: sentences made of nothing but what is handed in.
#pragma once

#include <string>
#include <vector>

#include "dissertation/errata/errata_study.h"
#include "dissertation/figures/dissertation_figures.h"
#include "dissertation/numbers/number_row.h"

namespace palpate::study {

/// How many come out of what, and every number that does not.
std::vector<std::string> numbersFindings(const std::vector<NumberRow>& rows);

/// How many are computed, plotted again, or drawn for an example of our own.
std::vector<std::string> figuresFindings(const std::vector<DissertationFigure>& figures);

/// What all printed forms change together under each options, which one changes most, and which change nothing.
std::vector<std::string> errataFindings(const ErrataEffects& effects);

}  // namespace palpate::study
