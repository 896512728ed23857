// Each verdict is decided by the numbers that stand beside it; where they do not decide, none is given.
#include "dissertation/directions/direction_fields.h"

#include <fmt/format.h>

#include <algorithm>

#include "palpate/scene/words.h"
#include "report/page/study_page.h"

namespace palpate::study {

namespace {

// A mirror image that is missed by less is rounding, by more is seen.
constexpr double kRoundingDeg = 1e-6;
constexpr double kSeenDeg = 1.0;
// Agreement of subjects, from 0 to 1, below which their mean says little.
constexpr double kHardlyAgree = 0.5;

const PointMeans& worstOf(const std::vector<PointMeans>& all) {
  return *std::max_element(all.begin(), all.end(), [](const PointMeans& a, const PointMeans& b) {
    return printedAgainstTensor(a) < printedAgainstTensor(b);
  });
}

std::string fieldFinding(const DirectionResults& results) {
  const FieldComparison& up = results.printed_up;
  const FieldComparison& down = results.printed_down;
  return fmt::format(
      "Over the back the printed blend points elsewhere than the tensors by {:.0f} degree on average and by up to "
      "{:.0f} "
      "degree; on {} of the back by more than 10. The boundary of the deformed region moves by up to {:.0f} mm with "
      "it. "
      "Dragged down: {:.0f} on average, up to {:.0f} degree.",
      up.mean_deg, up.most_deg, percent(up.share_above_10_deg), up.most_boundary_mm, down.mean_deg, down.most_deg);
}

std::string mirrorFinding(const DirectionResults& results) {
  const double printed = results.printed_up.mirror_deg;
  const bool breaks = printed > kSeenDeg;
  const bool keeps = results.tensor_mirror_deg < kRoundingDeg;
  return fmt::format(
      "The printed blend {} the symmetry of the body, the tensors {} it: left and right are mirror images in the data, "
      "and "
      "its directions miss the mirror image by up to {:.0f} degree, the tensors' by {:.1g}.",
      breaks ? "breaks" : "keeps", keeps ? "keep" : "break", printed, results.tensor_mirror_deg);
}

std::string flipFinding(const DirectionResults& results) {
  return fmt::format(
      "An axis at 180 degree is one at 0. If a single subject's 180 at P3 had been written as 0, the printed mean "
      "would "
      "turn by {:.0f} degree, the double angle's and the tensor's by {:.0f} and {:.0f}.",
      results.flip[0], results.flip[1], results.flip[2]);
}

std::string pointFinding(const DirectionResults& results) {
  const PointMeans& worst = worstOf(results.means);
  return fmt::format(
      "Means of the subjects differ most at P{} ({}): {:.1f} degree as printed, {:.1f} as a tensor. There the subjects "
      "agree by {:.2f} of 1{}.",
      worst.point, wordFor(worst.force), worst.deg[0], worst.deg[2], worst.resultant,
      worst.resultant < kHardlyAgree ? " only, so neither number means much" : "");
}

std::string knownFinding(const DirectionResults& results) {
  const auto& error = results.direction.error_deg;
  const std::size_t middle = results.direction.x.size() / 2;
  const bool seam = error[0].front() > 2.0 * error[2].front();
  return fmt::format(
      "With axes whose truth is known: five of them that spread by {:.0f} degree around 90 give an error of {:.0f} "
      "degree "
      "as numbers and {:.0f} as tensors; around 0 it is {:.0f} against {:.0f}{}.",
      kStudiedSpread, error[0][middle], error[2][middle], error[0].front(), error[2].front(),
      seam ? ", because half of them are then written as nearly 180" : "");
}

std::string noiseFinding(const DirectionResults& results) {
  const auto& error = results.noise.error_deg;
  const double tensor = error[2].back();
  const double others = std::min(error[0].back(), error[1].back());
  const std::string verdict = tensor >= others        ? "which does not help"
                              : tensor > 0.8 * others ? "which helps a little"
                                                      : "which helps";
  return fmt::format(
      "Where the radii themselves are measured badly (by {:.0f} %), ellipses that come out nearly round point "
      "anywhere. The "
      "tensor gives them less of a voice, {}: its error is {:.0f} degree, that of the double angle {:.0f}, that of the "
      "numbers {:.0f}.",
      100.0 * results.noise.x.back(), verdict, tensor, error[1].back(), error[0].back());
}

}  // namespace

double printedAgainstTensor(const PointMeans& means) { return axisDifferenceDeg(means.deg[0], means.deg[2]); }

std::vector<std::string> directionFindings(const DirectionResults& results) {
  return {fieldFinding(results), mirrorFinding(results), flipFinding(results),
          pointFinding(results), knownFinding(results),  noiseFinding(results)};
}

}  // namespace palpate::study
