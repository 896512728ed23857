#include "cli/kit/body_place.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "cli/kit/number_option.h"
#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/text.h"
#include "palpate/view/skin_place.h"

namespace palpate::app {

namespace {

SkinPlace placeOn(const scene::World& world, const BodyPlace& place) {
  try {
    return view::skinPlace(world, place.words);
  } catch (const Error& error) {
    throw Error(place.option + ": " + error.what());
  }
}

}  // namespace

bool meansNumbers(std::string_view text) {
  if (text.empty() || std::string_view("+-.0123456789").find(text.front()) != std::string_view::npos) return true;
  return std::count(text.begin(), text.end(), ',') == 2 &&
         std::none_of(text.begin(), text.end(), [](unsigned char c) { return std::isspace(c) != 0; });
}

BodyPlace bodyPlaceFrom(const std::string& option, const std::string& text) {
  const std::string words(trimmed(text));
  if (!meansNumbers(words)) return {option, words, Vec3::Zero()};
  const std::vector<double> numbers = numbersFrom(option, words, between(-kFarthestMm, kFarthestMm, "mm"));
  if (numbers.size() != 3) {
    throw UsageError(option, "'" + oneLine(words) + "' must be three numbers x,y,z in mm");
  }
  return {option, {}, Vec3(numbers[0], numbers[1], numbers[2])};
}

Vec3 pointOn(const scene::World& world, const BodyPlace& place) {
  return place.words.empty() ? place.point : placeOn(world, place).point;
}

Vec3 tipOn(const scene::World& world, const BodyPlace& place) {
  if (place.words.empty()) return place.point;
  const SkinPlace on_skin = placeOn(world, place);
  return on_skin.point - kPosedDepthMm * on_skin.normal;
}

Option* addBodyPlace(Command& command, const std::string& name, std::optional<BodyPlace>& value,
                     const std::string& help) {
  const auto read = [&value, name](const std::string& text) { value = bodyPlaceFrom(name, text); };
  return command.add_option_function(name, read, help)->type_name(kBodyPlaceType);
}

}  // namespace palpate::app
