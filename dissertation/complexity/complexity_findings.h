// What the counted searches say of the printed estimates: sentences made of nothing but the results.
#pragma once

#include <string>
#include <vector>

#include "dissertation/complexity/complexity_results.h"
#include "dissertation/numbers/number_row.h"

namespace palpate::study {

/// A paragraph each, most important first. The printed threshold and box must have been measured in the first and the
/// largest model.
std::vector<std::string> complexityFindings(const ComplexityResults& results);

/// A misprint only where the list of misprints has it and the counted w is the number that it names (number_row.h).
Verdict verdictOf(const WorstColumn& column);
/// "reproduced", "misprint (E13)" or "NOT REPRODUCED".
std::string wordOf(Verdict verdict);

/// The share of found leaves from which a tree tests more boxes on average than a list of its leaves has.
double shareWhereListWins(const ComplexityResults& results, hdb::TreeKind tree);
/// The most of all searches over what a search can cost.
double worstBoundRatio(const ComplexityResults& results);

}  // namespace palpate::study
