// A block's stored form: settings, seed and answers. JSON.
//
//   {"version": 1, "seed": 7, "settings": "0123456789abcdef", "outcomes": [[answer, correct, visited, target], ...]}
//
// The trials are not in it: they follow from settings, seed and outcomes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/training/block.h"

namespace palpate::training {

struct BlockState {
  std::uint64_t seed = 0;
  std::vector<TrialOutcome> outcomes;
};

/// Sixteen hexadecimal digits that change with every setting.
std::string settingsDigest(const BlockSettings& settings);

std::string blockStateText(const BlockSettings& settings, const BlockState& state);
/// Throws Error for text that cannot be read, of another version, or of other settings.
BlockState parseBlockState(const BlockSettings& settings, std::string_view text);

}  // namespace palpate::training
