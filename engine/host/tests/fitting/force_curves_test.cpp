#include "palpate/tissue/fitting/force_curves.h"

#include <gtest/gtest.h>

#include <fstream>

#include "support/error_message.h"
#include "support/expect_each.h"
#include "support/temporary_folder.h"

namespace palpate::tissue {
namespace {

std::string errorMessage(const std::string& text) {
  return support::thrownMessage([&] { parseForceCurves(text, "f.csv"); });
}

TEST(ForceCurves, AreOneWithoutAName) {
  const auto curves = parseForceCurves("depth_mm,force_n\n0,0\n1,0.2\n-0.5,-0.01\n", "f.csv");
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_EQ(curves[0].name, "");
  EXPECT_EQ(curves[0].depth_mm, (std::vector<double>{0, 1, -0.5}));
  EXPECT_EQ(curves[0].force_n[2], -0.01);
  EXPECT_EQ(parseForceCurves("1,0.2\n2,0.4\n", "f.csv")[0].force_n[1], 0.4) << "without a header";
}

TEST(ForceCurves, AreToldApartByTheirPlace) {
  const auto curves = parseForceCurves("force_n,operator,place,depth_mm\n1,x,T6,2\n3,x,L3,4\n5,x,T6,6\n", "f.csv");
  ASSERT_EQ(curves.size(), 2u);
  EXPECT_EQ(curves[0].name, "T6");
  EXPECT_EQ(curves[0].depth_mm, (std::vector<double>{2, 6}));
  EXPECT_EQ(curves[0].force_n, (std::vector<double>{1, 5}));
  EXPECT_EQ(curves[1].name, "L3");
  EXPECT_EQ(parseForceCurves("depth_mm,force_n,curve\n1,1,a\n1,1,b\n", "f.csv").size(), 2u);
}

TEST(ForceCurves, AreReadFromAFile) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "f.csv") << "1,0.2\n";
  EXPECT_EQ(readForceCurves(folder / "f.csv").size(), 1u);
  EXPECT_NE(support::thrownMessage([&] { readForceCurves(folder / "none.csv"); }).find("none.csv"), std::string::npos);
}

TEST(ForceCurves, NameTheLineThatIsWrong) {
  support::expectEach(errorMessage, {{"depth_mm,force\n1,2\n", "f.csv:1: the header has no column force_n"},
                                     {"depth_mm,force_n\n1,2\n1,2,3\n", "f.csv:3: found 3 fields; expected 2"},
                                     {"depth_mm,force_n\n1,two\n", "f.csv:2: force_n is not a number: 'two'"},
                                     {"1,inf\n", "f.csv:1: force_n must be finite, got inf"},
                                     {"5000,1\n", "f.csv:1: depth_mm = 5000 is out of range: -1,000 to 1,000"},
                                     {"depth_mm,force_n\n", "f.csv: has no rows; expected depth_mm,force_n"}});
}

}  // namespace
}  // namespace palpate::tissue
