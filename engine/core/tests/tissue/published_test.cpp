#include "palpate/tissue/published.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "palpate/tissue/layered_library.h"
#include "support/error_message.h"

namespace palpate::tissue {
namespace {

TEST(Published, EveryModulusHasASourceOrADoubt) {
  std::set<std::string_view> tissues;
  for (const PublishedModulus& modulus : publishedModuli()) {
    EXPECT_GT(modulus.low_kpa, 0.0) << modulus.how;
    EXPECT_GE(modulus.high_kpa, modulus.low_kpa) << modulus.how;
    EXPECT_FALSE(modulus.how.empty());
    EXPECT_FALSE(modulus.source.empty() && modulus.doubt.empty()) << modulus.how;
    tissues.insert(modulus.tissue);
  }
  EXPECT_EQ(tissues, (std::set<std::string_view>{"fat", "muscle", "skin"}));
}

TEST(Published, DefaultsLieWithinTheSpreadAndAreWhatWasSolved) {
  for (const Layer& layer : libraryStack(40.0, 0.3).layers) {
    const double chosen = defaultModulus(layer.name);
    EXPECT_EQ(layer.young_kpa, chosen) << layer.name;
    double low = 1e9;
    double high = 0.0;
    for (const PublishedModulus& modulus : publishedModuli()) {
      if (modulus.tissue != layer.name || modulus.is_default) continue;
      low = std::min(low, modulus.low_kpa);
      high = std::max(high, modulus.high_kpa);
    }
    EXPECT_GE(chosen, low) << layer.name;
    EXPECT_LE(chosen, high) << layer.name;
  }
  EXPECT_EQ(support::thrownMessage([] { defaultModulus("mucsle"); }),
            "unknown tissue 'mucsle'; did you mean 'muscle'?");
}

TEST(Published, FrictionOfThePresetsIsWithinWhatWasMeasured) {
  ASSERT_EQ(frictionPresets().size(), 2u);
  for (const FrictionPreset& preset : frictionPresets()) {
    EXPECT_GE(preset.still, preset.slipping);
    const PublishedFriction& measured = publishedFriction()[preset.name == "dry" ? 0 : 1];
    EXPECT_GE(preset.slipping, measured.low);
    EXPECT_LE(preset.still, measured.high);
  }
}

}  // namespace
}  // namespace palpate::tissue
