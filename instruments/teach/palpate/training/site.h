// The places that a trainee is asked about: by default the twelve of the Virtual Haptic Back, six levels on both sides.
//
//   landmarks of a body ─ twelveSites, sitesNamed ─► SiteSet ─► trials (session.h), exploration (exploration.h),
//   pictures
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/base/words.h"
#include "palpate/body/torso.h"

namespace palpate::training {

enum class Side : std::uint8_t { left, right, middle };

struct Site {
  int number = 0;     ///< number that the trainee sees and says, from 1
  std::string at;     ///< in words that every body knows: "left site 4"
  std::string label;  ///< for teachers: "T10, left"
  int level = 0;      ///< from the top, from 1: sites of one level lie opposite each other
  Side side = Side::middle;
  Vec2 place_mm = Vec2::Zero();  ///< on the map plane (x right, y up)
  Vec3 point_mm = Vec3::Zero();  ///< near the skin at rest
};

/// Ordered by number, 1 to size.
struct SiteSet {
  std::vector<Site> sites;
  int choices() const { return static_cast<int>(sites.size()); }
  /// Null for a number that no site has.
  const Site* numbered(int number) const;
};

/// 1 to 6 down the left side, 7 to 12 down the right. Throws Error for a body without these landmarks.
SiteSet twelveSites(std::span<const body::SkinLandmark> landmarks);

/// Places in words ("T6 right 30 mm"), numbered in order: at least two, at most 40. Throws Error naming the place that
/// the body does not know, or two that lie nearer to each other than 15 mm.
SiteSet sitesNamed(std::span<const body::SkinLandmark> landmarks, std::span<const std::string> places);

/// "site 4, left": as in feedback; a site in the middle has no side.
std::string spoken(const Site& site);

}  // namespace palpate::training

template <>
struct palpate::WordsOf<palpate::training::Side> {
  using V = palpate::training::Side;
  static constexpr std::array kAll = {Word{"left", V::left}, Word{"right", V::right}, Word{"middle", V::middle}};
};
