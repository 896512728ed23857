// Places of the body in the language of the window: "T6 rechts 30 mm", "SIPS izquierda". Scenes, tables and reports
// keep the English of body/places.h; only the window's text and input are translated.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "palpate/body/torso.h"

namespace palpate::view {

/// Translates results of body::spokenName, describe and makePlaceName. Unknown words are kept.
std::string placeInLanguage(const std::string& english);

/// Translates input in either language for body::placeNamed; unknown words are kept.
std::string placeInEnglish(std::span<const body::SkinLandmark> landmarks, const std::string& typed);

}  // namespace palpate::view
