// A table of words as people read it on a terminal, in Markdown and in CSV.
#pragma once

#include <string>
#include <vector>

namespace palpate::study {

struct TextTable {
  std::vector<std::string> headings;
  std::vector<std::vector<std::string>> rows;  ///< as many cells each as there are headings
};

/// Columns padded to equal width, the last one ragged.
std::string plainText(const TextTable& table);
std::string markdownOf(const TextTable& table);
/// Every cell in quotes.
std::string csvOf(const TextTable& table);

}  // namespace palpate::study
