// The rows of the study, chapter by chapter, computed by the engine's own code.
#pragma once

#include <vector>

#include "study/number_row.h"
#include "study/printed_numbers.h"

namespace palpate::study {

using Rows = std::vector<NumberRow>;

/// 2.3: stiffness of a surface that yields.
void addHaptics(const PrintedNumbers& printed, Rows& rows);
/// 3.3.4 and 3.4.2: Tables 3.3 and 3.4, the costs (3.5) and (3.9).
void addPartitionComplexity(const PrintedNumbers& printed, Rows& rows);
/// Table 3.1, Table 3.2, Appendix B: what follows from the measured times.
void addMeasuredRates(const PrintedNumbers& printed, Rows& rows);
/// 4.2.1: the half Gaussian and its array.
void addProfile(const PrintedNumbers& printed, Rows& rows);
/// 5.2.2: the interpolation over Table 5.1.
void addInterpolation(const PrintedNumbers& printed, Rows& rows);
/// Figure 5.3 and Appendix C: the measured ellipses.
void addMeasuredEllipses(const PrintedNumbers& printed, Rows& rows);
/// Statements that the text's own numbers contradict, and what nobody can compute today.
void addStatements(const PrintedNumbers& printed, Rows& rows);

}  // namespace palpate::study
