#include "teach/study/eye_observer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "palpate/base/random.h"
#include "palpate/training/protocol.h"
#include "palpate/training/stimulus.h"
#include "report/page/plot_parts.h"
#include "teach/study/asked_test.h"

namespace palpate::study {

namespace {

/// The change that twelve presses are compared at, of compliance, and what must be reached.
constexpr double kComparedChange = 0.40;
constexpr double kDPrimeBar = 2.0;
constexpr double kStiffnessBar = 0.60;

double meanOfReadings(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double sampleVariance(const std::vector<double>& values) {
  const double mean = meanOfReadings(values);
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return values.size() < 2 ? 0.0 : squares / static_cast<double>(values.size() - 1);
}

std::vector<double> extractReadings(const std::vector<EyeReading>& presses, double EyeReading::*kind) {
  std::vector<double> values;
  for (const EyeReading& press : presses) values.push_back(press.*kind);
  return values;
}

/// k'/k - 1 of a change of compliance.
double stiffnessShare(double change) {
  return training::stiffnessRatio(std::min(change, training::kMaxComplianceChange),
                                  training::ChangeMeaning::compliance) -
         1.0;
}

/// With fewer places than the test asks about, places are reused by turns.
double normalAt(const std::vector<double>& normal_px, int site) {
  return normal_px[static_cast<std::size_t>(site - 1) % normal_px.size()];
}

}  // namespace

double EyeNoise::of(double length_px) const { return std::hypot(floor_px, share * length_px); }

double computeDPrime(const std::vector<double>& normal, const std::vector<double>& odd, const EyeNoise& noise) {
  const double reader = noise.of(meanOfReadings(normal));
  const double places = 0.5 * (sampleVariance(normal) + sampleVariance(odd));
  return (meanOfReadings(normal) - meanOfReadings(odd)) / std::sqrt(places + reader * reader);
}

training::BlockResult eyeTest(const std::vector<double>& normal_px, const training::BlockSettings& settings,
                              const EyeNoise& noise, std::uint64_t seed) {
  training::Block block(settings, seed);
  Random random(seed ^ 0x9e3779b97f4a7c15ull);
  while (!block.finished()) {
    const training::PlannedTrial trial = block.next();
    int answer = 1;
    double least = 0.0;
    for (int site = 1; site <= settings.choices; ++site) {
      const double drawn = normalAt(normal_px, site) * (site == trial.site ? 1.0 - trial.change : 1.0);
      const double read = drawn + noise.of(drawn) * random.normal();
      if (site > 1 && read >= least) continue;
      answer = site;
      least = read;
    }
    block.answer({.answer = answer, .correct = answer == trial.site, .visited = settings.choices});
  }
  return block.result();
}

EyeMeasurement measureEye(std::uint64_t seed, std::size_t tests, int sites, const Progress& progress) {
  const training::Protocol protocol = training::builtInProtocol();
  EyeMeasurement found{.seed = seed};
  EyePictures pictures(protocol);
  found.sites = readSites(pictures, kComparedChange, sites, progress);
  const std::vector<double> sinks = extractReadings(found.sites.normal, &EyeReading::sink);
  const std::vector<double> odd_sinks = extractReadings(found.sites.stiffer, &EyeReading::sink);
  const std::vector<double> rings = extractReadings(found.sites.normal, &EyeReading::rings);
  const std::vector<double> odd_rings = extractReadings(found.sites.stiffer, &EyeReading::rings);
  found.sink_normal_px = meanOfReadings(sinks);
  found.sink_stiffer_px = meanOfReadings(odd_sinks);
  found.rings_normal_px = meanOfReadings(rings);
  found.rings_stiffer_px = meanOfReadings(odd_rings);
  found.d_prime_sink = computeDPrime(sinks, odd_sinks, found.noise);
  found.d_prime_rings = computeDPrime(rings, odd_rings, found.noise);
  for (std::size_t i = 0; i < sinks.size(); ++i) {
    const double line = sinks[i] * (1.0 - kComparedChange);
    found.off_line_percent = std::max(found.off_line_percent, 100.0 * std::abs(odd_sinks[i] / line - 1.0));
  }
  const training::BlockSettings& settings = protocol.pre_test.block;
  found.first = eyeTest(sinks, settings, found.noise, seed);
  std::vector<double> shares;
  for (std::size_t i = 0; i < tests; ++i) {
    report(progress, "testing the observer", static_cast<double>(i) / static_cast<double>(tests));
    found.medians.push_back(eyeTest(sinks, settings, found.noise, runSeed(seed, 0, i)).threshold.median);
    shares.push_back(stiffnessShare(found.medians.back()));
  }
  std::ranges::sort(shares);
  for (const double part : {0.025, 0.5, 0.975}) {
    found.stiffness_share.push_back(shares[static_cast<std::size_t>(part * static_cast<double>(shares.size() - 1))]);
  }
  return found;
}

bool eyeBarsMet(const EyeMeasurement& found) {
  const training::ThresholdSummary& threshold = found.first.threshold;
  return threshold.isConclusive() && stiffnessShare(threshold.median) <= kStiffnessBar &&
         std::min(found.d_prime_sink, found.d_prime_rings) >= kDPrimeBar;
}

namespace {

TextTable eyeBarTable(const EyeMeasurement& found) {
  const double stiffness = 100.0 * stiffnessShare(found.first.threshold.median);
  const auto row = [](const char* what, std::string bar, std::string reached, bool met) {
    return std::vector<std::string>{what, std::move(bar), std::move(reached), met ? "met" : "missed"};
  };
  TextTable table{{"", "bar", "reached", ""}, {}};
  table.rows.push_back(row("threshold of the simulated eye observer, change of stiffness", "<= 60 %",
                           fmt::format("{:.0f} %", stiffness), stiffness <= 100.0 * kStiffnessBar));
  table.rows.push_back(row("twelve presses, the odd one 40 % less compliant: d' of the sink in the close view", ">= 2",
                           fmt::format("{:.1f}", found.d_prime_sink), found.d_prime_sink >= kDPrimeBar));
  table.rows.push_back(row("the same: d' of the rings in the whole picture", ">= 2",
                           fmt::format("{:.1f}", found.d_prime_rings), found.d_prime_rings >= kDPrimeBar));
  return table;
}

TextTable eyeSiteTable(const EyeMeasurement& found) {
  TextTable table{{"place", "sink, normal (px)", "sink, stiffer (px)", "rings, normal (px)", "rings, stiffer (px)"},
                  {}};
  for (std::size_t i = 0; i < found.sites.normal.size(); ++i) {
    const EyeReading& normal = found.sites.normal[i];
    const EyeReading& stiffer = found.sites.stiffer[i];
    table.rows.push_back({fmt::format("{}", i + 1), fmt::format("{:.1f}", normal.sink),
                          fmt::format("{:.1f}", stiffer.sink), fmt::format("{:.1f}", normal.rings),
                          fmt::format("{:.1f}", stiffer.rings)});
  }
  return table;
}

std::vector<std::string> eyeFindings(const EyeMeasurement& found) {
  const training::ThresholdSummary& t = found.first.threshold;
  const auto share = [](double change) { return 100.0 * stiffnessShare(change); };
  return {
      fmt::format(
          "Simulated, no person took part: an observer who sees only the picture finds a place that is {:.0f} % "
          "stiffer ({:.0f} to {:.0f} %; {:.0f} % of compliance) half of the time among twelve, in a test of {} "
          "answers. That {} the bar of 60 %.",
          share(t.median), share(t.low), share(t.high), 100.0 * t.median, found.first.trials,
          stiffnessShare(t.median) <= kStiffnessBar ? "meets" : "misses"),
      fmt::format("Over {} such tests the threshold is {:.0f} % of stiffness, from {:.0f} to {:.0f} % in 95 of 100.",
                  found.medians.size(), 100.0 * found.stiffness_share[1], 100.0 * found.stiffness_share[0],
                  100.0 * found.stiffness_share[2]),
      fmt::format(
          "A press of {:g} N lowers the drawn finger by {:.1f} px in the close view, and by {:.1f} px where the "
          "place is 40 % less compliant: d' = {:.1f} for the odd one of twelve. The rings in the whole picture "
          "open to {:.1f} and {:.1f} px: d' = {:.1f}.",
          kEyePressN, found.sink_normal_px, found.sink_stiffer_px, found.d_prime_sink, found.rings_normal_px,
          found.rings_stiffer_px, found.d_prime_rings)};
}

std::vector<std::string> eyeMethod(const EyeMeasurement& found) {
  return {
      fmt::format(
          "Each place is pressed by the mouse's finger with {:g} N on the even body of a test and drawn as the "
          "training window of 1280 x 800 draws it beside its column: {} places, once as they are and once with a "
          "hidden place of 40 % of compliance. The sink is how far the lower edge of the finger's blue cuff "
          "moves in the close view between a bare touch and the press; the rings are half the width of what becomes "
          "white in the whole picture. Nothing but pixels is read.",
          kEyePressN, found.sites.normal.size()),
      fmt::format(
          "The observer adds noise to every reading: the root of the sum of squares of {:g} px and {:.0f} % of the "
          "length. That size is assumed: lengths that are seen one after the other are compared about so well. d' "
          "is the difference of the means over the root of the sum of squares of that noise and the spread "
          "between places.",
          found.noise.floor_px, 100.0 * found.noise.share),
      fmt::format(
          "In the test it reads all twelve places and names the one that sinks least; changes other than 40 % are "
          "the normal reading times (1 - change), from which the pictures of 40 % differ by {:.1f} % at most. "
          "Levels and threshold are the product's test (marginal psi, 40 answers).",
          found.off_line_percent)};
}

Figure eyeFigure(const EyeMeasurement& found) {
  Plot plot{.title = "How far the drawn finger sinks"};
  const auto count = static_cast<double>(found.sites.normal.size());
  plot.x = {.label = "place", .from = 0.5, .to = count + 0.5};
  plot.y = {.label = "sink in the close view", .unit = "px", .from = 0.0};
  std::vector<double> place(found.sites.normal.size());
  std::iota(place.begin(), place.end(), 1.0);
  plot.series = {measuredSeries("normal", place, extractReadings(found.sites.normal, &EyeReading::sink)),
                 measuredSeries("40 % less compliant", place, extractReadings(found.sites.stiffer, &EyeReading::sink),
                                Marker::square)};
  return {.panels = {std::move(plot)}, .columns = 1};
}

}  // namespace

StudyPage studyEye(const StudySettings& settings) {
  const std::size_t tests = settings.cases.value_or(settings.quick ? 20 : kEyeTests);
  const EyeMeasurement found = measureEye(settings.seed.value_or(1), tests, settings.quick ? 2 : 12, settings.progress);
  const training::ThresholdSummary& t = found.first.threshold;
  return {
      .name = "training_eye",
      .title = "Training by eye: a simulated observer of the picture",
      .question =
          "With a mouse the hand feels nothing. Does the picture of a press show enough to find the stiffer "
          "place? A simulated observer reads only pixels of the picture.",
      .findings = eyeFindings(found),
      .method = eyeMethod(found),
      .tables = {{"training_eye_bars", "What is asked for and what is reached.", eyeBarTable(found)},
                 {"training_eye_sites", "Readings of every place.", eyeSiteTable(found)}},
      .figures = {{"training_eye_sink", "The sink of every place, read off the picture.", eyeFigure(found)}},
      .numbers = {{"simulated", 1.0},
                  {"threshold_percent", 100.0 * t.median},
                  {"threshold_low_percent", 100.0 * t.low},
                  {"threshold_high_percent", 100.0 * t.high},
                  {"threshold_stiffness_percent", 100.0 * stiffnessShare(t.median)},
                  {"threshold_stiffness_low_percent", 100.0 * stiffnessShare(t.low)},
                  {"threshold_stiffness_high_percent", 100.0 * stiffnessShare(t.high)},
                  {"d_prime_sink", found.d_prime_sink},
                  {"d_prime_rings", found.d_prime_rings},
                  {"sink_normal_px", found.sink_normal_px},
                  {"sink_stiffer_px", found.sink_stiffer_px},
                  {"noise_px", found.noise.of(found.sink_normal_px)},
                  {"bars_met", eyeBarsMet(found) ? 1.0 : 0.0}},
      .numbers_on_top = true,
      .command = fmt::format("palpate study training --observer eye{} --out DIR", settings.quick ? " --quick" : "")};
}

}  // namespace palpate::study
