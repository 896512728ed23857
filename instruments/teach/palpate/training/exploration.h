// Which sites a finger has felt in a trial: a site counts when it was pressed hard enough for long enough. A place that
// was never touched cannot be found, and a threshold that ignores it is wrong by half
// (docs/explanation/training-methods.md).
//
//   trace::Sample of every tick ─ follow ─► presses, dwell, force, depth of each site
//
// One thread; no allocation in `follow`.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "palpate/trace/sample.h"
#include "palpate/training/site.h"

namespace palpate::training {

struct ExplorationSettings {
  double force_n = 0.5;     ///< a press is at least this hard in the hand (Sample::device_force) ...
  double dwell_s = 0.3;     ///< ... for this long in all
  double radius_mm = 15.0;  ///< from the site, on the map plane; the nearest site counts
  friend bool operator==(const ExplorationSettings&, const ExplorationSettings&) = default;
};

struct SiteVisit {
  int site = 0;
  int presses = 0;        ///< times the force rose over the limit
  double dwell_ms = 0.0;  ///< over the limit
  double peak_force_n = 0.0;
  double mean_force_n = 0.0;  ///< over the limit
  double deepest_mm = 0.0;
};

class Exploration {
 public:
  Exploration(const SiteSet& sites, const ExplorationSettings& settings, double tick_s);

  /// A tick of one finger. Any number of fingers; each its own presses.
  void follow(const trace::Sample& sample) noexcept;
  /// A new trial: nothing was felt yet. A finger that is still pressing begins a new press.
  void restart() noexcept;

  bool visited(int site) const;
  int visitedSites() const;
  std::vector<int> missing() const;
  /// A row for each site that was touched at all.
  std::vector<SiteVisit> visits() const;
  /// The site under the newest touch of any finger; 0: none.
  int touchedSite() const { return touched_; }

 private:
  static constexpr std::uint32_t kMaxFingers = 4;
  /// A touch further above or below its site is of another part of the body, mm: as far as skin is pushed in, and more.
  static constexpr double kMaxOverSiteMm = 60.0;
  struct Touching {
    int site = 0;  ///< pressed over the limit; 0: none
  };
  struct Felt {
    int presses = 0;
    double dwell_s = 0.0;
    double force_s = 0.0;  // N s
    double peak_n = 0.0;
    double deepest_mm = 0.0;
  };
  int nearest(const Vec3& place) const noexcept;

  std::vector<Site> sites_;
  ExplorationSettings settings_;
  double tick_s_;
  std::vector<Felt> felt_;
  std::array<Touching, kMaxFingers> fingers_{};
  int touched_ = 0;
  std::uint32_t touching_finger_ = kMaxFingers;  ///< the last to touch; kMaxFingers: none does
};

}  // namespace palpate::training
