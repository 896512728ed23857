// A fit as text, to be kept beside a scene: NAME.fit.json.
#pragma once

#include <string>
#include <string_view>

#include "palpate/body/fitting/body_fit.h"

namespace palpate::body {

/// Longer files are none of ours.
inline constexpr std::size_t kLongestFitFile = 1 << 20;

/// All numbers exactly, so that a fit read back gives the same body.
std::string fitAsJson(const BodyFit& fit);

/// Any text at all gives a fit or one Error with file and place.
BodyFit fitFromJson(std::string_view text, std::string_view file);

}  // namespace palpate::body
