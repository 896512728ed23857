// The reference stacks of `palpate tissue realism`, and their solution.
#pragma once

#include <filesystem>
#include <vector>

#include "solve/realism/fem_cases.h"
#include "solve/realism/realism.h"

namespace palpate::lab {

/// A reference place on a body, and the product's stand-in from the shipped stacks.
struct JudgedPlace {
  std::string name;
  double thickness_mm = 0.0;
  double fat_mm = 0.0;
  tissue::LayerStack stack = {};
  std::shared_ptr<const tissue::LayeredTissue> tissue = nullptr;
};
std::vector<JudgedPlace> placesOfBody();

/// Places of a body: the truth is solved now, the skin is the shipped library's for such a place, most of which lie
/// between its stacks.
std::vector<JudgedStack> stacksOfBody(const Progress& progress);

/// The cases are the truth; the skin gets a table that is solved now for each stack. Throws Error naming the stack that
/// cannot be solved.
std::vector<JudgedStack> stacksOfCases(const FemCases& cases, const Progress& progress);
/// Stacks of a file. Throws Error naming file, case and key, too.
std::vector<JudgedStack> stacksOfFile(const std::filesystem::path& file, const Progress& progress);

}  // namespace palpate::lab
