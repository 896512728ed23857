// Finds the name that a misspelt one meant: keys of scene files, commands, options and their values.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace palpate {

/// Longer than any typing error; comparing names costs the product of their lengths.
inline constexpr std::size_t kLongestName = 64;

/// User input made fit for a message: no line breaks or other control bytes, not too long.
std::string oneLine(std::string_view text, std::size_t most = kLongestName);

/// The name nearest to `written`, or empty when none is near. A name that differs in its unit only is near.
std::string nearestName(std::string_view written, const std::vector<std::string>& names);

/// The nearest names, whatever their distance and their case, the nearest first: for a list too long to be read.
std::vector<std::string> nearestNames(std::string_view written, const std::vector<std::string>& names,
                                      std::size_t most);

/// "did you mean 'radius_mm'?", or all names where none is near: "known: bsp, octree".
std::string nameHint(std::string_view written, const std::vector<std::string>& names);

/// "unknown key 'radius_cm' in [[finger]]; did you mean 'radius_mm'?"; `where` may be empty.
std::string unknownName(std::string_view kind, std::string_view written, std::string_view where,
                        const std::vector<std::string>& names);

}  // namespace palpate
