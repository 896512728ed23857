#include "solve/realism/living_limbs.h"

#include <algorithm>
#include <array>

namespace palpate::lab {

std::span<const LimbSite> limbSites() {
  static constexpr std::array kSites = {
      LimbSite{"LA_A", "lower arm, front", 7.0, 23.0},  LimbSite{"LA_P", "lower arm, back", 7.0, 27.0},
      LimbSite{"UA_A", "upper arm, front", 11.0, 12.0}, LimbSite{"UA_P", "upper arm, back", 11.0, 7.0},
      LimbSite{"LL_A", "lower leg, front", 13.0, 31.0}, LimbSite{"LL_P", "lower leg, back", 13.0, 11.0},
      LimbSite{"UL_A", "upper leg, front", 14.0, 12.0}, LimbSite{"UL_P", "upper leg, back", 14.0, 6.5}};
  return kSites;
}

const LimbSite* siteNamed(std::string_view code) {
  const auto found = std::ranges::find(limbSites(), code, &LimbSite::code);
  return found == limbSites().end() ? nullptr : &*found;
}

std::string siteCodes() {
  std::string codes;
  for (const LimbSite& site : limbSites()) codes += (codes.empty() ? "" : ", ") + std::string(site.code);
  return codes;
}

}  // namespace palpate::lab
