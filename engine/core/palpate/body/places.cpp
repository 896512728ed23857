// Words are compared as sets, so that "PSIS left" is "left PSIS"; what follows a direction and a number is a distance.
#include "palpate/body/places.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <optional>

#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/text.h"

namespace palpate::body {

namespace {

using Words = std::vector<std::string>;

Words wordsOf(std::string_view text) {
  Words words(1);
  for (const char c : text) {
    const auto letter = static_cast<unsigned char>(c);
    if (c == '_' || c == ',' || std::isspace(letter) != 0) {
      if (!words.back().empty()) words.emplace_back();
    } else {
      words.back() += static_cast<char>(std::tolower(letter));
    }
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

std::string joined(const Words& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

/// Removes words without meaning and sorts the rest, since their order does not matter.
void settle(Words& words) {
  std::erase_if(words, [](const std::string& word) { return word == "spinous" || word == "process" || word == "the"; });
  std::sort(words.begin(), words.end());
}

struct Direction {
  std::string_view word;
  Vec2 along;
  std::string_view as_written;
};
constexpr std::array<std::string_view, 4> kAsWritten = {"right", "left", "up", "down"};
std::optional<Direction> parseDirection(std::string_view word) {
  const std::array<Direction, 6> all = {{{"right", {1, 0}, kAsWritten[0]},
                                         {"left", {-1, 0}, kAsWritten[1]},
                                         {"up", {0, 1}, kAsWritten[2]},
                                         {"down", {0, -1}, kAsWritten[3]},
                                         {"cranial", {0, 1}, kAsWritten[2]},
                                         {"caudal", {0, -1}, kAsWritten[3]}}};
  const auto* found = std::find_if(all.begin(), all.end(), [&](const Direction& d) { return d.word == word; });
  return found == all.end() ? std::nullopt : std::optional(*found);
}

/// "30" or "30mm"; empty for another word.
std::optional<double> parseDistance(std::string_view word) {
  if (word.ends_with("mm")) word.remove_suffix(2);
  return word.empty() ? std::nullopt : parseNumber(word);
}

struct Moved {
  Words name;
  Vec2 by = Vec2::Zero();
  std::string as_written;  ///< " right 30 mm"
};

std::string millimetres(double value) {
  const std::string text = std::to_string(std::round(value * 10) / 10);
  const std::size_t point = text.find('.');
  return text[point + 1] == '0' ? text.substr(0, point) : text.substr(0, point + 2);
}

/// Removes the distances from the words.
Moved withoutDistances(const Words& words) {
  Moved moved;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto direction = parseDirection(words[i]);
    const auto distance = direction && i + 1 < words.size() ? parseDistance(words[i + 1]) : std::nullopt;
    // "rib 7" has a number too, but no direction before it; "left 7 rib" would be a riddle.
    if (!distance) {
      moved.name.push_back(words[i]);
      continue;
    }
    if (!(std::abs(*distance) <= 1000))
      throw Error(words[i] + " " + words[i + 1] + ": a distance must be at most 1000 mm");
    moved.by += *distance * direction->along;
    moved.as_written += " " + std::string(direction->as_written) + " " + millimetres(*distance) + " mm";
    ++i;
    if (i + 1 < words.size() && words[i + 1] == "mm") ++i;
  }
  return moved;
}

const SkinLandmark* spinous(std::span<const SkinLandmark> landmarks, std::string_view level) {
  return findLandmark(landmarks, "spinous_" + std::string(level));
}

/// left site 1 is at the highest level.
std::string siteName(std::size_t number, bool left) {
  return (left ? "left site " : "right site ") + std::to_string(number);
}

std::optional<NamedPlace> siteNamed(std::span<const SkinLandmark> landmarks, Words words) {
  settle(words);
  for (std::size_t i = 0; i < kSiteLevels.size(); ++i) {
    for (const bool left : {true, false}) {
      Words name = wordsOf(siteName(i + 1, left));
      settle(name);
      const SkinLandmark* level = name == words ? spinous(landmarks, kSiteLevels[i]) : nullptr;
      if (level == nullptr) continue;
      const double beside = left ? -kSiteBesideMm : kSiteBesideMm;
      return NamedPlace{siteName(i + 1, left), level->position + Vec3(beside, 0, 0), true};
    }
  }
  return std::nullopt;
}

/// "t6 rigth 30 mm" with the intended direction before the number; empty where none is near.
std::optional<Words> withDirections(Words words) {
  static const std::vector<std::string> directions = {"right", "left", "up", "down", "cranial", "caudal"};
  bool mended = false;
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    if (!parseDistance(words[i + 1]) || words[i].size() < 2) continue;
    const std::string meant = nearestName(words[i], directions);
    if (meant.empty() || meant == words[i]) continue;
    words[i] = meant;
    mended = true;
  }
  return mended ? std::optional(words) : std::nullopt;
}

/// All of some eighty names would hide the one that was meant.
std::string placeHint(std::span<const SkinLandmark> landmarks, const Moved& written) {
  const Words& name = written.name;
  constexpr std::size_t kFew = 3;
  if (const auto mended = withDirections(name)) {
    try {
      return "did you mean '" + placeNamed(landmarks, joined(*mended)).name + written.as_written + "'?";
    } catch (const Error&) {
      // More is wrong than a direction.
    }
  }
  const std::vector<std::string> names = placeNames(landmarks);
  if (const std::string nearest = nearestName(joined(name), names); !nearest.empty()) {
    return "did you mean '" + nearest + "'?";
  }
  std::string nearest;
  for (const std::string& one : nearestNames(joined(name), names, kFew)) {
    nearest += (nearest.empty() ? "'" : ", '") + one + "'";
  }
  return "the nearest names are " + nearest;
}

bool isSpinous(const SkinLandmark& landmark) {
  return landmark.name.starts_with("spinous_") || landmark.name.starts_with("sacrum_");
}

/// The landmark that an examiner would start from; null without any.
const SkinLandmark* nearestTo(std::span<const SkinLandmark> landmarks, const Vec3& point) {
  constexpr double kLevelsFirst = 0.5;  // a spinous process counts as half as far: examiners think in levels
  const SkinLandmark* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const SkinLandmark& landmark : landmarks) {
    const double far = (landmark.position - point).norm() * (isSpinous(landmark) ? kLevelsFirst : 1.0);
    if (far < least) {
      least = far;
      nearest = &landmark;
    }
  }
  return nearest;
}

/// About where the back is: as high as the spinous process at this level, or the highest landmark.
double backLevel(std::span<const SkinLandmark> landmarks, double y_mm) {
  double z_mm = -std::numeric_limits<double>::infinity();
  double least = std::numeric_limits<double>::infinity();
  for (const SkinLandmark& landmark : landmarks) {
    const double far = std::abs(landmark.position.y() - y_mm);
    if (isSpinous(landmark) && far < least) {
      least = far;
      z_mm = landmark.position.z();
    }
  }
  if (std::isfinite(z_mm)) return z_mm;
  for (const SkinLandmark& landmark : landmarks) z_mm = std::max(z_mm, landmark.position.z());
  return z_mm;
}

}  // namespace

std::string spokenName(std::string_view landmark) {
  Words words = wordsOf(landmark);
  std::erase_if(words, [](const std::string& word) { return word == "spinous" || word == "top"; });
  if (words.size() > 1 && words[0] == "sacrum") words.erase(words.begin());
  const auto side = std::find_if(words.begin(), words.end(), [](const auto& w) { return w == "left" || w == "right"; });
  if (side != words.end()) std::rotate(words.begin(), side, side + 1);
  for (std::string& word : words) {
    const bool level = word.size() > 1 && word.find_first_not_of("0123456789", 1) == std::string::npos;
    if (word == "psis" || word == "asis" ||
        (level && std::string_view("ctls").find(word[0]) != std::string_view::npos)) {
      for (char& c : word) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
  }
  return joined(words);
}

NamedPlace placeNamed(std::span<const SkinLandmark> landmarks, std::string_view words) {
  if (landmarks.empty()) throw Error("'" + oneLine(words) + "': this body has no named places");
  const Moved moved = withoutDistances(wordsOf(words));
  Words wanted = moved.name;
  settle(wanted);
  std::optional<NamedPlace> place = siteNamed(landmarks, moved.name);
  for (const SkinLandmark& landmark : landmarks) {
    if (place) break;
    Words spoken = wordsOf(spokenName(landmark.name));
    Words plain = wordsOf(landmark.name);
    settle(spoken);
    settle(plain);
    if (spoken == wanted || plain == wanted) place = NamedPlace{spokenName(landmark.name), landmark.position, false};
  }
  if (!place) throw Error("unknown place '" + oneLine(trimmed(words)) + "'; " + placeHint(landmarks, moved));
  place->point += Vec3(moved.by.x(), moved.by.y(), 0);
  place->moved = place->moved || !moved.by.isZero();
  place->name += moved.as_written;
  return *place;
}

std::vector<std::string> placeNames(std::span<const SkinLandmark> landmarks) {
  std::vector<std::string> names;
  for (const SkinLandmark& landmark : landmarks) names.push_back(spokenName(landmark.name));
  for (std::size_t i = 0; i < kSiteLevels.size(); ++i) {
    if (spinous(landmarks, kSiteLevels[i]) == nullptr) continue;
    names.push_back(siteName(i + 1, true));
    names.push_back(siteName(i + 1, false));
  }
  return names;
}

std::string describePlace(std::span<const SkinLandmark> landmarks, const Vec3& point) {
  constexpr double kAtMm = 4;  // nearer than a finger's pad is there
  const SkinLandmark* nearest = nearestTo(landmarks, point);
  if (nearest == nullptr) return {};
  std::string words = spokenName(nearest->name);
  const Vec3 off = point - nearest->position;
  const auto part = [&](double along, const char* positive, const char* negative) {
    if (std::abs(along) < kAtMm) return std::string();
    return std::to_string(std::lround(std::abs(along))) + " mm " + (along > 0 ? positive : negative);
  };
  const std::string across = part(off.x(), "right", "left");
  const std::string along = part(off.y(), "up", "down");
  if (!across.empty()) words += ", " + across;
  if (!along.empty()) words += (across.empty() ? ", " : " and ") + along;
  return words;
}

std::string makePlaceName(std::span<const SkinLandmark> landmarks, const Vec2& place) {
  if (landmarks.empty()) return {};
  const SkinLandmark* nearest = nearestTo(landmarks, Vec3(place.x(), place.y(), backLevel(landmarks, place.y())));
  std::string words = spokenName(nearest->name);
  const auto part = [&](double along, const char* positive, const char* negative) {
    const long whole = std::lround(std::abs(along));
    if (whole > 0) words += " " + std::string(along > 0 ? positive : negative) + " " + std::to_string(whole) + " mm";
  };
  part(place.x() - nearest->position.x(), "right", "left");
  part(place.y() - nearest->position.y(), "up", "down");
  return words;
}

}  // namespace palpate::body
