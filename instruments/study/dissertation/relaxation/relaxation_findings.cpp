// Fills in the sentences of relaxation_findings.txt and the verdicts that the numbers decide.
#include "dissertation/relaxation/relaxation_measurement.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dissertation_findings_texts.h"

namespace palpate::study {

namespace {

/// Dead beef, held: the share of its force that it loses (docs/explanation/force-laws.md).
struct Recorded {
  double seconds;
  double lost;
};
constexpr std::array kBeef = {Recorded{0.2, 0.12}, Recorded{0.5, 0.22}, Recorded{1.0, 0.30}, Recorded{10.0, 0.54}};

/// People notice a change of force from about here on.
constexpr double kNoticed = 0.07;

FindingValues heldSkin(const RelaxationMeasurement& found) {
  const RelaxingSkin& offered = found.skins.at(1);
  const double at_last = lostForceShare(offered, heldTimes().back());
  return {{"depth_mm", found.depth_mm},
          {"at_once_n", offered.held_n.front()},
          {"half", lostForceShare(offered, 0.5)},
          {"one", lostForceShare(offered, 1.0)},
          {"ten", at_last},
          {"noticed", at_last > kNoticed}};
}

FindingValues beefLossValues(const RelaxationMeasurement& found) {
  double worst = 0.0;
  std::vector<double> losses;
  for (const BeefLoss& loss : beefLosses(found)) {
    losses.push_back(loss.lost);
    worst = std::max(worst, std::abs(loss.lost - loss.recorded));
  }
  return {{"lost", losses}, {"near", worst < kBeefBar}, {"worst", worst}};
}

FindingValues pressCycleValues(const RelaxationMeasurement& found) {
  const auto less = [](const PressCycle& a, const PressCycle& b) { return a.lost_share < b.lost_share; };
  const auto [least, most] = std::minmax_element(found.cycles.begin(), found.cycles.end(), less);
  return {{"most", most->lost_share},
          {"most_s", most->stroke_s},
          {"least", least->lost_share},
          {"least_s", least->stroke_s},
          {"never_gives", least->lost_share >= 0.0}};
}

FindingValues frictionOverTime(const RelaxationMeasurement& found) {
  double low = 1e9;
  double high = 0.0;
  for (const RelaxingSkin& skin : found.skins) {
    low = std::min(low, skin.friction_low);
    high = std::max(high, skin.friction_high);
  }
  return {{"ratio", {low, high}}, {"one", high - low < 1e-6}};
}

}  // namespace

double lostForceShare(const RelaxingSkin& skin, double seconds) {
  const std::vector<double> times = heldTimes();
  const auto nearest = std::min_element(
      times.begin(), times.end(), [&](double a, double b) { return std::abs(a - seconds) < std::abs(b - seconds); });
  return 1.0 - skin.held_n.at(static_cast<std::size_t>(nearest - times.begin())) / skin.held_n.front();
}

std::vector<BeefLoss> beefLosses(const RelaxationMeasurement& found) {
  std::vector<BeefLoss> losses;
  for (const Recorded& recorded : kBeef) {
    losses.push_back({recorded.seconds, recorded.lost, lostForceShare(found.skins.at(2), recorded.seconds)});
  }
  return losses;
}

std::vector<std::string> relaxationFindings(const RelaxationMeasurement& found) {
  const std::vector<double>& dent = found.skins.at(1).dent_mm;
  return formatFindings(
      texts::relaxation_findings,
      {{"held", heldSkin(found)},
       {"cycle", pressCycleValues(found)},
       {"return", {{"dent_mm", dent.front()}, {"last_s", returnTimes().back()}, {"last_dent_mm", dent.back()}}},
       {"beef", beefLossValues(found)},
       {"friction", frictionOverTime(found)}});
}

}  // namespace palpate::study
