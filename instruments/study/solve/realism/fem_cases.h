// Solved reference presses: the skin's shape and the force of stacks of layers at single depths.
//
// The form: {"r": [radii, mm], "cases": [{"name", "layers_mm_kPa": [[mm, kPa], ...], "depth": mm, "u0": mm, "force_N",
// "uz": [down / u0], "ur": [outward / u0]}, ...]}. Keys beyond these are left alone, but "friction": a case with any
// other than "none" is listed as left out, since our fingertip is frictionless while it presses.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/tissue/layered_table.h"

namespace palpate::lab {

struct FemCase {
  std::string name;
  tissue::LayerStack stack;
  tissue::PressedShape truth;  ///< at the radii of the file
};

struct FemCases {
  std::vector<double> radii_mm;
  std::vector<FemCase> cases;
  std::vector<std::string> left_out;  ///< "name at 5 mm: friction sticking"
};

/// True for more than one modulus.
bool isLayered(const tissue::LayerStack& stack);

/// Throws Error naming the file, the case and the key.
FemCases readFemCases(const std::filesystem::path& file);
/// Parses the text of such a file; messages name `file`.
FemCases parseFemCases(std::string_view text, const std::filesystem::path& file);

/// The cases that a table holds, one a depth.
FemCases toFemCases(const tissue::LayeredTable& table, const std::string& name);

}  // namespace palpate::lab
