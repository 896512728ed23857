// The study of relaxation says what its numbers say, and its numbers are those of exponentials.
#include <gtest/gtest.h>

#include <cmath>

#include "dissertation/relaxation/relaxation_measurement.h"
#include "dissertation/studies.h"
#include "report/tests/report/page_numbers.h"
#include "report/tests/report/says.h"

namespace palpate::study {

namespace {

const RelaxationMeasurement& measuredRelaxation() {
  static const RelaxationMeasurement found = measureRelaxation(true, {});
  return found;
}

}  // namespace

TEST(RelaxationStudy, LosesWhatTheTermsSay) {
  const RelaxingSkin& offered = measuredRelaxation().skins.at(1);
  const double at_once = offered.held_n.front();
  for (const double t : {0.5, 1.0, 10.0}) {
    // The approach takes 40 ms: some of it is lost before the finger has arrived.
    EXPECT_NEAR(lostForceShare(offered, t), 0.15 * (1.0 - std::exp(-t)), 0.003) << t;
  }
  const RelaxingSkin& none = measuredRelaxation().skins.at(0);
  EXPECT_EQ(lostForceShare(none, 10.0), 0.0);
  EXPECT_EQ(none.dent_mm.front(), 0.0);
  EXPECT_NEAR(at_once / none.held_n.front(), 1.0, 0.005);
  EXPECT_GT(offered.dent_mm.front(), 0.15 * 8.0) << "layered tissue stiffens";
}

TEST(RelaxationStudy, SaysWhatIsMeasured) {
  const auto findings = relaxationFindings(measuredRelaxation());
  EXPECT_TRUE(says(findings, "a hand notices that"));
  EXPECT_TRUE(says(findings, "within 2 % of the force"));
  EXPECT_TRUE(says(findings, "never gives more than it was given"));
  EXPECT_TRUE(says(findings, "0.440000 to 0.440000: Coulomb's law knows nothing of time"));
}

TEST(RelaxationStudy, SaysOtherwiseOfOtherNumbers) {
  RelaxationMeasurement found = measuredRelaxation();
  found.cycles.front().lost_share = -0.01;
  EXPECT_TRUE(says(relaxationFindings(found), "GIVES energy"));
  found = measuredRelaxation();
  found.skins.at(1).friction_high = 0.46;
  EXPECT_TRUE(says(relaxationFindings(found), "is NOT"));
  found = measuredRelaxation();
  for (double& force : found.skins.at(2).held_n) force = found.skins.at(2).held_n.front();
  EXPECT_TRUE(says(relaxationFindings(found), "off by up to 54 %"));
  found = measuredRelaxation();
  for (double& force : found.skins.at(1).held_n) force = found.skins.at(1).held_n.front();
  EXPECT_TRUE(says(relaxationFindings(found), "a hand hardly notices that"));
}

TEST(RelaxationStudy, HasItsMainNumbers) {
  const StudyPage page = studyRelaxation({.quick = true});
  EXPECT_NEAR(numberOf(page, "lost_after_10_s"), 0.15, 0.003);
  EXPECT_GT(numberOf(page, "work_lost_share_least"), 0.0);
  EXPECT_NEAR(numberOf(page, "friction_ratio_high"), 0.44, 1e-9);
}

}  // namespace palpate::study
