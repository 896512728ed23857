// Fills in the sentences of profile_findings.txt and the verdicts that the numbers decide.
#include "dissertation/profile/array_quality.h"

#include <algorithm>
#include <cmath>

#include "dissertation_findings_texts.h"

namespace palpate::study {

namespace {

// An order of convergence as near as this to the theory's agrees with it.
constexpr double kSameOrder = 0.1;

/// The smallest of the sizes whose turn stays invisible; 0 where none does.
FindingValues smallestSize(const ArraySweep& all) {
  const auto found =
      std::find_if(all.begin(), all.end(), [](const ArrayQuality& one) { return one.turn_deg < kVisibleTurnDeg; });
  return {{"entries", found == all.end() ? 0 : found->entries}, {"most", kArraySizes.back()}};
}

/// Right and wrong parts of "20 is significantly different, 130 not obviously, 700 slightly better".
FindingValues placeErrorsByArraySize(const ProfileResults& results) {
  const auto error = [&](int entries) { return ofSize(results.nearest[0], entries).error_mm; };
  FindingValues right = FindingValues::array();
  FindingValues wrong = FindingValues::array();
  const auto judge = [&](const char* claim, bool holds) { (holds ? right : wrong).push_back({{"claim", claim}}); };
  judge("seen", error(20) > kPixelMm);
  judge("alike", std::abs(error(130) - error(700)) < kPixelMm);
  judge("enough", error(700) < kPixelMm);
  return {{"error_20", error(20)}, {"error_130", error(130)}, {"error_700", error(700)},
          {"pixel_mm", kPixelMm},  {"right", right},          {"wrong", wrong}};
}

FindingValues shadingByArraySize(const ProfileResults& results) {
  const auto turn = [&](std::size_t spacing, int entries) {
    return ofSize(results.nearest[spacing], entries).turn_deg;
  };
  const bool coarse = turn(0, 700) < kVisibleTurnDeg;
  const bool fine = turn(1, 700) < kVisibleTurnDeg;
  return {{"coarse_mm", kPrintedSpacing},
          {"coarse_20", turn(0, 20)},
          {"coarse_130", turn(0, 130)},
          {"coarse_700", turn(0, 700)},
          {"fine_mm", kVertexSpacings[1]},
          {"fine_20", turn(1, 20)},
          {"fine_130", turn(1, 130)},
          {"fine_700", turn(1, 700)},
          {"visible_deg", kVisibleTurnDeg},
          {"suffice", coarse && fine ? "both" : coarse ? "coarse" : fine ? "fine" : "neither"}};
}

FindingValues linearArrays(const ProfileResults& results) {
  const double linear_130 = ofSize(results.linear[0], 130).error_mm;
  const double nearest_700 = ofSize(results.nearest[0], 700).error_mm;
  return {{"linear_130", linear_130},
          {"better", linear_130 < nearest_700},
          {"times", nearest_700 / linear_130},
          {"coarse", smallestSize(results.linear[0])},
          {"coarse_mm", kVertexSpacings[0]},
          {"fine", smallestSize(results.linear[1])},
          {"fine_mm", kVertexSpacings[1]},
          {"finest", smallestSize(results.linear[2])},
          {"finest_mm", kVertexSpacings[2]},
          {"nearest_coarse", smallestSize(results.nearest[0])},
          {"nearest_fine", smallestSize(results.nearest[1])},
          {"nearest_finest", smallestSize(results.nearest[2])}};
}

FindingValues orderOfArrays(const ProfileResults& results) {
  const double nearest = -convergenceSlope(results.nearest[0]);
  const double linear = -convergenceSlope(results.linear[0]);
  const bool agrees = std::abs(nearest - 1.0) < kSameOrder && std::abs(linear - 2.0) < kSameOrder;
  return {{"nearest", nearest}, {"linear", linear}, {"differs", !agrees}};
}

FindingValues timesOfArrays(const LookupTimes& timing) {
  const double lookup = timing.nearest[indexOf(700)];
  return {{"nearest", lookup},
          {"linear", timing.linear[indexOf(700)]},
          {"closed", timing.closed},
          {"saves", lookup < timing.closed}};
}

}  // namespace

const ArrayQuality& ofSize(const ArraySweep& all, int entries) {
  return *std::find_if(all.begin(), all.end(), [=](const ArrayQuality& one) { return one.entries == entries; });
}

std::size_t indexOf(int entries) {
  return static_cast<std::size_t>(std::find(kArraySizes.begin(), kArraySizes.end(), entries) - kArraySizes.begin());
}

std::vector<std::string> profileFindings(const ProfileResults& results) {
  return formatFindings(texts::profile_findings, {{"place", placeErrorsByArraySize(results)},
                                                  {"shading", shadingByArraySize(results)},
                                                  {"linear", linearArrays(results)},
                                                  {"order", orderOfArrays(results)},
                                                  {"time", timesOfArrays(results.timing)}});
}

}  // namespace palpate::study
