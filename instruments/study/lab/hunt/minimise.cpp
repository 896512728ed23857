// A new finger starts each path. A shorter one is kept when it shows a fault of the same kind, be it at another tick.
// Later starts are tried in a bisection and the runs that are left out get shorter and shorter. Based on: Zeller and
// Hildebrandt, "Simplifying and isolating failure-inducing input" (2002), without its complements.
#include "lab/hunt/kept_case.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/mesh/decimate.h"

namespace palpate::lab {
namespace {

/// Where the search for a smaller body begins; then twice as many, and so on.
constexpr std::size_t kFewestTriangles = 250;

class Minimiser {
 public:
  Minimiser(const FirstFault& first_fault, std::size_t most_ticks) : first_fault_(first_fault), left_(most_ticks) {}

  /// Keeps the path up to its fault, if it has it.
  bool adoptIfFaulty(std::vector<Vec3> tips) {
    if (tips.empty() || tips.size() > left_) return false;
    left_ -= tips.size();
    const std::optional<std::size_t> tick = first_fault_(tips);
    if (!tick) return false;
    tips.resize(*tick + 1);
    best_ = std::move(tips);
    return true;
  }
  /// The latest start from which the fault still comes, as far as bisection finds it.
  void cutFront() {
    std::size_t fails = 0, sound = best_.size();
    const std::vector<Vec3> whole = best_;
    while (fails + 1 < sound) {
      const std::size_t start = fails + (sound - fails) / 2;
      (adoptIfFaulty({whole.begin() + static_cast<std::ptrdiff_t>(start), whole.end()}) ? fails : sound) = start;
    }
  }
  /// Leaves out runs of ticks, half of the path first and single ticks last.
  void thinOut() {
    for (std::size_t run = std::max<std::size_t>(1, best_.size() / 2);; run /= 2) {
      for (std::size_t at = 0; at + run < best_.size();) {
        std::vector<Vec3> shorter = best_;
        const auto from = shorter.begin() + static_cast<std::ptrdiff_t>(at);
        shorter.erase(from, from + static_cast<std::ptrdiff_t>(run));
        if (!adoptIfFaulty(std::move(shorter))) at += run;
      }
      if (run <= 1) return;
    }
  }
  std::vector<Vec3> best() && { return std::move(best_); }

 private:
  const FirstFault& first_fault_;
  std::size_t left_;
  std::vector<Vec3> best_;
};

/// Outside and free, as a finger comes.
bool startsFree(const HuntWorld& world, const contact::FingerSettings& finger, std::span<const Vec3> tips) {
  if (tips.empty() || (world.body.closed() && world.body.inside(tips.front()))) return false;
  contact::FingerState state;
  return contact::step(world.surface, finger, state, tips.front()).touch == contact::Touch::free;
}

double longestMotion(std::span<const Vec3> tips) {
  double longest = 0.0;
  for (std::size_t k = 1; k < tips.size(); ++k) longest = std::max(longest, (tips[k] - tips[k - 1]).norm());
  return longest;
}

/// Nothing where the shape does not let that many be left.
std::optional<mesh::TriangleMesh> reducedTo(const mesh::TriangleMesh& mesh, std::size_t triangles) {
  try {
    return mesh::decimate(mesh, triangles);
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace

std::vector<Vec3> minimised(std::vector<Vec3> tips, const FirstFault& first_fault, std::size_t most_ticks) {
  Minimiser minimiser(first_fault, std::max(most_ticks, tips.size()));
  if (!minimiser.adoptIfFaulty(tips)) return tips;
  minimiser.cutFront();
  minimiser.thinOut();
  return std::move(minimiser).best();
}

std::vector<Vec3> minimised(HuntWorld& world, const contact::FingerSettings& finger, std::vector<Vec3> tips,
                            Fault fault) {
  const bool free_start = startsFree(world, finger, tips);
  const double longest = longestMotion(tips);
  return minimised(std::move(tips), [&](std::span<const Vec3> path) -> std::optional<std::size_t> {
    // A finger that begins in the body, or leaps farther than it ever did, would be another story.
    if (longestMotion(path) > longest || (free_start && !startsFree(world, finger, path))) return std::nullopt;
    const Finding finding = huntAlong(world, finger, path).of(fault);
    return finding.ticks > 0 ? std::optional(finding.first_tick) : std::nullopt;
  });
}

SmallCase minimised(const mesh::TriangleMesh& mesh, const contact::FingerSettings& finger,
                    const std::vector<Vec3>& tips, Fault fault) {
  HuntWorld world = buildHuntWorld(mesh);
  SmallCase best{mesh, minimised(world, finger, tips, fault)};
  const bool free_start = startsFree(world, finger, best.tips);
  for (std::size_t triangles = kFewestTriangles; triangles < mesh.triangles.size() / 2; triangles *= 2) {
    std::optional<mesh::TriangleMesh> reduced = reducedTo(world.body.mesh(), triangles);
    if (!reduced) continue;
    HuntWorld small = buildHuntWorld(*reduced);
    if (small.body.selfIntersecting() != world.body.selfIntersecting() || small.body.closed() != world.body.closed())
      continue;
    for (const std::vector<Vec3>& path : {best.tips, tips}) {
      if (free_start && !startsFree(small, finger, path)) continue;
      if (huntAlong(small, finger, path).of(fault).ticks == 0) continue;
      return {std::move(*reduced), minimised(small, finger, path, fault)};
    }
  }
  return best;
}

}  // namespace palpate::lab
