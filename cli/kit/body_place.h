// Options that take a place on the body: x,y,z in mm, or the words of an examiner.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "cli/kit/options.h"
#include "palpate/base/vec.h"
#include "palpate/scene/world.h"

namespace palpate::app {

/// The placeholder of such a value in --help.
inline constexpr const char* kBodyPlaceType = "X,Y,Z|PLACE";

/// As the user gave it; a name means something on a built-in body only.
struct BodyPlace {
  std::string option;  ///< for messages
  std::string words;   ///< "T6 right 30 mm"; empty: the point
  Vec3 point = Vec3::Zero();
};

/// What begins like a number, or is three words with commas and no blanks, is x,y,z.
bool meansNumbers(std::string_view text);

/// Throws UsageError.
BodyPlace bodyPlaceFrom(const std::string& option, const std::string& text);

/// The point, or where the words point on the skin. Throws Error naming the option.
Vec3 pointOn(const scene::World& world, const BodyPlace& place);
/// The same for the tip of a finger: where words point, it is so far under the skin.
inline constexpr double kPosedDepthMm = 6.0;
Vec3 tipOn(const scene::World& world, const BodyPlace& place);

Option* addBodyPlace(Command& command, const std::string& name, std::optional<BodyPlace>& value,
                     const std::string& help);

}  // namespace palpate::app
