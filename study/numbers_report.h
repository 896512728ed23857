// The study of the numbers as text, JSON, Markdown and CSV.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/number_row.h"
#include "study/text_table.h"

namespace palpate::study {

/// The rows whose verdicts decide whether the study holds, or the others.
TextTable tableOf(const std::vector<NumberRow>& rows, bool deciding);

/// A table for the terminal and a closing line with the counts.
std::string textOf(const std::vector<NumberRow>& rows);
/// One object: {"holds", "counts", "rows", "statements"}; rows decide, statements inform.
std::string jsonOf(const std::vector<NumberRow>& rows);
std::string markdownOf(const std::vector<NumberRow>& rows);
std::string csvOf(const std::vector<NumberRow>& rows);

/// Writes numbers.md, numbers.csv and numbers.json into the folder, which is made when missing. Throws Error naming
/// the file.
void writeNumbers(const std::vector<NumberRow>& rows, const std::filesystem::path& folder);

}  // namespace palpate::study
