// Which stacks `palpate tissue realism` judges by, and their solution.
#pragma once

#include <filesystem>
#include <vector>

#include "solve/realism/realism.h"

namespace palpate::app {

/// Where a body is judged, and what the product makes of the place out of the shipped stacks.
struct JudgedPlace {
  std::string name;
  double thickness_mm = 0.0;
  tissue::LayerStack stack = {};
  std::shared_ptr<const tissue::LayeredTissue> tissue = nullptr;
};
std::vector<JudgedPlace> placesOfBody();

/// Places of a body: the truth is solved now, the skin is what the shipped library makes of such a place, most of which
/// lie between its stacks.
std::vector<lab::JudgedStack> stacksOfBody(const Progress& progress);

/// The cases of a file are the truth; the skin gets a table that is solved now for each stack. Throws Error naming
/// file, case and key, or the stack that cannot be solved.
std::vector<lab::JudgedStack> stacksOfFile(const std::filesystem::path& file, const Progress& progress);

}  // namespace palpate::app
