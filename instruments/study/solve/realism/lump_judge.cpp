// The pattern of rings is built from the same forms as the taxels of a fingertip (tissue/pressure_form.h).
#include "solve/realism/lump_judge.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>

#include "palpate/base/error.h"
#include "palpate/elements/press_solver.h"
#include "palpate/tissue/pressure_form.h"

namespace palpate::lab {

namespace {

constexpr double kLeastDepthMm = 2.0;
constexpr double kSmallMm = 12.0;    // diameter
constexpr double kLargestMm = 14.0;  // whose extra force is compared
constexpr double kShallowMm = 3.5;   // depth of the top
constexpr double kMnPerN = 1e3;

double lumpDiameter(const tissue::LumpShape& lump) { return 2.0 * lump.half_axes_mm[0]; }

/// A stack as the product knows it.
struct KnownStack {
  tissue::LayerStack stack;
  tissue::PressField field;

  tissue::WeightedField whole() const { return {&stack, &field, 1.0}; }
};

KnownStack solvedStack(const tissue::LayerStack& stack) {
  constexpr double kDeepestMm = 10.0;
  constexpr double kShare = 0.6;  // share of the thickness
  elements::PressSettings settings;
  settings.field_depths_mm = elements::fieldDepths(std::min(kDeepestMm, kShare * tissue::totalThickness(stack)));
  settings.depths_mm = {settings.field_depths_mm.back()};
  const elements::PressSolution solution = elements::solvePress(stack, settings);
  if (!solution.table.field) throw Error("cannot solve a press on a stack: " + solution.stopped_by);
  return {stack, *solution.table.field};
}

/// Pressure of rings of 1 mm: the product's over a lump, and only scaled to the force.
struct Rings {
  std::vector<double> with_bump;
  std::vector<double> scaled;
};

double areaOf(std::size_t ring) { return std::numbers::pi * (2.0 * static_cast<double>(ring) + 1.0); }

Rings ringsOver(const tissue::LumpShape& lump, double skin_mm, const tissue::PressurePattern& without,
                const LumpPress& press, double extra_n) {
  constexpr std::size_t kLooks = 40;  // per ring
  const double widening = tissue::wideningOf(lump, skin_mm) * extra_n / press.force_without_n;
  const tissue::PressurePattern pattern = tissue::overLumps(without, widening);
  const double width = tissue::bumpWidth(lump, skin_mm, press.depth_mm);
  const double base = tissue::bumpBase(pattern, 0.0, width);
  Rings rings;
  std::vector<double> widened, bump;
  double bump_mn = 0.0;
  for (std::size_t ring = 0; ring < press.pressure_kpa.size(); ++ring) {
    double plain = 0.0, wide = 0.0, extra = 0.0;
    for (std::size_t i = 0; i < kLooks; ++i) {
      const double radius = static_cast<double>(ring) + (static_cast<double>(i) + 0.5) / kLooks;
      const double weight = 2.0 * std::numbers::pi * radius / kLooks / areaOf(ring);
      const double here = weight * tissue::pressureAt(pattern, press.force_without_n, radius);
      plain += weight * tissue::pressureAt(without, press.force_without_n, radius);
      wide += here;
      extra += here * (tissue::bumpAt(radius, width) - base);
    }
    rings.scaled.push_back(plain);
    widened.push_back(wide);
    bump.push_back(extra);
    bump_mn += extra * areaOf(ring);
  }
  const double height = bump_mn != 0.0 ? kMnPerN * extra_n / bump_mn : 0.0;
  for (std::size_t ring = 0; ring < bump.size(); ++ring)
    rings.with_bump.push_back(std::max(0.0, widened[ring] + height * bump[ring]));
  for (std::vector<double>* pressures : {&rings.with_bump, &rings.scaled}) {
    double sum = 0.0;
    for (std::size_t ring = 0; ring < bump.size(); ++ring) sum += (*pressures)[ring] * areaOf(ring);
    for (double& pressure : *pressures) pressure *= kMnPerN * (press.force_without_n + extra_n) / sum;
  }
  return rings;
}

/// % of the truth's peak, over the rings that touch, by their area.
double rmsPercent(const std::vector<double>& rings, const LumpPress& press) {
  double squares = 0.0;
  double area = 0.0;
  for (std::size_t ring = 0; ring < rings.size() && static_cast<double>(ring) < press.contact_radius_mm; ++ring) {
    const double off = rings[ring] - press.pressure_kpa[ring];
    squares += areaOf(ring) * off * off;
    area += areaOf(ring);
  }
  return 100.0 * std::sqrt(squares / area) / *std::ranges::max_element(press.pressure_kpa);
}

/// RMS over the area, % of the depth.
double surfacePercent(const std::vector<double>& radii, const std::vector<double>& change) {
  double squares = 0.0;
  for (std::size_t i = 1; i < change.size(); ++i) {
    squares +=
        (radii[i] - radii[i - 1]) * (radii[i] * change[i] * change[i] + radii[i - 1] * change[i - 1] * change[i - 1]);
  }
  return 100.0 * std::sqrt(squares) / radii.back();
}

/// Values gathered over all cases.
struct Gathered {
  std::vector<double> force, force_small, pressure, pressure_small, surface_small, surface_large;
  std::vector<double> shallow, shallow_scaled;
};

LumpFindings::One judgeCase(const LumpCase& one, const KnownStack& known, const std::vector<double>& surface_radii,
                            LumpFindings& findings, Gathered& all) {
  const tissue::WeightedField whole = known.whole();
  const tissue::LumpEnergy energy(one.lump, known.stack, std::span(&whole, 1));
  const tissue::PressureForm form(std::span(&whole, 1));
  const bool small = lumpDiameter(one.lump) <= kSmallMm;
  LumpFindings::One worst{.name = one.name};
  for (const LumpPress& press : one.presses) {
    if (press.depth_mm < kLeastDepthMm) continue;
    const double extra = energy.at(0.0, press.depth_mm).d_depth;
    const double truth = press.force_n - press.force_without_n;
    worst.force_percent = std::max(worst.force_percent, 100.0 * std::abs(extra - truth) / press.force_n);
    if (lumpDiameter(one.lump) <= kLargestMm && std::abs(truth) > 0.02 * press.force_without_n)
      findings.extra_ratios.push_back(extra / truth);
    if (!press.pressure_kpa.empty()) {
      const Rings rings =
          ringsOver(one.lump, known.stack.layers.front().thickness_mm, form.at(press.depth_mm), press, extra);
      const double pressure = rmsPercent(rings.with_bump, press);
      worst.pressure_percent = std::max(worst.pressure_percent, pressure);
      all.pressure.push_back(pressure);
      if (small) all.pressure_small.push_back(pressure);
      if (one.lump.depth_mm <= kShallowMm) {
        all.shallow.push_back(pressure);
        all.shallow_scaled.push_back(rmsPercent(rings.scaled, press));
      }
    }
    if (press.surface_change_share.empty()) continue;
    const double surface = surfacePercent(surface_radii, press.surface_change_share);
    worst.surface_percent = std::max(worst.surface_percent, surface);
    (small ? all.surface_small : all.surface_large).push_back(surface);
  }
  all.force.push_back(worst.force_percent);
  if (small) all.force_small.push_back(worst.force_percent);
  return worst;
}

/// Energy of a ball of 1 mm by the field of the table, mm^3 per kPa of mu; lambda over mu is that of the stack.
double ballEnergy(const KnownStack& known, const FieldEntry& entry, std::size_t press) {
  constexpr int kAlong = 16;
  const double nu = known.stack.poisson;
  double sum = 0.0;
  int inside = 0;
  const auto at = [](int i) { return (2.0 * i + 1.0) / kAlong - 1.0; };
  for (int i = 0; i < kAlong; ++i) {
    const tissue::FieldRow row = tissue::rowAt(known.field, entry.centre_mm + at(i));
    for (int j = 0; j < kAlong; ++j) {
      for (int k = 0; k < kAlong; ++k) {
        if (at(i) * at(i) + at(j) * at(j) + at(k) * at(k) > 1.0) continue;
        const double radius = std::hypot(entry.at_mm + at(j), at(k));
        const auto density = tissue::densityAt(known.field, tissue::placeAt(known.field, row, radius), press);
        sum += density.shear + 2.0 * nu / (1.0 - 2.0 * nu) * density.volume;
        ++inside;
      }
    }
  }
  return 4.0 / 3.0 * std::numbers::pi * sum / inside;
}

Spread judgeField(const LumpCases& cases, const std::vector<KnownStack>& known) {
  std::vector<double> errors;
  for (const FieldEntry& entry : cases.field) {
    const KnownStack& stack = known[entry.stack];
    const auto& depths = stack.field.depths_mm;
    const auto press = std::ranges::find(depths, entry.depth_mm);
    if (press == depths.end()) continue;
    const double nu = stack.stack.poisson;
    const double truth = entry.shear_mm3 + 2.0 * nu / (1.0 - 2.0 * nu) * entry.volume_mm3;
    const double model = ballEnergy(stack, entry, static_cast<std::size_t>(press - depths.begin()));
    errors.push_back(100.0 * std::abs(model / truth - 1.0));
  }
  return computeSpread(std::move(errors));
}

/// The same mesh and lump with the tip over its middle.
const BesideCase* onAxis(const LumpCases& cases, const BesideCase& beside) {
  const auto found = std::ranges::find_if(cases.beside, [&](const BesideCase& other) {
    return other.at_mm == 0.0 &&
           other.name.starts_with(beside.name.substr(0, beside.name.find_last_not_of("0123456789") + 1));
  });
  return found == cases.beside.end() ? nullptr : &*found;
}

void judgeBeside(const LumpCases& cases, const std::vector<KnownStack>& known, LumpFindings& findings) {
  for (const BesideCase& beside : cases.beside) {
    const BesideCase* axis = onAxis(cases, beside);
    if (beside.at_mm == 0.0 || axis == nullptr) continue;
    const tissue::WeightedField whole = known[beside.stack].whole();
    const tissue::LumpEnergy energy(beside.lump, known[beside.stack].stack, std::span(&whole, 1));
    LumpFindings::Beside& worst = findings.beside.emplace_back();
    worst.name = beside.name;
    worst.at_mm = beside.at_mm;
    const std::size_t count = std::min(beside.presses.size(), axis->presses.size());
    for (std::size_t i = 0; i < count; ++i) {
      const BesidePress& press = beside.presses[i];
      const auto depth = static_cast<std::size_t>(std::lround(press.depth_mm));
      if (depth < 1 || depth > cases.forces_n[beside.stack].size()) continue;
      const double plain_n = cases.forces_n[beside.stack][depth - 1];
      const tissue::LumpAnswer here = energy.at(beside.at_mm, press.depth_mm);
      const double middle_n = energy.at(0.0, press.depth_mm).d_depth;
      // Excess stiffness of the coarse mesh, as the axis shows.
      const double bias = axis->presses[i].extra_share / (middle_n / plain_n);
      worst.lateral = std::max(worst.lateral, std::abs(press.lateral_share / bias + here.d_rho / plain_n));
      constexpr double kLeastForRatio = 3.0;
      if (press.depth_mm < kLeastForRatio) continue;
      const double truth = press.extra_share / axis->presses[i].extra_share;
      worst.ratio_percent = std::max(worst.ratio_percent, 100.0 * std::abs(here.d_depth / middle_n / truth - 1.0));
    }
  }
}

double meanValue(const std::vector<double>& values) {
  return values.empty() ? 0.0 : std::reduce(values.begin(), values.end()) / static_cast<double>(values.size());
}

}  // namespace

Spread computeSpread(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  const auto at = [&](double share) {
    const double rank = std::ceil(share * static_cast<double>(values.size()) - 1e-9);
    return values[static_cast<std::size_t>(std::max(1.0, rank)) - 1];
  };
  return {meanValue(values), at(0.9), at(0.95), values.back(), values.size()};
}

LumpFindings judgeLumps(const LumpCases& cases, const Progress& progress) {
  std::vector<KnownStack> known;
  for (const tissue::LayerStack& stack : cases.stacks) {
    report(progress, "solving the stacks",
           static_cast<double>(known.size()) / static_cast<double>(cases.stacks.size()));
    known.push_back(solvedStack(stack));
  }
  LumpFindings findings;
  Gathered all;
  for (const LumpCase& one : cases.cases)
    findings.cases.push_back(judgeCase(one, known[one.stack], cases.surface_radii_mm, findings, all));
  findings.force = computeSpread(std::move(all.force));
  findings.force_small = computeSpread(std::move(all.force_small));
  findings.pressure = computeSpread(std::move(all.pressure));
  findings.pressure_small = computeSpread(std::move(all.pressure_small));
  findings.surface_small = computeSpread(std::move(all.surface_small));
  findings.surface_large = computeSpread(std::move(all.surface_large));
  if (!all.shallow.empty()) findings.pressure_gain = meanValue(all.shallow) / meanValue(all.shallow_scaled);
  findings.field = judgeField(cases, known);
  judgeBeside(cases, known, findings);
  return findings;
}

}  // namespace palpate::lab
