// Places of the body in the language of the window: "T6 rechts 30 mm", "SIPS izquierda". Scenes, tables and reports
// keep the words of body/places.h; only what people read and type is translated.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "palpate/body/torso.h"

namespace palpate::view {

/// Of the words that body::spokenName, inWords and placeWords give. What is unknown stays as it is.
std::string placeInLanguage(const std::string& english);

/// What was typed, in either language, in words for body::placeNamed; unknown words stay as they are.
std::string placeInEnglish(std::span<const body::SkinLandmark> landmarks, const std::string& typed);

}  // namespace palpate::view
