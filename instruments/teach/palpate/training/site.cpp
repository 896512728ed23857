#include "palpate/training/site.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "palpate/base/error.h"
#include "palpate/base/language.h"
#include "palpate/body/places.h"

namespace palpate::training {

namespace {

/// Two places nearer than this are one to a fingertip of 8 mm that presses a centimetre deep.
constexpr double kMinApartMm = 15.0;
constexpr std::size_t kMaxSites = 40;

Side sideOf(const Vec3& point) {
  constexpr double kMiddleMm = 5.0;
  if (std::abs(point.x()) < kMiddleMm) return Side::middle;
  return point.x() < 0.0 ? Side::left : Side::right;
}

Site siteAt(std::span<const body::SkinLandmark> landmarks, const std::string& words) {
  const body::NamedPlace place = body::placeNamed(landmarks, words);
  return {.number = 0,
          .at = place.name,
          .label = place.name,
          .level = 0,
          .side = sideOf(place.point),
          .place_mm = Vec2(place.point.x(), place.point.y()),
          .point_mm = place.point};
}

void checkApart(const SiteSet& set) {
  for (std::size_t i = 0; i < set.sites.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if ((set.sites[i].place_mm - set.sites[j].place_mm).norm() >= kMinApartMm) continue;
      throw Error(fmt::format("sites: '{}' and '{}' are less than {:g} mm apart", set.sites[j].at, set.sites[i].at,
                              kMinApartMm));
    }
  }
}

/// Rows of sites from the top: a site that lies less than this below the one before it is of the same level.
void numberLevels(SiteSet& set) {
  constexpr double kSameLevelMm = 10.0;
  std::vector<Site*> from_top;
  for (Site& site : set.sites) from_top.push_back(&site);
  std::ranges::stable_sort(from_top, [](const Site* a, const Site* b) { return a->place_mm.y() > b->place_mm.y(); });
  int level = 0;
  double last_y = 0.0;
  for (Site* site : from_top) {
    if (level == 0 || last_y - site->place_mm.y() > kSameLevelMm) ++level;
    last_y = site->place_mm.y();
    site->level = level;
  }
}

}  // namespace

const Site* SiteSet::numbered(int number) const {
  return number >= 1 && number <= choices() ? &sites[static_cast<std::size_t>(number) - 1] : nullptr;
}

SiteSet twelveSites(std::span<const body::SkinLandmark> landmarks) {
  SiteSet set;
  for (const Side side : {Side::left, Side::right}) {
    for (std::size_t level = 0; level < body::kSiteLevels.size(); ++level) {
      Site site = siteAt(landmarks, fmt::format("{} site {}", wordFor(side), level + 1));
      site.label =
          side == Side::left ? trf("{}, left", body::kSiteLevels[level]) : trf("{}, right", body::kSiteLevels[level]);
      site.level = static_cast<int>(level) + 1;
      site.side = side;
      site.number = set.choices() + 1;
      set.sites.push_back(std::move(site));
    }
  }
  return set;
}

SiteSet sitesNamed(std::span<const body::SkinLandmark> landmarks, std::span<const std::string> places) {
  if (places.size() < 2 || places.size() > kMaxSites) {
    throw Error(fmt::format("sites: {} places; expected 2 to {}", places.size(), kMaxSites));
  }
  SiteSet set;
  for (const std::string& words : places) {
    set.sites.push_back(siteAt(landmarks, words));
    set.sites.back().number = set.choices();
  }
  checkApart(set);
  numberLevels(set);
  return set;
}

std::string spoken(const Site& site) {
  switch (site.side) {
    case Side::left:
      return trf("site {}, left", site.number);
    case Side::right:
      return trf("site {}, right", site.number);
    case Side::middle:
      break;
  }
  return trf("site {}", site.number);
}

}  // namespace palpate::training
