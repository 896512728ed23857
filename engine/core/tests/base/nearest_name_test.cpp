#include "palpate/base/nearest_name.h"

#include <gtest/gtest.h>

namespace palpate {
namespace {

const std::vector<std::string> kNames = {"seconds", "radius-mm", "mesh", "json"};

TEST(NearestName, ForgivesAFewLettersAndAnotherUnit) {
  EXPECT_EQ(nearestName("secnds", kNames), "seconds");
  EXPECT_EQ(nearestName("radius", kNames), "radius-mm");
  EXPECT_EQ(nearestName("radius-cm", kNames), "radius-mm");
  EXPECT_EQ(nearestName("banana", kNames), "");
  EXPECT_EQ(nearestName(std::string(100, 'j'), kNames), "") << "nobody types that by mistake";
}

TEST(NearestName, OfAShortWordOneLetterMustBeRight) {
  EXPECT_EQ(nearestName("D", {"A", "B", "C"}), "");
  EXPECT_EQ(nearestName("bps", {"bsp", "octree"}), "bsp");
}

TEST(NearestNames, AreTheNearestOfAllWhateverTheirCase) {
  const std::vector<std::string> names = {"T6", "left PSIS", "L2", "right PSIS"};
  EXPECT_EQ(nearestNames("LEFT psis", names, 1), (std::vector<std::string>{"left PSIS"}));
  EXPECT_EQ(nearestNames("x", names, 9).size(), 4u);
  EXPECT_TRUE(nearestNames("x", {}, 3).empty());
}

TEST(UnknownName, SaysWhereAndWhatWasMeant) {
  EXPECT_EQ(unknownName("option", "secnds", "simulate", kNames),
            "unknown option 'secnds' in simulate; did you mean 'seconds'?");
  EXPECT_EQ(unknownName("option", "ban\nana", "", kNames),
            "unknown option 'ban?ana'; known: seconds, radius-mm, mesh, json");
}

}  // namespace
}  // namespace palpate
