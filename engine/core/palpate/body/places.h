// Places of a body in an examiner's terms: "T6", "left PSIS", "T6 right 30 mm", "left site 4"; and back from a point to
// a name.
//
// Reads the landmarks of a body (trunk.h, torso.h). Scenes, commands and panels look places up here; reports name them
// in these terms. Cold; any thread.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/body/torso.h"

namespace palpate::body {

/// An examiner's name of the landmark: "spinous_T6" is "T6", "psis_left" is "left PSIS", "rib_7_right_angle" is "right
/// rib 7 angle".
std::string spokenName(std::string_view landmark);

/// The twelve training sites: six levels on both sides, kSiteBesideMm from the spine.
inline constexpr std::array<std::string_view, 6> kSiteLevels = {"T4", "T6", "T8", "T10", "T12", "L2"};
inline constexpr double kSiteBesideMm = 30;  ///< over the transverse processes and ribs; our choice, for 1750 mm

/// A named place: a landmark's point on the skin, moved along x (right) and y (up).
struct NamedPlace {
  std::string name;  ///< the normal form: "T6 right 30 mm"
  Vec3 point;        ///< mm; on the skin where nothing was moved, else over or under it
  bool moved = false;
};

/// Upper and lower case, the order of words, '_' for a space and "mm" do not matter; distances are millimetres: right,
/// left, up, down (or cranial, caudal), one after the other. Throws Error with names of similar spelling.
NamedPlace placeNamed(std::span<const SkinLandmark> landmarks, std::string_view words);

/// All names, as a list would show them, the sites among them.
std::vector<std::string> placeNames(std::span<const SkinLandmark> landmarks);

/// "T6", "T6, 12 mm right and 8 mm up", "left PSIS": the point from the landmark that an examiner would start from.
/// Empty without landmarks.
std::string describePlace(std::span<const SkinLandmark> landmarks, const Vec3& point);
[[deprecated("describePlace, which this was until 0.3")]] inline std::string inWords(
    std::span<const SkinLandmark> landmarks, const Vec3& point) {
  return describePlace(landmarks, point);
}

/// "T9 right 32 mm", to the whole millimetre: a place of the map plane as a name for placeNamed. On a closed body one
/// that is seen from behind. Empty without landmarks.
std::string makePlaceName(std::span<const SkinLandmark> landmarks, const Vec2& place);

}  // namespace palpate::body
