// The verdicts of the studies of chapters 4 and 5 are made of the numbers beside them: another number, another
// sentence.
#include <gtest/gtest.h>

#include "dissertation/directions/direction_fields.h"
#include "dissertation/interpolation/interpolation_findings.h"
#include "dissertation/profile/array_quality.h"
#include "report/tests/report/says.h"

namespace palpate::study {

namespace {

// Errors that fall as theory has it: 10 mm over the size, and over its square.
ProfileResults someProfiles() {
  ProfileResults results;
  for (std::size_t spacing = 0; spacing < kVertexSpacings.size(); ++spacing) {
    for (const int entries : kArraySizes) {
      const double finer = kPrintedSpacing / kVertexSpacings[spacing];
      results.nearest[spacing].push_back(
          {.entries = entries, .error_mm = 11.0 / entries, .turn_deg = 120.0 * finer / entries});
      results.linear[spacing].push_back(
          {.entries = entries, .error_mm = 15.0 / entries / entries, .turn_deg = 20.0 * finer / entries / entries});
    }
  }
  results.timing.nearest = results.timing.linear = std::vector<double>(kArraySizes.size(), 0.6);
  results.timing.closed = 3.1;
  return results;
}

ArrayQuality& sweepEntry(ArraySweep& sweep, int entries) { return sweep[indexOf(entries)]; }

}  // namespace

TEST(ProfileVerdicts, TheTextIsRightOnlyInWhatThePixelSays) {
  ProfileResults results = someProfiles();
  EXPECT_TRUE(says(profileFindings(results),
                   "the text is right that 20 is seen, that 130 is hardly told from 700, that "
                   "more than 700 is not needed"));
  sweepEntry(results.nearest[0], 20).error_mm = 0.1;
  EXPECT_TRUE(says(profileFindings(results), "it is not right that 20 is seen"));
  sweepEntry(results.nearest[0], 130).error_mm = 0.5;
  EXPECT_TRUE(says(profileFindings(results), "it is not right that 20 is seen, that 130 is hardly told from 700"));
  sweepEntry(results.nearest[0], 700).error_mm = 1.0;
  EXPECT_FALSE(says(profileFindings(results), "the text is right"));
}

TEST(ProfileVerdicts, EntriesSufficeOnlyWhereNoTurnIsSeen) {
  ProfileResults results = someProfiles();
  EXPECT_TRUE(says(profileFindings(results), "suffice for the mesh of 2008 and not for one of 1 mm"));
  sweepEntry(results.nearest[1], 700).turn_deg = 0.1;
  EXPECT_TRUE(says(profileFindings(results), "700 entries suffice for both"));
  sweepEntry(results.nearest[0], 700).turn_deg = 3.0;
  EXPECT_TRUE(says(profileFindings(results), "suffice for the finer mesh only"));
  sweepEntry(results.nearest[1], 700).turn_deg = 3.0;
  EXPECT_TRUE(says(profileFindings(results), "700 entries suffice for neither"));
}

TEST(ProfileVerdicts, LinearReadingOrderAndTimeFollowTheirNumbers) {
  ProfileResults results = someProfiles();
  EXPECT_TRUE(says(profileFindings(results), "times less than 700 nearest ones"));
  EXPECT_FALSE(says(profileFindings(results), "NOT what is found"));
  EXPECT_TRUE(says(profileFindings(results), "an array saves time"));
  for (ArrayQuality& one : results.linear[0]) one.error_mm = 1.0;
  results.timing.closed = 0.1;
  EXPECT_TRUE(says(profileFindings(results), "no less than 700 nearest ones"));
  EXPECT_TRUE(says(profileFindings(results), "which is NOT what is found"));
  EXPECT_TRUE(says(profileFindings(results), "an array saves no time"));
}

// ---- interpolation

namespace {

InterpolationResults someInterpolations() {
  InterpolationResults results;
  for (std::size_t i = 0; i < kInterpolators.size(); ++i) {
    results.subjects[i] = {.rms_mm = 25.0 - static_cast<double>(i % 4), .predicted = 40};
    results.range_mm[i] = {133.0, 179.0};
  }
  results.scatter_mm = 21.0;
  results.radii = {50.0, 150.0, 400.0};
  results.subject_error_mm = {40.0, 23.0, 22.0};
  results.figure_5_9 = {190.0, 228.0};
  results.measured_mm = {133.0, 179.0};
  results.up_down_mm = 18.0;
  results.up_down_most_mm = 48.0;
  results.expected_up_down_mm = 13.0;
  return results;
}

}  // namespace

TEST(InterpolationVerdicts, ThePrintedRadiusIsADiameterOnlyWhereTheRangeSaysSo) {
  InterpolationResults results = someInterpolations();
  EXPECT_TRUE(says(interpolationFindings(results), "the printed 400 is the diameter"));
  EXPECT_TRUE(says(interpolationFindings(results), "gives 120"));
  results.figure_5_9 = {190.0, 410.0};
  results.furthest_from_key_mm = 2.0;
  EXPECT_FALSE(says(interpolationFindings(results), "the printed 400 is the diameter"));
  EXPECT_TRUE(says(interpolationFindings(results), "does NOT give 120"));
}

TEST(InterpolationVerdicts, PointsAreTooFewOnlyWhileScatterIsLarger) {
  InterpolationResults results = someInterpolations();
  EXPECT_TRUE(says(interpolationFindings(results), "too few to prefer one interpolation"));
  EXPECT_TRUE(says(interpolationFindings(results), "Best here: thin plate"));
  EXPECT_TRUE(says(interpolationFindings(results), "GRI never leaves what was measured"));
  results.scatter_mm = 0.5;
  results.subjects[1].rms_mm = 5.0;
  results.range_mm[1] = {100.0, 179.0};
  EXPECT_FALSE(says(interpolationFindings(results), "too few to prefer"));
  EXPECT_TRUE(says(interpolationFindings(results), "Best here: GRI over 150 mm"));
  EXPECT_TRUE(says(interpolationFindings(results), "GRI leaves what was measured"));
}

TEST(InterpolationVerdicts, WidthAndUpAgainstDownFollowTheirNumbers) {
  InterpolationResults results = someInterpolations();
  EXPECT_TRUE(says(interpolationFindings(results), "The width hardly matters for foretelling"));
  EXPECT_TRUE(says(interpolationFindings(results), "not by so much that eight people could refute it"));
  results.subject_error_mm[2] = 60.0;
  results.up_down_mm = 5.0;
  EXPECT_TRUE(says(interpolationFindings(results), "The width matters for foretelling"));
  EXPECT_TRUE(says(interpolationFindings(results), "no more than chance alone"));
  results.up_down_mm = 50.0;
  EXPECT_TRUE(says(interpolationFindings(results), "so it does not hold"));
}

// ---- directions

namespace {

DirectionResults someDirections() {
  DirectionResults results;
  results.means = {{maps::ForceDirection::up, 5, {121.0, 131.0, 132.0}, 0.46}};
  results.printed_up = {
      .mean_deg = 8.0, .most_deg = 89.0, .share_above_10_deg = 0.22, .most_boundary_mm = 14.0, .mirror_deg = 90.0};
  results.tensor_mirror_deg = 3e-14;
  results.direction = {{0.0, 90.0, 180.0}, {{{64.0, 9.0, 64.0}, {9.0, 9.0, 9.0}, {9.0, 9.0, 9.0}}}};
  results.noise = {{0.0, 0.2}, {{{0.0, 44.0}, {0.0, 32.0}, {0.0, 30.0}}}};
  return results;
}

}  // namespace

TEST(DirectionVerdicts, FollowTheirNumbers) {
  DirectionResults results = someDirections();
  EXPECT_TRUE(
      says(directionFindings(results), "The printed blend breaks the symmetry of the body, the tensors keep it"));
  EXPECT_TRUE(says(directionFindings(results), "so neither number means much"));
  EXPECT_TRUE(says(directionFindings(results), "because half of them are then written as nearly 180"));
  EXPECT_TRUE(says(directionFindings(results), "which helps a little"));
  results.printed_up.mirror_deg = 0.0;
  results.tensor_mirror_deg = 4.0;
  results.means[0].resultant = 0.9;
  results.direction.error_deg[0][0] = 9.5;
  results.noise.error_deg[2][1] = 50.0;
  EXPECT_TRUE(
      says(directionFindings(results), "The printed blend keeps the symmetry of the body, the tensors break it"));
  EXPECT_FALSE(says(directionFindings(results), "so neither number means much"));
  EXPECT_FALSE(says(directionFindings(results), "because half of them"));
  EXPECT_TRUE(says(directionFindings(results), "which does not help"));
  results.noise.error_deg[2][1] = 10.0;
  EXPECT_TRUE(says(directionFindings(results), ", which helps: its error"));
}

}  // namespace palpate::study
