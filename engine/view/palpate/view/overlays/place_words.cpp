// A place is a name, then a distance from it. Names are whole phrases to the catalogue, since sides have genders; their
// only number, of a rib or a site, is extracted first.
#include "palpate/view/overlays/place_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "palpate/base/language.h"
#include "palpate/base/text.h"
#include "palpate/body/places.h"

namespace palpate::view {

namespace {

/// Names that are translated; T6 is T6 everywhere.
constexpr std::array kPlaceNames = {
    toTranslate("left PSIS"), toTranslate("right PSIS"), toTranslate("left ASIS"), toTranslate("right ASIS"),
    toTranslate("left acromion"), toTranslate("right acromion"), toTranslate("left clavicle"),
    toTranslate("right clavicle"), toTranslate("left clavicle acromial end"),
    toTranslate("right clavicle acromial end"), toTranslate("left clavicle sternal end"),
    toTranslate("right clavicle sternal end"), toTranslate("coccyx tip"), toTranslate("left costochondral {}"),
    toTranslate("right costochondral {}"), toTranslate("left greater tubercle"), toTranslate("right greater tubercle"),
    toTranslate("left iliac crest"), toTranslate("right iliac crest"), toTranslate("left ischial tuberosity"),
    toTranslate("right ischial tuberosity"), toTranslate("jugular notch"), toTranslate("left pubic tubercle"),
    toTranslate("right pubic tubercle"), toTranslate("left rib {} angle"), toTranslate("right rib {} angle"),
    toTranslate("left scapula acromial angle"), toTranslate("right scapula acromial angle"),
    toTranslate("left scapula inferior angle"), toTranslate("right scapula inferior angle"),
    toTranslate("left scapula spine root"), toTranslate("right scapula spine root"),
    toTranslate("left scapula superior angle"), toTranslate("right scapula superior angle"),
    toTranslate("sternal angle"), toTranslate("xiphoid tip"), toTranslate("left site {}"), toTranslate("right site {}"),
    // Bones.
    toTranslate("left cartilage {}"), toTranslate("right cartilage {}"), toTranslate("left hip"),
    toTranslate("right hip"), toTranslate("left humerus"), toTranslate("right humerus"), toTranslate("left rib {}"),
    toTranslate("right rib {}"), toTranslate("sacrum"), toTranslate("left scapula"), toTranslate("right scapula"),
    toTranslate("sternum")};

/// Between a name and a distance: "T6 right 30 mm", "T6, 30 mm right".
constexpr std::array kPlaceDirections = {toTranslate("right"), toTranslate("left"), toTranslate("up"),
                                         toTranslate("down")};

bool isNumber(std::string_view word) {
  return !word.empty() && std::ranges::all_of(word, [](char c) { return (c >= '0' && c <= '9') || c == '.'; });
}

std::vector<std::string> wordsIn(std::string_view text) {
  std::vector<std::string> words;
  for (const std::string_view word : split(text, ' ')) {
    if (!word.empty()) words.emplace_back(word);
  }
  return words;
}

std::string joinWithSpaces(std::span<const std::string> words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::string nameInLanguage(const std::string& name) {
  std::vector<std::string> words = wordsIn(name);
  std::string number;
  for (std::string& word : words) {
    if (isNumber(word)) number = std::exchange(word, "{}");
  }
  const std::string shape = joinWithSpaces(words);
  const auto* known =
      std::ranges::find(kPlaceNames, shape, [](const char* words_of) { return std::string_view(words_of); });
  if (known == kPlaceNames.end()) return name;
  return number.empty() ? tr(*known) : filled(tr(*known), *known, number);
}

/// "30 mm right" and "right 30 mm" begin at the first of these words.
bool beginsDistance(std::span<const std::string> words, std::size_t at) {
  const auto is_direction = [](const std::string& word) {
    return std::ranges::find(kPlaceDirections, word) != kPlaceDirections.end();
  };
  const bool number_next = at + 1 < words.size() && isNumber(words[at + 1]);
  return (is_direction(words[at]) && number_next) ||
         (isNumber(words[at]) && at + 1 < words.size() && words[at + 1] == "mm");
}

std::string wordInLanguage(const std::string& word) {
  if (word == "and") return tr("and");
  const auto* direction = std::ranges::find(kPlaceDirections, word);
  return direction == kPlaceDirections.end() ? word : tr(*direction);
}

/// For comparing: small letters, the order of words does not matter.
std::string settled(const std::string& name) {
  std::vector<std::string> words = wordsIn(inSmallLetters(name));
  std::ranges::sort(words);
  return joinWithSpaces(words);
}

}  // namespace

std::string placeInLanguage(const std::string& english) {
  const std::size_t comma = english.find(',');
  std::vector<std::string> words = wordsIn(english.substr(0, comma));
  std::size_t name_end = words.size();
  for (std::size_t i = words.size(); i-- > 1;) {
    if (beginsDistance(words, i)) name_end = i;
  }
  const std::span<const std::string> all(words);
  std::string text = nameInLanguage(joinWithSpaces(all.first(name_end)));
  for (const std::string& word : all.subspan(name_end)) text += " " + wordInLanguage(word);
  if (comma == std::string::npos) return text;
  text += ',';
  for (const std::string& word : wordsIn(english.substr(comma + 1))) text += " " + wordInLanguage(word);
  return text;
}

std::string placeInEnglish(std::span<const body::SkinLandmark> landmarks, const std::string& typed) {
  std::vector<std::string> words = wordsIn(typed);
  std::vector<std::string> name, distances;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string small = inSmallLetters(words[i]);
    const auto* direction = std::ranges::find_if(
        kPlaceDirections, [&](const char* word) { return small == word || small == inSmallLetters(tr(word)); });
    const bool has_number = i + 1 < words.size() && words[i + 1].front() >= '0' && words[i + 1].front() <= '9';
    if (direction == kPlaceDirections.end() || !has_number) {
      (distances.empty() ? name : distances).push_back(words[i]);
      continue;
    }
    distances.emplace_back(*direction);
    distances.push_back(words[++i]);
  }
  const std::string sought = settled(joinWithSpaces(name));
  const std::vector<std::string> names = body::placeNames(landmarks);
  const auto known =
      std::ranges::find_if(names, [&](const std::string& one) { return settled(placeInLanguage(one)) == sought; });
  const std::string words_of_name = known == names.end() ? joinWithSpaces(name) : *known;
  return distances.empty() ? words_of_name : words_of_name + " " + joinWithSpaces(distances);
}

}  // namespace palpate::view
