// Each verdict is decided by the numbers that stand beside it; where they do not decide, none is given.
#include "dissertation/profile/array_quality.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "report/page/study_page.h"

namespace palpate::study {

namespace {

// An order of convergence as near as this to the theory's agrees with it.
constexpr double kSameOrder = 0.1;

// The smallest of the sizes whose turn stays invisible; 0 where none does.
int smallestSmooth(const ArraySweep& all) {
  const auto found =
      std::find_if(all.begin(), all.end(), [](const ArrayQuality& one) { return one.turn_deg < kVisibleTurnDeg; });
  return found == all.end() ? 0 : found->entries;
}

std::string smallestText(const ArraySweep& all) {
  const int entries = smallestSmooth(all);
  return entries == 0 ? fmt::format("more than {}", kArraySizes.back()) : fmt::format("{}", entries);
}

/// What is right and what is not of "20 is significantly different, 130 not obviously, 700 slightly better".
std::string eyeVerdict(double error_20, double error_130, double error_700) {
  std::vector<std::string> right;
  std::vector<std::string> wrong;
  (error_20 > kPixelMm ? right : wrong).emplace_back("that 20 is seen");
  (std::abs(error_130 - error_700) < kPixelMm ? right : wrong).emplace_back("that 130 is hardly told from 700");
  (error_700 < kPixelMm ? right : wrong).emplace_back("that more than 700 is not needed for the place of the skin");
  std::string verdict = right.empty() ? "" : fmt::format("the text is right {}", fmt::join(right, ", "));
  if (!wrong.empty()) {
    verdict += fmt::format("{}it is not right {}", right.empty() ? "" : "; ", fmt::join(wrong, ", "));
  }
  return verdict;
}

std::string placeFinding(const ProfileResults& results) {
  const auto error = [&](int entries) { return ofSize(results.nearest[0], entries).error_mm; };
  return fmt::format(
      "Arrays of 20, 130 and 700 entries, read at the nearest entry as in (4.3), are off by up to {}, {} and {} mm at "
      "10 "
      "mm depth. A pixel of a life-size view is {} mm: {}.",
      rounded(error(20)), rounded(error(130)), rounded(error(700)), kPixelMm,
      eyeVerdict(error(20), error(130), error(700)));
}

std::string shadingVerdict(double turn_of_2008, double turn_of_1_mm) {
  const bool then = turn_of_2008 < kVisibleTurnDeg;
  const bool now = turn_of_1_mm < kVisibleTurnDeg;
  if (then && !now) return "700 entries suffice for the mesh of 2008 and not for one of 1 mm";
  if (then) return "700 entries suffice for both";
  return now ? "700 entries suffice for the finer mesh only" : "700 entries suffice for neither";
}

std::string shadingFinding(const ProfileResults& results) {
  const auto turn = [&](std::size_t spacing, int entries) {
    return ofSize(results.nearest[spacing], entries).turn_deg;
  };
  return fmt::format(
      "The shading asks for more than the place. With vertices {} mm apart, as on the dissertation's back, the array "
      "adds "
      "turns of the normal of {}, {} and {} degree; on a mesh of {} mm they are {}, {} and {} degree. From about {} "
      "degree "
      "on a turn is seen: {}.",
      kPrintedSpacing, rounded(turn(0, 20)), rounded(turn(0, 130)), rounded(turn(0, 700)), kVertexSpacings[1],
      rounded(turn(1, 20)), rounded(turn(1, 130)), rounded(turn(1, 700)), kVisibleTurnDeg,
      shadingVerdict(turn(0, 700), turn(1, 700)));
}

std::string linearFinding(const ProfileResults& results) {
  const double linear_130 = ofSize(results.linear[0], 130).error_mm;
  const double nearest_700 = ofSize(results.nearest[0], 700).error_mm;
  const std::string against =
      linear_130 < nearest_700 ? fmt::format("{} times less than 700 nearest ones", rounded(nearest_700 / linear_130))
                               : "no less than 700 nearest ones";
  return fmt::format(
      "Read between two entries, 130 entries are off by {} mm, {}. The turn stays invisible from {} (mesh of {} mm), "
      "{} "
      "({} mm) and {} entries on ({} mm); with the nearest entry it takes {}, {} and {}.",
      rounded(linear_130), against, smallestText(results.linear[0]), kVertexSpacings[0],
      smallestText(results.linear[1]), kVertexSpacings[1], smallestText(results.linear[2]), kVertexSpacings[2],
      smallestText(results.nearest[0]), smallestText(results.nearest[1]), smallestText(results.nearest[2]));
}

std::string orderFinding(const ProfileResults& results) {
  const double nearest = -orderOf(results.nearest[0]);
  const double linear = -orderOf(results.linear[0]);
  const bool agrees = std::abs(nearest - 1.0) < kSameOrder && std::abs(linear - 2.0) < kSameOrder;
  return fmt::format(
      "The error falls with the size to the power {:.2f} for the nearest entry and {:.2f} between entries; "
      "theory has 1 and 2{}.",
      nearest, linear, agrees ? "" : ", which is NOT what is found");
}

std::string timeFinding(const ProfileResults& results) {
  const LookupTimes& timing = results.timing;
  const double lookup = timing.nearest[indexOf(700)];
  return fmt::format(
      "A look-up among 700 takes {:.1f} ns nearest and {:.1f} ns linear, the exponential itself {:.1f} ns: {}. "
      "The engine's kernels take the exponential, for several vertices at once.",
      lookup, timing.linear[indexOf(700)], timing.closed,
      lookup < timing.closed ? "an array saves time for a single vertex" : "an array saves no time");
}

}  // namespace

const ArrayQuality& ofSize(const ArraySweep& all, int entries) {
  return *std::find_if(all.begin(), all.end(), [=](const ArrayQuality& one) { return one.entries == entries; });
}

std::size_t indexOf(int entries) {
  return static_cast<std::size_t>(std::find(kArraySizes.begin(), kArraySizes.end(), entries) - kArraySizes.begin());
}

std::vector<std::string> profileFindings(const ProfileResults& results) {
  return {placeFinding(results), shadingFinding(results), linearFinding(results), orderFinding(results),
          timeFinding(results)};
}

}  // namespace palpate::study
