// Every figure can be drawn, is named in the index, and shows what the formulae say.
#include "dissertation/figures/figure_study.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <set>

#include "dissertation/report/report.h"
#include "lab/measured/model_meshes.h"
#include "lab/measured/pressed_skin.h"
#include "palpate/base/text.h"
#include "report/tests/report/texts_apart.h"
#include "support/error_message.h"
#include "support/temporary_folder.h"

namespace palpate::study {

namespace {

namespace fs = std::filesystem;

figures::Figure drawn(const std::string& number) { return chosenFigures({number}).at(0).draw(); }

const figures::Series& seriesAt(const figures::Figure& figure, std::size_t panel, std::size_t series) {
  return std::get<figures::Plot>(figure.panels.at(panel)).series.at(series);
}

}  // namespace

TEST(DissertationFigures, AreListedOnceInTheOrderOfTheText) {
  const auto all = dissertationFigures();
  EXPECT_GE(all.size(), 34u);
  std::set<std::string> numbers;
  for (const auto& figure : all) {
    EXPECT_TRUE(numbers.insert(figure.number).second) << figure.number;
    EXPECT_FALSE(figure.caption.empty());
  }
  EXPECT_EQ(all.front().number, "3.1");
  EXPECT_EQ(all.back().number, "5.12");
  for (const char* wanted : {"3.4", "3.6", "3.7", "3.8",  "3.9",  "3.10", "3.11", "3.13", "3.15", "4.4",
                             "4.7", "4.8", "4.9", "4.14", "4.15", "4.18", "5.3",  "5.9",  "5.10", "5.11"}) {
    EXPECT_TRUE(numbers.contains(wanted)) << wanted;
  }
}

TEST(DissertationFigures, AllAreDrawnWithTextsApart) {
  for (const auto& entry : dissertationFigures()) {
    const figures::Figure figure = entry.draw();
    const auto texts = figures::collectDrawnTexts(figure);
    EXPECT_FALSE(texts.empty() && figure.panels.empty()) << entry.number;
    expectTextsApart(figure, entry.number);
  }
}

TEST(DissertationFigures, AreWrittenWithTheirDataAndAnIndex) {
  const support::TemporaryFolder folder;
  writeFigures(chosenFigures({"4.8", "T4.2"}), folder.path() / "new");
  for (const char* file : {"figure_4_8.png", "figure_4_8.svg", "figure_4_8.csv", "table_4_2.png", "index.md"}) {
    EXPECT_TRUE(fs::exists(folder.path() / "new" / file)) << file;
  }
  const std::string index = readFile(folder.path() / "new/index.md", 1 << 20);
  EXPECT_NE(index.find("## Figure 4.8"), std::string::npos);
  EXPECT_NE(index.find("## Table 4.2"), std::string::npos);
  EXPECT_EQ(index.find("Figure 4.9"), std::string::npos);
  EXPECT_NE(readFile(folder.path() / "new/figure_4_8.csv", 1 << 20).find("\n2,M[i],0,1,\n"), std::string::npos);
}

TEST(DissertationFigures, AnUnknownNumberOrAFolderThatCannotBeIsRefusedByName) {
  EXPECT_NE(support::thrownMessage([] { chosenFigures({"9.9"}); }).find("9.9"), std::string::npos);
  EXPECT_NE(support::thrownMessage([] { writeFigures({}, "/proc/nowhere"); }).find("/proc/nowhere"), std::string::npos);
}

TEST(DissertationFigures, ShowTheNumbersOfTheText) {
  // Figure 4.8: the last entry of the array is 0.0021.
  const figures::Figure profile = drawn("4.8");
  EXPECT_NEAR(seriesAt(profile, 1, 0).y.back(), 0.0021, 0.0001);
  // Figure 5.10: 120 at every key.
  const figures::Figure interpolated = drawn("5.10");
  const figures::Series& exact = seriesAt(interpolated, 1, 0);
  int keys = 0;
  for (std::size_t i = 0; i < exact.x.size(); ++i) {
    if (exact.x[i] == 150.0 || exact.x[i] == 60.0 || exact.x[i] == -30.0) {
      EXPECT_NEAR(exact.y[i], 120.0, 1e-9);
      ++keys;
    }
  }
  EXPECT_EQ(keys, 3);
}

TEST(DissertationFigures, SayWhatTheyAreDrawnFrom) {
  std::vector<DissertationFigure> figures = dissertationFigures();
  const auto said = [&] { return fmt::format("{}", fmt::join(figuresFindings(figures), "\n")); };
  EXPECT_NE(said().find("plot printed numbers again and compute nothing: 3.1, 3.10, 3.16, 3.17, 3.18, 5.3."),
            std::string::npos);
  for (const char* number : {"4.7", "4.12", "4.16", "4.18"}) {
    EXPECT_EQ(chosenFigures({number}).at(0).basis, FigureBasis::own_example) << number;
  }
  for (DissertationFigure& figure : figures) figure.basis = FigureBasis::computed;
  EXPECT_EQ(said().find("plot printed numbers again"), std::string::npos);
  EXPECT_NE(said().find(fmt::format("{0} figures are drawn: {0} are computed", figures.size())), std::string::npos);
}

TEST(FeltContact, IsWhatFrictionMakesOfAFinger) {
  const mesh::TriangleMesh back = backModel(8163);
  const auto drag_with = [&](double ratio) {
    const FeltStroke stroke{.at = Vec2(45.0, 10.0), .stroke_mm = Vec2(0.0, 30.0), .stiffness_ratio = ratio};
    const deform::Contact contact = feltContact(back, stroke);
    EXPECT_NEAR(contact.depth_mm, 10.0, 2.5);  // the back is not flat
    EXPECT_GT(contact.tangential_region.half_major.norm(), 130.0) << "the map's";
    return contact.drag_mm.norm() / contact.depth_mm;
  };
  EXPECT_NEAR(drag_with(1.0), 0.44, 0.03);
  EXPECT_NEAR(drag_with(0.23), 0.44 / 0.23, 0.1);
}

TEST(PressedSkin, FollowsTheFingerAtTheContactAndRestsFarAway) {
  const mesh::TriangleMesh back = backModel(8163);
  const Press press{.at = Vec2(40.0, 0.0), .depth_mm = 8.0};
  const PressedSkin skin = pressed(back, press);
  const auto rest = crossSection(back.positions, back.triangles, 0.0);
  const auto deformed = crossSection(skin.positions, back.triangles, 0.0);
  ASSERT_GT(rest.size(), 50u);
  const auto height_at = [](const std::vector<Vec2>& cut, double x) {
    double height = 0.0;
    double nearest = 1e9;
    for (const Vec2& point : cut) {
      if (std::abs(point.x() - x) < nearest) height = point.y();
      nearest = std::min(nearest, std::abs(point.x() - x));
    }
    return height;
  };
  EXPECT_NEAR(height_at(rest, 40.0) - height_at(deformed, 40.0), 8.0, 1.5);  // one triangle is 5 mm
  EXPECT_NEAR(height_at(rest, -60.0), height_at(deformed, -60.0), 1e-3);
  EXPECT_NE(support::thrownMessage([&] { placeOn(back, {900.0, 0.0}); }), "no error");
}

TEST(ModelMeshes, TheOutlineHoldsTheBack) {
  const auto outline = backOutline();
  EXPECT_TRUE(isInside(outline, {0.0, 0.0}));
  EXPECT_FALSE(isInside(outline, {400.0, 0.0}));
  EXPECT_EQ(backModel().triangles.size(), kBackTriangles);
}

}  // namespace palpate::study
