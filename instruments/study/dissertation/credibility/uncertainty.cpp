// The spread of the felt force for the spread of the inputs: drawn places of a body, each pressed by the product's own
// finger; moduli through the solver.
#include "dissertation/credibility/credibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "dissertation/credibility/checked_stack.h"
#include "palpate/base/random.h"
#include "palpate/elements/press_solver.h"
#include "palpate/tissue/published.h"
#include "solve/realism/realism_stacks.h"

namespace palpate::study {

namespace {

/// A value between low and high, drawn evenly, of its logarithm where `log_scale`.
struct Input {
  std::string name;
  std::string unit;
  double low = 0.0;
  double usual = 0.0;
  double high = 0.0;
  bool log_scale = false;

  double at(double share) const { return log_scale ? low * std::pow(high / low, share) : low + share * (high - low); }
};

enum InputIndex : std::size_t { kThickness, kFat, kFingerRadius, kSkinModulus, kFatModulus, kMuscleModulus, kInputs };

/// The least and the most that is published of a tissue, kPa.
Input publishedInput(const std::string& name, std::string_view of) {
  Input input{.name = name,
              .unit = "kPa",
              .low = std::numeric_limits<double>::infinity(),
              .usual = tissue::defaultModulus(of),
              .high = 0.0,
              .log_scale = true};
  for (const tissue::PublishedModulus& modulus : tissue::publishedModuli()) {
    if (modulus.tissue != of) continue;
    input.low = std::min(input.low, modulus.low_kpa);
    input.high = std::max(input.high, modulus.high_kpa);
  }
  return input;
}

/// Fat and thickness over the range of the places in `palpate tissue realism`.
std::vector<Input> uncertainInputs() {
  Input thickness{.name = "thickness", .unit = "mm", .low = 1e9, .usual = kCheckedThicknessMm, .high = 0.0};
  Input fat{.name = "fat", .unit = "mm", .low = 1e9, .usual = kCheckedFatMm, .high = 0.0};
  for (const lab::JudgedPlace& place : lab::placesOfBody()) {
    thickness.low = std::min(thickness.low, place.thickness_mm);
    thickness.high = std::max(thickness.high, place.thickness_mm);
    fat.low = std::min(fat.low, place.fat_mm);
    fat.high = std::max(fat.high, place.fat_mm);
  }
  return {thickness,
          fat,
          {.name = "finger_radius", .unit = "mm", .low = 6.0, .usual = kCheckedRadiusMm, .high = 10.0},
          publishedInput("skin_modulus", "skin"),
          publishedInput("fat_modulus", "fat"),
          publishedInput("muscle_modulus", "muscle")};
}

/// The solved force next to the spine with one modulus changed, over that without; 1 at the usual modulus. Straight
/// between the three in logarithms.
struct ModulusEffect {
  double low = 1.0;
  double high = 1.0;

  double at(const Input& input, double modulus) const {
    const double end = modulus < input.usual ? low : high;
    const double to = modulus < input.usual ? input.low : input.high;
    return to == input.usual ? 1.0 : std::pow(end, std::log(modulus / input.usual) / std::log(to / input.usual));
  }
};

/// Nothing where tissue gives way before that depth.
std::optional<double> solvedForceWith(std::size_t layer, double young_kpa) {
  tissue::LayerStack stack = checkedStack();
  stack.layers.at(layer).young_kpa = young_kpa;
  // The error of a coarse mesh is far below what moduli change (calculation verification).
  const elements::PressSolution solution =
      elements::solvePress(stack, {.depths_mm = {kCheckedDepthMm}, .fineness = 0.5});
  if (!solution.stopped_by.empty()) return std::nullopt;
  return solution.table.shapes.back().force_n;
}

struct ModulusEffects {
  std::vector<ModulusEffect> of_layer;
  double unsolved = 0.0;  ///< ends that the solver does not reach: they count as the usual modulus
};

ModulusEffects modulusEffects(const std::vector<Input>& inputs, const CredibilitySettings& settings) {
  ModulusEffects effects;
  const tissue::LayerStack stack = checkedStack();
  const std::optional<double> usual = solvedForceWith(0, stack.layers.front().young_kpa);
  for (std::size_t layer = 0; layer < stack.layers.size(); ++layer) {
    report(settings.progress, "solving published moduli",
           static_cast<double>(layer) / static_cast<double>(stack.layers.size()));
    ModulusEffect& effect = effects.of_layer.emplace_back();
    const Input& input = inputs.at(kSkinModulus + layer);
    for (const auto& [end, modulus] : {std::pair{&effect.low, input.low}, std::pair{&effect.high, input.high}}) {
      const std::optional<double> force = solvedForceWith(layer, modulus);
      if (force && usual) {
        *end = *force / *usual;
      } else {
        ++effects.unsolved;
      }
    }
  }
  return effects;
}

/// The force on the product's finger at a place, N.
double feltForce(const std::vector<double>& values, const std::vector<Input>& inputs, const ModulusEffects& effects) {
  double factor = 1.0;
  for (std::size_t layer = 0; layer < effects.of_layer.size(); ++layer) {
    const std::size_t i = kSkinModulus + layer;
    factor *= effects.of_layer[layer].at(inputs[i], values[i]);
  }
  const contact::Surface surface =
      flatSheet({.thickness_mm = values[kThickness], .fat_mm = values[kFat], .stiffness_factor = factor});
  return pressFlat(surface, {.radius_mm = values[kFingerRadius]}).back().norm();
}

std::vector<double> usualValues(const std::vector<Input>& inputs) {
  std::vector<double> values;
  for (const Input& input : inputs) values.push_back(input.usual);
  return values;
}

/// A Latin hypercube: every input has one draw in each of `draws` equal parts of its range.
std::vector<std::vector<double>> drawnValues(const std::vector<Input>& inputs, std::size_t draws, Random& random) {
  std::vector<std::vector<double>> all(draws, std::vector<double>(inputs.size()));
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    std::vector<std::size_t> parts(draws);
    std::iota(parts.begin(), parts.end(), std::size_t{0});
    for (std::size_t k = draws - 1; k > 0; --k) std::swap(parts[k], parts[random.below(k + 1)]);
    for (std::size_t k = 0; k < draws; ++k) {
      all[k][i] = inputs[i].at((static_cast<double>(parts[k]) + random.uniform()) / static_cast<double>(draws));
    }
  }
  return all;
}

/// Nearest rank; `sorted` is not empty.
double quantileOf(const std::vector<double>& sorted, double share) {
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size()) - 1e-9));
  return sorted[std::max<std::size_t>(rank, 1) - 1];
}

/// Force at both ends of one input, all others as usual.
void addSwings(Evidence& evidence, const std::vector<Input>& inputs, const ModulusEffects& effects) {
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    for (const auto& [end, value] : {std::pair{"low", inputs[i].low}, std::pair{"high", inputs[i].high}}) {
      std::vector<double> values = usualValues(inputs);
      values[i] = value;
      evidence.numbers.push_back({fmt::format("{}_{}_{}", inputs[i].name, end, inputs[i].unit == "kPa" ? "kpa" : "mm"),
                                  value, inputs[i].unit});
      evidence.numbers.push_back(
          {fmt::format("force_n_{}_{}", inputs[i].name, end), feltForce(values, inputs, effects), "N"});
    }
  }
}

}  // namespace

CredibilitySection propagateSpread(const CredibilitySettings& settings) {
  constexpr std::size_t kDraws = 500;
  constexpr std::size_t kQuickDraws = 50;
  const std::vector<Input> inputs = uncertainInputs();
  const ModulusEffects effects = modulusEffects(inputs, settings);
  Random random(settings.seed);
  std::vector<double> forces;
  std::vector<double> known_moduli;
  for (std::vector<double> values : drawnValues(inputs, settings.quick ? kQuickDraws : kDraws, random)) {
    forces.push_back(feltForce(values, inputs, effects));
    for (std::size_t i = kSkinModulus; i < kInputs; ++i) values[i] = inputs[i].usual;
    known_moduli.push_back(feltForce(values, inputs, effects));
  }
  std::ranges::sort(forces);
  std::ranges::sort(known_moduli);
  Evidence all{.name = "force_spread",
               .title = "Spread of the felt force",
               .against = "thickness, fat and finger of the places that are judged, and published moduli",
               .command = "",
               .numbers = {{"depth_mm", kCheckedDepthMm, "mm"},
                           {"draws", static_cast<double>(forces.size()), ""},
                           {"usual_force_n", feltForce(usualValues(inputs), inputs, effects), "N"},
                           {"known_moduli_force_p5_n", quantileOf(known_moduli, 0.05), "N"},
                           {"known_moduli_force_p95_n", quantileOf(known_moduli, 0.95), "N"},
                           {"force_p5_n", quantileOf(forces, 0.05), "N"},
                           {"force_median_n", quantileOf(forces, 0.5), "N"},
                           {"force_p95_n", quantileOf(forces, 0.95), "N"},
                           {"unsolved_moduli", effects.unsolved, ""}}};
  Evidence each{.name = "force_by_input",
                .title = "Force by input",
                .against = "one input at its ends, the others as usual",
                .command = "",
                .numbers = {}};
  addSwings(each, inputs, effects);
  return {.name = "uncertainty", .title = "Uncertainty", .evidence = {std::move(all), std::move(each)}};
}

}  // namespace palpate::study
