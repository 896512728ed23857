// Figures for people: by their keys, in as few lines as can be read.
#include "report/page/figures_text.h"

#include <gtest/gtest.h>

namespace palpate::study {

TEST(FiguresText, GivesEachFigureALineByItsKey) {
  EXPECT_EQ(figuresText({{"ticks", 41582}, {"tick_us", 1.23456}, {"hash", "00ff"}, {"locks", nullptr}, {"same", true}}),
            "ticks: 41582\ntick_us: 1.235\nhash: 00ff\nlocks: null\nsame: true\n");
}

TEST(FiguresText, KeepsFiguresWithinAFigureInItsLine) {
  EXPECT_EQ(figuresText({{"tick_us", {{"p50", 0.5}, {"max", 7}}}, {"radii_mm", Json::array({2, 0.25})}}),
            "tick_us: p50 0.5, max 7\nradii_mm: 2, 0.25\n");
  EXPECT_EQ(figuresText({{"left_out", Json::array()}, {"peers", Json::object()}}), "left_out: none\npeers: none\n");
}

TEST(FiguresText, IndentsFiguresThatHaveSomeOfTheirOwn) {
  const Json cgal = {{"query_us", {{"p50", 3.0}, {"max", 9.0}}}, {"hits", 4}};
  EXPECT_EQ(figuresText({{"peers", {{"cgal", cgal}, {"fcl", {{"skipped", "not installed"}, {"package", "fcl"}}}}}}),
            "peers:\n  cgal:\n    query_us: p50 3, max 9\n    hits: 4\n  fcl: not installed\n");
  const Json step = {{"name", "reading"}, {"seconds", 0.1}};
  EXPECT_EQ(figuresText({{"steps", Json::array({step, step})}}),
            "steps:\n  name reading, seconds 0.1\n  name reading, seconds 0.1\n");
}

}  // namespace palpate::study
