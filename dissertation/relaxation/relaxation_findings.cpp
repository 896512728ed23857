// Verdicts: how near beef comes to what was recorded, whether friction stays, whether any cycle gives energy.
#include "dissertation/relaxation/relaxation_measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/page/study_page.h"

namespace palpate::study {

namespace {

/// Dead beef, held: the share of its force that it loses (docs/explanation/relaxation.md).
struct Recorded {
  double seconds;
  double lost;
};
constexpr std::array kBeef = {Recorded{0.2, 0.12}, Recorded{0.5, 0.22}, Recorded{1.0, 0.30}, Recorded{10.0, 0.54}};

/// People notice a change of force from about here on.
constexpr double kNoticed = 0.07;

std::string heldFinding(const RelaxationMeasurement& found) {
  const RelaxingSkin& offered = found.skins.at(1);
  const double at_last = lostAfter(offered, heldTimes().back());
  return fmt::format(
      "Held at {} mm, the skin as offered pushes with {} N at once and loses {} of it in half a second, {} in one and "
      "{} "
      "in ten: {}.",
      found.depth_mm, rounded(offered.held_n.front()), percent(lostAfter(offered, 0.5)),
      percent(lostAfter(offered, 1.0)), percent(at_last),
      at_last > kNoticed ? "a hand notices that" : "a hand hardly notices that");
}

std::string beefFinding(const RelaxationMeasurement& found) {
  double worst = 0.0;
  std::string losses;
  for (const Recorded& recorded : kBeef) {
    const double lost = lostAfter(found.skins.at(2), recorded.seconds);
    worst = std::max(worst, std::abs(lost - recorded.lost));
    losses += fmt::format("{}{}", losses.empty() ? "" : ", ", percent(lost));
  }
  return fmt::format(
      "Two terms reach dead tissue: after 0.2, 0.5, 1 and 10 s they have lost {}, where recordings of beef have 12, "
      "22, "
      "30 and 54 %: {}.",
      losses, worst < 0.02 ? "within 2 % of the force" : fmt::format("off by up to {}", percent(worst)));
}

std::string cycleFinding(const RelaxationMeasurement& found) {
  const auto less = [](const PressCycle& a, const PressCycle& b) { return a.lost_share < b.lost_share; };
  const auto [least, most] = std::minmax_element(found.cycles.begin(), found.cycles.end(), less);
  return fmt::format(
      "Pressed and let go, the skin as offered costs {} of the work at the pace where it costs most, {} s down and as "
      "long up, and {} at {} s: {}.",
      percent(most->lost_share), rounded(most->stroke_s), percent(least->lost_share), rounded(least->stroke_s),
      least->lost_share >= 0.0 ? "it never gives more than it was given" : "it GIVES energy, which no skin does");
}

std::string frictionFinding(const RelaxationMeasurement& found) {
  double low = 1e9;
  double high = 0.0;
  for (const RelaxingSkin& skin : found.skins) {
    low = std::min(low, skin.friction_low);
    high = std::max(high, skin.friction_high);
  }
  return fmt::format("While the force falls a sliding finger feels a friction ratio of {:.6f} to {:.6f}: {}.", low,
                     high,
                     high - low < 1e-6 ? "Coulomb's law knows nothing of time" : "it should be one number, and is NOT");
}

std::string returnFinding(const RelaxationMeasurement& found) {
  const RelaxingSkin& offered = found.skins.at(1);
  return fmt::format(
      "When the finger leaves after ten seconds, a dent of {} mm stays; after {} s it is {} mm deep. Under a law that "
      "stiffens it is deeper than its share of the force.",
      rounded(offered.dent_mm.front()), rounded(returnTimes().back()), rounded(offered.dent_mm.back()));
}

}  // namespace

double lostAfter(const RelaxingSkin& skin, double seconds) {
  const std::vector<double> times = heldTimes();
  const auto nearest = std::min_element(
      times.begin(), times.end(), [&](double a, double b) { return std::abs(a - seconds) < std::abs(b - seconds); });
  return 1.0 - skin.held_n.at(static_cast<std::size_t>(nearest - times.begin())) / skin.held_n.front();
}

std::vector<std::string> relaxationFindings(const RelaxationMeasurement& found) {
  return {heldFinding(found), cycleFinding(found), returnFinding(found), beefFinding(found), frictionFinding(found)};
}

}  // namespace palpate::study
