// `palpate study numbers`: printed numbers of the dissertation and ours, by the kind of comparison.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dissertation/numbers/number_row.h"
#include "dissertation/numbers/printed_numbers.h"
#include "report/page/study_page.h"

namespace palpate::study {

/// In the order of the text. Takes well under a second. Throws Error when a printed number is not a number.
std::vector<NumberRow> studyNumbers(const PrintedNumbers& printed = printedNumbers());

// The study of the numbers as text, JSON, Markdown and CSV.

/// The rows whose verdicts decide whether the study holds, or the others.
TextTable tableOf(const std::vector<NumberRow>& rows, bool deciding);

/// Meaning of the columns and the verdicts.
std::string numbersLegend();

/// A table for the terminal and a closing line with the counts.
std::string textOf(const std::vector<NumberRow>& rows);
/// How many rows have each verdict: "52 from our engine, ...".
std::string countsLine(const std::vector<NumberRow>& rows);
/// One object: {"holds", "counts", "rows", "statements"}; counts has every verdict, rows decide, statements inform.
std::string toJson(const std::vector<NumberRow>& rows);
std::string toMarkdown(const std::vector<NumberRow>& rows);
std::string toCsv(const std::vector<NumberRow>& rows);

/// Writes numbers.md, numbers.csv and numbers.json into the folder, which is made when missing. Throws Error naming
/// the file.
void writeNumbers(const std::vector<NumberRow>& rows, const std::filesystem::path& folder);

// The rows of the study, chapter by chapter, computed by the engine's own code.

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
/// Statements in words or ranges, most of which do not hold, and those that cannot be computed today.
void addStatements(const PrintedNumbers& printed, Rows& rows);

}  // namespace palpate::study
