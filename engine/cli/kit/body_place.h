// Options for a place on the body: x,y,z in mm, or an examiner's term.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "cli/kit/options.h"
#include "palpate/base/vec.h"
#include "palpate/scene/world.h"

namespace palpate::app {

/// The option's type in the help.
inline constexpr const char* kBodyPlaceType = "X,Y,Z|PLACE";

/// A place as the user gave it; a name can only be resolved on a body.
struct BodyPlace {
  std::string option;  ///< for messages
  std::string words;   ///< "T6 right 30 mm"; empty: the point
  Vec3 point = Vec3::Zero();
};

/// True for x,y,z: a text that begins like a number, or has three parts with commas and no blanks.
bool meansNumbers(std::string_view text);

/// Throws UsageError.
BodyPlace bodyPlaceFrom(const std::string& option, const std::string& text);

/// The point, or the named place on the skin. Throws Error naming the option.
Vec3 pointOn(const scene::World& world, const BodyPlace& place);
/// The same for the tip of a finger: a named place is kPosedDepthMm under the skin.
inline constexpr double kPosedDepthMm = 6.0;
Vec3 tipOn(const scene::World& world, const BodyPlace& place);

Option* addBodyPlace(Command& command, const std::string& name, std::optional<BodyPlace>& value,
                     const std::string& help);

}  // namespace palpate::app
