#include "palpate/scene/solved_lumps.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "palpate/base/hash.h"

namespace palpate::scene {

namespace {

LumpSolver& lumpSolver() {
  static LumpSolver solver;
  return solver;
}

LumpStore& lumpStore() {
  static LumpStore store;
  return store;
}

/// Rises when the same lump is solved otherwise.
constexpr std::uint64_t kSolvedVersion = 1;

std::uint64_t lumpName(const tissue::LumpShape& lump, const tissue::LayerStack& stack) {
  Hash hash;
  hash.add(kSolvedVersion);
  hash.add(stack.poisson);
  for (const tissue::Layer& layer : stack.layers) {
    hash.add(layer.thickness_mm);
    hash.add(layer.young_kpa);
  }
  for (const double half : lump.half_axes_mm) hash.add(half);
  hash.add(lump.depth_mm);
  hash.add(lump.edge);
  hash.add(tissue::youngModulus(lump, stack));
  return hash.value();
}

}  // namespace

void setLumpSolver(LumpSolver solver) { lumpSolver() = std::move(solver); }

void setLumpStore(LumpStore store) { lumpStore() = std::move(store); }

std::optional<std::vector<SolvedPush>> solvedPushes(const tissue::LumpShape& lump, const tissue::LayerStack& stack) {
  const std::uint64_t name = lumpName(lump, stack);
  const LumpStore& store = lumpStore();
  if (store.find) {
    if (auto kept = store.find(name)) return kept;
  }
  if (!lumpSolver()) return std::nullopt;
  std::vector<SolvedPush> pushes = lumpSolver()(lump, stack);
  if (store.save) store.save(name, pushes);
  return pushes;
}

std::vector<tissue::ForceCorrection> correctionOf(std::span<const SolvedPush> pushes, const tissue::LumpEnergy& table) {
  constexpr double kHardlyN = 1e-4;  // the solver's own noise
  constexpr double kMaxRatio = 4.0;
  std::vector<tissue::ForceCorrection> correction;
  for (const SolvedPush& push : pushes) {
    const double plain = table.forceAt(0.0, push.depth_mm);
    const double factor = std::abs(plain) > kHardlyN ? push.extra_n / plain : 1.0;
    correction.push_back({push.depth_mm, std::clamp(factor, 1.0 / kMaxRatio, kMaxRatio)});
  }
  return correction;
}

}  // namespace palpate::scene
