#include "palpate/maps/measured_data.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "palpate/maps/key_points.h"
#include "support/golden.h"

namespace palpate::maps {

/// Angle between two undirected axes, in degree.
double axesApart(double a_deg, double b_deg) {
  const double folded = std::fmod(std::abs(a_deg - b_deg), 180.0);
  return std::min(folded, 180.0 - folded);
}

/// The golden record of every force direction and point, with our rows.
template <class Check>
void forEachPoint(const Check& check) {
  const nlohmann::json data = test::golden("appendix_c").at("data");
  int points = 0;
  for (const ForceDirection force : {ForceDirection::up, ForceDirection::down}) {
    for (int point = 1; point <= kMeasuredPoints; ++point, ++points) {
      const std::string name = fmt::format("{}_P{}", force == ForceDirection::up ? "up" : "down", point);
      SCOPED_TRACE(name);
      check(data.at(name), measuredAt(force, point));
    }
  }
  EXPECT_EQ(points, static_cast<int>(data.size()));
}

TEST(MeasuredData, EveryRowOfTheAppendix) {
  EXPECT_EQ(appendixC().size(), 40u);
  forEachPoint([](const nlohmann::json& golden, const std::vector<MeasuredEllipse>& rows) {
    ASSERT_EQ(rows.size(), golden["rows"].size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      EXPECT_EQ(rows[i].major_cm, golden["rows"][i]["major_cm"]);
      EXPECT_EQ(rows[i].minor_cm, golden["rows"][i]["minor_cm"]);
      EXPECT_EQ(rows[i].direction_deg, golden["rows"][i]["deg"]);
      EXPECT_NEAR(rows[i].majorOverMinor(), golden["rows"][i]["ratio_printed"], 0.00051);
    }
  });
}

TEST(MeasuredData, PlainMeansAreThePrintedOnes) {
  forEachPoint([](const nlohmann::json& golden, const std::vector<MeasuredEllipse>& rows) {
    const PlainMean mean = plainMean(rows);
    EXPECT_NEAR(mean.major_cm, golden["mean_major_cm"], 1e-12);
    EXPECT_NEAR(mean.minor_cm, golden["mean_minor_cm"], 1e-12);
    EXPECT_NEAR(mean.major_over_minor, golden["mean_of_exact_ratios"], 1e-14);
    EXPECT_NEAR(mean.direction_deg, golden["arithmetic_mean_deg"], 1e-12);
    const nlohmann::json& printed = golden["printed_average"];
    EXPECT_NEAR(mean.major_cm, printed["major_cm"], 0.05);
    EXPECT_NEAR(mean.minor_cm, printed["minor_cm"], 0.05);
    EXPECT_NEAR(mean.major_over_minor, printed["ratio"], 0.0005);
    EXPECT_NEAR(mean.direction_deg, printed["deg"], 0.05);
  });
}

TEST(MeasuredData, PlainEllipseHasThePrintedDigits) {
  forEachPoint([](const nlohmann::json& golden, const std::vector<MeasuredEllipse>& rows) {
    const Ellipse e = meanEllipse(rows, Averaging::plain);
    const nlohmann::json& printed = golden["printed_average"];
    EXPECT_DOUBLE_EQ(e.half_major_mm, 5.0 * printed["major_cm"].get<double>());
    EXPECT_NEAR(1.0 / e.aspect, printed["ratio"], 1e-12);
    EXPECT_NEAR(axesApart(e.direction_rad / kRadPerDeg, printed["deg"]), 0.0, 1e-9);
  });
}

TEST(MeasuredData, TensorialMeansAreLogEuclidean) {
  forEachPoint([](const nlohmann::json& golden, const std::vector<MeasuredEllipse>& rows) {
    const Ellipse e = meanEllipse(rows, Averaging::tensorial);
    const nlohmann::json& expected = golden["log_tensor_mean"];
    EXPECT_NEAR(e.half_major_mm, 10.0 * expected["half_major_cm"].get<double>(), 1e-10);
    EXPECT_NEAR(1.0 / e.aspect, expected["ratio"], 1e-12);
    EXPECT_NEAR(axesApart(e.direction_rad / kRadPerDeg, expected["deg"]), 0.0, 1e-9);
  });
}

TEST(MeasuredData, AxialMeansTellHowMuchTheSubjectsAgree) {
  forEachPoint([](const nlohmann::json& golden, const std::vector<MeasuredEllipse>& rows) {
    const AxialMean mean = axialMean(rows);
    EXPECT_NEAR(axesApart(mean.direction_deg, golden["axial_mean_deg"]), 0.0, 1e-9);
    EXPECT_NEAR(mean.resultant, golden["axial_resultant"], 1e-12);
  });
  EXPECT_LT(axialMean(measuredAt(ForceDirection::up, 5)).resultant, 0.5);
}

TEST(MeasuredData, OtherPointsWereNotMeasured) {
  EXPECT_TRUE(measuredAt(ForceDirection::up, 6).empty());
  EXPECT_TRUE(measuredAt(ForceDirection::down, 0).empty());
}

TEST(DissertationKeyPoints, DefaultIsFigure53) {
  const auto keys = dissertationKeyPoints();
  ASSERT_EQ(keys.size(), 7u);
  const double half_major[] = {179, 149, 133, 179, 142, 179, 142};
  const double ratio[] = {1.134, 1.049, 1.231, 1.357, 1.313, 1.357, 1.313};
  const double degree[] = {90.0, 90.0, 180.0, 99.4, 121.0, 80.6, 59.0};
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(keys[i].ellipse.half_major_mm, half_major[i]) << keys[i].name;
    EXPECT_NEAR(keys[i].ellipse.aspect, 1.0 / ratio[i], 1e-15) << keys[i].name;
    EXPECT_NEAR(axesApart(keys[i].ellipse.direction_rad / kRadPerDeg, degree[i]), 0.0, 1e-12) << keys[i].name;
  }
}

TEST(DissertationKeyPoints, ChoicesAreMirroredToo) {
  for (const ForceDirection force : {ForceDirection::up, ForceDirection::down}) {
    for (const Averaging averaging : {Averaging::plain, Averaging::tensorial}) {
      const auto keys = dissertationKeyPoints({force, averaging});
      for (const auto& [left, right] : {std::pair{3, 5}, std::pair{4, 6}}) {
        EXPECT_EQ(keys[left].ellipse.half_major_mm, keys[right].ellipse.half_major_mm);
        EXPECT_NEAR(keys[left].ellipse.aspect, keys[right].ellipse.aspect, 1e-15);
        EXPECT_NEAR(keys[left].ellipse.direction_rad + keys[right].ellipse.direction_rad, std::numbers::pi, 1e-12);
      }
    }
  }
}

// E31: the text calls the two force directions similar.
TEST(DissertationKeyPoints, DraggedDownTheEllipsesAreOthers) {
  const auto up = dissertationKeyPoints();
  const auto down = dissertationKeyPoints({ForceDirection::down, Averaging::plain});
  const auto change = [&](std::size_t i) { return down[i].ellipse.half_major_mm / up[i].ellipse.half_major_mm - 1.0; };
  EXPECT_NEAR(change(0), -0.24, 0.005);
  EXPECT_NEAR(change(1), 0.21, 0.005);
  EXPECT_NEAR(change(4), 0.36, 0.005);
}

}  // namespace palpate::maps
