// The list that recordings, C and Python go by has every number of a finger's settings, each by one name.
#include "palpate/contact/finger_fields.h"

#include <gtest/gtest.h>

namespace palpate::contact {
namespace {

TEST(FingerFields, AreAllNumbersThatAFingerHas) {
  EXPECT_EQ(sizeof(FingerSettings), kFingerFields.size() * sizeof(double)) << "a number without a field?";
}

TEST(FingerFields, EachIsANumberOfItsOwn) {
  for (const auto& field : kFingerFields) {
    FingerSettings settings;
    const double set = field.is_flag ? 1.0 : 0.125;
    field.set(settings, set);
    EXPECT_EQ(field.get(settings), set) << field.name;
    for (const auto& other : kFingerFields) {
      if (other.name == field.name) continue;
      EXPECT_EQ(other.get(settings), other.get({})) << field.name << ", " << other.name;
    }
  }
}

TEST(FingerFields, TheUsualSettingsAreInTheirRanges) {
  for (const auto& field : kFingerFields) EXPECT_TRUE(field.range.holds(field.get({}))) << field.name;
}

}  // namespace
}  // namespace palpate::contact
