// A new finger starts each path. A shorter one is kept when it shows a fault of the same kind, be it at another tick.
// Later starts are tried in a bisection and the runs that are left out get shorter and shorter. Based on: Zeller and
// Hildebrandt, "Simplifying and isolating failure-inducing input" (2002), without its complements.
#include "lab/hunt/minimise.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace palpate::lab {
namespace {

class Minimiser {
 public:
  Minimiser(const FirstFault& first_fault, std::size_t most_ticks) : first_fault_(first_fault), left_(most_ticks) {}

  /// Keeps the path up to its fault, if it has it.
  bool take(std::vector<Vec3> tips) {
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
      (take({whole.begin() + static_cast<std::ptrdiff_t>(start), whole.end()}) ? fails : sound) = start;
    }
  }
  /// Leaves out runs of ticks, half of the path first and single ticks last.
  void thinOut() {
    for (std::size_t run = std::max<std::size_t>(1, best_.size() / 2);; run /= 2) {
      for (std::size_t at = 0; at + run < best_.size();) {
        std::vector<Vec3> shorter = best_;
        const auto from = shorter.begin() + static_cast<std::ptrdiff_t>(at);
        shorter.erase(from, from + static_cast<std::ptrdiff_t>(run));
        if (!take(std::move(shorter))) at += run;
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

}  // namespace

std::vector<Vec3> minimised(std::vector<Vec3> tips, const FirstFault& first_fault, std::size_t most_ticks) {
  Minimiser minimiser(first_fault, std::max(most_ticks, tips.size()));
  if (!minimiser.take(tips)) return tips;
  minimiser.cutFront();
  minimiser.thinOut();
  return std::move(minimiser).best();
}

std::vector<Vec3> minimised(HuntWorld& world, const contact::FingerSettings& finger, std::vector<Vec3> tips,
                            Fault fault) {
  return minimised(std::move(tips), [&](std::span<const Vec3> path) -> std::optional<std::size_t> {
    const Finding finding = huntAlong(world, finger, path).of(fault);
    return finding.ticks > 0 ? std::optional(finding.first_tick) : std::nullopt;
  });
}

}  // namespace palpate::lab
