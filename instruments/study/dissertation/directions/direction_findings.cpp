// Fills in the sentences of direction_findings.txt and the verdicts that the numbers decide.
#include "dissertation/directions/direction_fields.h"

#include <algorithm>

#include "dissertation_findings_texts.h"
#include "palpate/scene/words.h"

namespace palpate::study {

namespace {

// A mirror image that is missed by less is rounding, by more is seen.
constexpr double kRoundingDeg = 1e-6;
constexpr double kSeenDeg = 1.0;
// Agreement of subjects, from 0 to 1, below which their mean says little.
constexpr double kHardlyAgree = 0.5;

const PointMeans& worstMeans(const std::vector<PointMeans>& all) {
  return *std::max_element(all.begin(), all.end(), [](const PointMeans& a, const PointMeans& b) {
    return printedAgainstTensor(a) < printedAgainstTensor(b);
  });
}

FindingValues fieldOfDirections(const DirectionResults& results) {
  const FieldComparison& up = results.printed_up;
  const FieldComparison& down = results.printed_down;
  return {{"mean_deg", up.mean_deg},        {"most_deg", up.most_deg},
          {"share", up.share_above_10_deg}, {"boundary_mm", up.most_boundary_mm},
          {"down_mean_deg", down.mean_deg}, {"down_most_deg", down.most_deg}};
}

FindingValues mirroredDirections(const DirectionResults& results) {
  const double printed = results.printed_up.mirror_deg;
  return {{"breaks", printed > kSeenDeg},
          {"keep", results.tensor_mirror_deg < kRoundingDeg},
          {"printed_deg", printed},
          {"tensor_deg", results.tensor_mirror_deg}};
}

FindingValues worstPoint(const DirectionResults& results) {
  const PointMeans& worst = worstMeans(results.means);
  return {{"point", worst.point},       {"force", wordFor(worst.force)}, {"printed_deg", worst.deg[0]},
          {"tensor_deg", worst.deg[2]}, {"agreement", worst.resultant},  {"hardly", worst.resultant < kHardlyAgree}};
}

FindingValues knownAxes(const DirectionResults& results) {
  const auto& error = results.direction.error_deg;
  const std::size_t middle = results.direction.x.size() / 2;
  return {{"spread_deg", kStudiedSpread},         {"numbers_deg", error[0][middle]},
          {"tensors_deg", error[2][middle]},      {"numbers_at_0_deg", error[0].front()},
          {"tensors_at_0_deg", error[2].front()}, {"seam", error[0].front() > 2.0 * error[2].front()}};
}

FindingValues noisyRadii(const DirectionResults& results) {
  const auto& error = results.noise.error_deg;
  const double tensor = error[2].back();
  const double others = std::min(error[0].back(), error[1].back());
  return {{"noise_percent", 100.0 * results.noise.x.back()},
          {"helps", tensor >= others        ? "no"
                    : tensor > 0.8 * others ? "little"
                                            : "yes"},
          {"tensor_deg", tensor},
          {"double_deg", error[1].back()},
          {"numbers_deg", error[0].back()}};
}

}  // namespace

double printedAgainstTensor(const PointMeans& means) { return axisDifferenceDeg(means.deg[0], means.deg[2]); }

std::vector<std::string> directionFindings(const DirectionResults& results) {
  const auto& [printed, doubled, tensor] = results.flip;
  return formatFindings(texts::direction_findings,
                        {{"field", fieldOfDirections(results)},
                         {"mirror", mirroredDirections(results)},
                         {"flip", {{"printed_deg", printed}, {"double_deg", doubled}, {"tensor_deg", tensor}}},
                         {"point", worstPoint(results)},
                         {"known", knownAxes(results)},
                         {"noise", noisyRadii(results)}});
}

}  // namespace palpate::study
