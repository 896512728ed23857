// Only what was looked up or chosen, each with what is not sure about it.
#include "palpate/tissue/published.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"

namespace palpate::tissue {

std::span<const PublishedModulus> publishedModuli() {
  static constexpr std::string_view kWithoutIdentifier = "its identifier is not at hand";
  static constexpr std::string_view kFromMemory = "quoted from memory of Pailler-Mattei 2008, not looked up";
  static constexpr std::array kModuli = {
      PublishedModulus{"skin", 150, 150, "chosen for the solved stacks: 2 mm thick", "", "a choice within the spread",
                       true},
      PublishedModulus{"skin", 1000, 1000, "chosen for the stack of stiff skin", "", "a choice within the spread"},
      PublishedModulus{"skin", 300, 2060, "skin of the back, strips pulled: initial slope 1.18 +- 0.88 MPa",
                       "arXiv 1302.3022", "along the skin, and stiffer along its lines of tension"},
      PublishedModulus{"skin", 1100, 1100, "dermis, magnetic resonance pictures under an indenter", "",
                       kWithoutIdentifier},
      PublishedModulus{"skin", 35, 35, "three layers under an indenter", "", kFromMemory},
      PublishedModulus{"fat", 10, 10, "chosen for the solved stacks", "", "a choice within the spread", true},
      PublishedModulus{"fat", 2.52, 2.52, "hypodermis, pictures under an indenter: C10 = 0.42 kPa, E = 6 C10", "",
                       kWithoutIdentifier},
      PublishedModulus{"fat", 26, 2200, "gluteal subcutis, loaded with 1 N and with 30 N", "PMC9711973",
                       "85 times as stiff under the larger load"},
      PublishedModulus{"fat", 2, 2, "three layers under an indenter", "", kFromMemory},
      PublishedModulus{"muscle", 27, 27, "chosen for the solved stacks: 3 rho v^2 of 3.0 m/s", "",
                       "at rest; a tense muscle is stiffer", true},
      PublishedModulus{"muscle", 23.5, 27, "erector spinae, shear waves of 2.8 to 3.0 m/s, 278 people: 3 rho v^2",
                       "doi 10.1186/s12891-017-1733-8", "as if it had no direction"},
      PublishedModulus{"muscle", 80, 80, "three layers under an indenter", "", kFromMemory},
  };
  return kModuli;
}

std::span<const PublishedFriction> publishedFriction() {
  static constexpr std::array kFriction = {
      PublishedFriction{"dry living skin", 0.31, 0.61, "published, 0.46 +- 0.15", "its identifier is not at hand"},
      PublishedFriction{"wet kidney", 0.14, 0.29, "recordings of a ball drawn over it",
                        "own fits, docs/reference/tissue-tables.md"},
      PublishedFriction{"silicone phantoms", 0.20, 0.84, "recordings of a ball drawn over them",
                        "own fits, docs/reference/tissue-tables.md"},
  };
  return kFriction;
}

std::span<const FrictionPreset> frictionPresets() {
  static constexpr std::array kPresets = {
      FrictionPreset{"dry", 0.46, 0.44, "the mean of dry living skin; data do not show the gap between the two"},
      FrictionPreset{"oiled", 0.2, 0.2, "within 0.15 to 0.3, as wet organs have it"},
  };
  return kPresets;
}

double defaultModulus(std::string_view tissue) {
  const auto found = std::ranges::find_if(publishedModuli(), [&](const PublishedModulus& modulus) {
    return modulus.is_default && modulus.tissue == tissue;
  });
  if (found == publishedModuli().end()) {
    throw Error(unknownName("tissue", tissue, "", {"skin", "fat", "muscle"}));
  }
  return found->low_kpa;
}

std::string_view moduliCaveat() {
  return "The defaults are within the range of people, but represent no individual: published stiffness of one tissue "
         "varies by a factor of 100 to 1000 with method, load and person.";
}

}  // namespace palpate::tissue
