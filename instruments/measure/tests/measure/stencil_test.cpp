// The stencil as a printer sees it: its numbers are read back from the SVG.
#include "palpate/measure/stencil.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "support/error_message.h"

namespace palpate::measure {
namespace {

/// Circles of one class: centre x, centre y, radius.
std::vector<Vec3> circlesOf(const std::string& svg, const std::string& kind) {
  const std::regex circle("<circle class=\"" + kind + R"re(" cx="([0-9.]+)" cy="([0-9.]+)" r="([0-9.]+)")re");
  std::vector<Vec3> found;
  for (std::sregex_iterator match(svg.begin(), svg.end(), circle), end; match != end; ++match) {
    found.emplace_back(std::stod((*match)[1]), std::stod((*match)[2]), std::stod((*match)[3]));
  }
  return found;
}

/// Of the paper, and whether a unit of its coordinates is a millimetre.
Vec2 paperOf(const std::string& svg) {
  const std::regex size(R"re(<svg [^>]*width="([0-9.]+)mm" height="([0-9.]+)mm" viewBox="0 0 ([0-9.]+) ([0-9.]+)")re");
  std::smatch match;
  if (!std::regex_search(svg, match, size)) return Vec2::Zero();
  EXPECT_EQ(match[1], match[3]);
  EXPECT_EQ(match[2], match[4]);
  return {std::stod(match[1]), std::stod(match[2])};
}

TEST(Stencil, HolesLieAtTheSpacingInMillimetres) {
  const auto sheets = stencilSheets({.spacing_mm = 25.0, .columns = 7, .rows = 9, .hole_mm = 6.0});
  ASSERT_EQ(sheets.size(), 1u);
  const auto holes = circlesOf(sheets.front().svg, "hole");
  ASSERT_EQ(holes.size(), 63u);
  std::set<long> columns;
  std::set<long> rows;
  for (const Vec3& hole : holes) {
    EXPECT_EQ(hole.z(), 3.0);
    columns.insert(std::lround(100.0 * (hole.x() - holes.front().x())));
    rows.insert(std::lround(100.0 * (hole.y() - holes.front().y())));
  }
  EXPECT_EQ(columns.size(), 7u);
  EXPECT_EQ(*columns.rbegin() - *columns.begin(), 15000) << "6 spacings";
  EXPECT_EQ(*rows.rbegin() - *rows.begin(), 20000) << "8 spacings";
  EXPECT_EQ(paperOf(sheets.front().svg), Vec2(210, 297)) << "the smallest that holds it";
}

TEST(Stencil, EverythingLiesOnThePaper) {
  for (const bool target : {false, true}) {
    const std::string svg = stencilSheets({.scale_target = target}).front().svg;
    const Vec2 paper = paperOf(svg);
    EXPECT_EQ(paper, Vec2(420, 594));
    for (const Vec3& hole : circlesOf(svg, "hole")) {
      EXPECT_GT(hole.x() - hole.z(), 0.0);
      EXPECT_LT(hole.x() + hole.z(), paper.x());
      EXPECT_LT(hole.y() + hole.z(), paper.y());
    }
    EXPECT_EQ(svg.find("id=\"ruler\"") != std::string::npos, target);
    EXPECT_NE(svg.find("towards the head"), std::string::npos);
    EXPECT_NE(svg.find("this bar is 100 mm"), std::string::npos);
  }
}

TEST(Stencil, TheContactIsMarkedAsFarFromFourDotsAsCanBe) {
  for (const int rows : {5, 8, 13}) {
    const StencilSettings settings{.columns = 10, .rows = rows};
    const auto marks = contactMarks(settings);
    EXPECT_EQ(marks.size(), rows >= 11 ? 3u : 1u);
    for (const Vec2& mark : marks) {
      int near = 0;
      for (const Vec2& hole : stencilHoles(settings)) {
        const double away = (hole - mark).norm();
        EXPECT_GT(away, 20.0) << "no dot touches it";
        near += std::abs(away - 15.0 * std::sqrt(2.0)) < 1e-9 ? 1 : 0;
      }
      EXPECT_EQ(near, 4);
    }
  }
}

TEST(Stencil, TilesShowEveryHoleOnce) {
  const StencilSettings settings{.page = StencilPage::tiled_a4};
  const auto sheets = stencilSheets(settings);
  EXPECT_EQ(sheets.size(), 4u);
  std::set<std::string> names;
  const std::regex window(
      R"re(<svg x="([0-9.]+)" y="([0-9.]+)" width="([0-9.]+)" height="([0-9.]+)" viewBox="([0-9.]+) ([0-9.]+) ([0-9.]+) ([0-9.]+)")re");
  std::size_t shown = 0;
  for (const StencilSheet& sheet : sheets) {
    names.insert(sheet.name);
    EXPECT_EQ(paperOf(sheet.svg), Vec2(210, 297));
    std::smatch match;
    ASSERT_TRUE(std::regex_search(sheet.svg, match, window));
    EXPECT_EQ(match[3], match[7]) << "true size";
    const Vec2 low(std::stod(match[5]), std::stod(match[6]));
    const Vec2 high = low + Vec2(std::stod(match[7]), std::stod(match[8]));
    for (const Vec3& hole : circlesOf(sheet.svg, "hole")) {
      const bool inside = hole.x() >= low.x() && hole.x() < high.x() && hole.y() >= low.y() && hole.y() < high.y();
      shown += inside ? 1 : 0;
    }
  }
  EXPECT_EQ(names.size(), sheets.size());
  EXPECT_EQ(shown, 11u * 13u);
}

TEST(Stencil, SaysWhatDoesNotFit) {
  const auto fault = [](const StencilSettings& settings) {
    return support::thrownMessage([&] { stencilSheets(settings); });
  };
  EXPECT_EQ(fault({.page = StencilPage::a3}),
            "stencil: 11 x 13 holes need 320 x 426 mm, a3 has 297 x 420; use a2, tiled-a4 or fewer holes");
  EXPECT_EQ(fault({.spacing_mm = 2.0}), "stencil: spacing = 2 is out of range: 5 to 100 mm");
  EXPECT_EQ(fault({.hole_mm = 16.0}), "stencil: hole = 16 is out of range: 1 to 15 mm");
  EXPECT_EQ(fault({.rows = 1}), "stencil: rows = 1 is out of range: 2 to 60");
}

}  // namespace
}  // namespace palpate::measure
