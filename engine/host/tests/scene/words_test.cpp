#include "palpate/scene/words.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>

namespace palpate::scene {
namespace {

template <class Value>
class WordsOfAType : public testing::Test {};

using Types =
    testing::Types<Reading, BodyKind, Unit, body::Side, StiffnessSource, ContactSource, HapticSurface, Move,
                   maps::StiffnessInterpolation, maps::ForceDirection, maps::Averaging,
                   std::optional<maps::LiteralWeights>, maps::DirectionBlend, tissue::ForceLaw::Kind, hdb::TreeKind,
                   hdb::Assignment, hdb::HdbQuery, std::optional<hdb::LiteralTraversal>, deform::NormalRegion,
                   EllipsePlace, deform::Shape, deform::Boundary, deform::Together, deform::Normals, deform::StrainKind,
                   tissue::ProfileKind, tissue::ProfileRim, tissue::TableLookup, tissue::UserInterpolation,
                   StandardView, Shading, Colouring, Overlay, FingerShape, StereoMode>;
TYPED_TEST_SUITE(WordsOfAType, Types);

/// Two enumerators with one word, or one with two, would read back as something else than was written.
TYPED_TEST(WordsOfAType, LeadThereAndBack) {
  std::set<std::string_view> seen;
  for (const auto& [word, value] : WordsOf<TypeParam>::kAll) {
    EXPECT_TRUE(seen.insert(word).second) << word;
    EXPECT_EQ(wordFor(value), word);
    const std::optional<TypeParam> found = valueNamed<TypeParam>(word);
    EXPECT_TRUE(found.has_value() && *found == value) << word;
    EXPECT_TRUE(std::regex_match(std::string(word), std::regex("[A-Za-z][a-z_-]*"))) << word;
  }
}

TYPED_TEST(WordsOfAType, KnowNoOthers) {
  EXPECT_FALSE(valueNamed<TypeParam>("").has_value());
  EXPECT_FALSE(valueNamed<TypeParam>("nonsense").has_value());
}

TEST(Words, OfEarlierVersionsAreReadAndNotListed) {
  EXPECT_EQ(valueNamed<FingerShape>("sphere"), FingerShape::ball);
  for (const std::string_view word : enumNames<FingerShape>()) EXPECT_NE(word, "sphere");
}

/// The display keeps overlays as bits and remembers choices as numbers: tables without a gap.
template <class E>
void expectEveryNumber() {
  for (std::size_t i = 0; i < WordsOf<E>::kAll.size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(WordsOf<E>::kAll[i].value), i);
  }
}

TEST(Words, OfPicturesNameEveryEnumerator) {
  expectEveryNumber<StandardView>();
  expectEveryNumber<Shading>();
  expectEveryNumber<Colouring>();
  expectEveryNumber<Overlay>();
  expectEveryNumber<FingerShape>();
  expectEveryNumber<StereoMode>();
}

}  // namespace
}  // namespace palpate::scene
