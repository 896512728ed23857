// A lattice grown from a dot whose neighbours lie in opposite pairs: the free site that its surroundings predict best
// is taken first, and dots that do not fit their neighbours are dropped in the end. No full rectangle is needed, and
// neither tilt nor a bent back matters. Two things that would go wrong silently: a seed must start from its shortest
// pair, or half of the pictures lock onto the diagonals with every second dot; and a round takes only its best third.
#include "palpate/measure/dot_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "palpate/base/order_statistics.h"
#include "palpate/measure/local_trend.h"

namespace palpate::measure {

namespace {

constexpr std::size_t kNearest = 10;  // dots that may be neighbours in the lattice, strays among them
constexpr double kOpposite = 0.25;    // |v + w| of a pair, of its length
constexpr double kAcross = 0.5;       // cosine between the two pairs of a seed, at most
constexpr double kLengthRatio = 1.8;  // largest ratio of the two pairs' lengths: perspective and tilt
constexpr std::size_t kSeeds = 5;
constexpr double kReach = 0.27;       // a dot is on a site within this share of the spacing
constexpr double kAreaWeight = 0.04;  // in spacings, for a dot of e times the neighbours' area
constexpr int kPredictorSites = 2;    // sites that predict another; also the farthest jump over a gap
constexpr double kMinOutlier = 0.08;  // in spacings
constexpr double kOutlierMedians = 4.5;
constexpr int kCleanings = 6;
constexpr std::size_t kMinGrid = 9;  // fewer is chance

using Site = std::pair<int, int>;  // column, row
using Sites = std::map<Site, std::size_t>;

struct Seed {
  std::size_t dot = 0;
  Vec2 first = Vec2::Zero();
  Vec2 second = Vec2::Zero();
  double misfit = 0.0;  // misfit to its four neighbours, in spacings
};

std::vector<Vec2> nearestOffsets(std::span<const Dot> dots, std::size_t from) {
  std::vector<Vec2> offsets;
  for (std::size_t i = 0; i < dots.size(); ++i) {
    if (i != from) offsets.push_back(dots[i].place_px - dots[from].place_px);
  }
  const std::size_t kept = std::min(kNearest, offsets.size());
  std::partial_sort(offsets.begin(), offsets.begin() + static_cast<std::ptrdiff_t>(kept), offsets.end(),
                    [](const Vec2& a, const Vec2& b) { return a.squaredNorm() < b.squaredNorm(); });
  offsets.resize(kept);
  return offsets;
}

struct OppositePair {
  Vec2 axis = Vec2::Zero();
  double misfit = 0.0;
};

std::vector<OppositePair> oppositePairs(const std::vector<Vec2>& offsets) {
  std::vector<OppositePair> pairs;
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    for (std::size_t j = i + 1; j < offsets.size(); ++j) {
      const Vec2 axis = 0.5 * (offsets[i] - offsets[j]);
      const double misfit = (offsets[i] + offsets[j]).norm() / axis.norm();
      if (misfit < kOpposite) pairs.push_back({axis, misfit});
    }
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const OppositePair& a, const OppositePair& b) { return a.axis.squaredNorm() < b.axis.squaredNorm(); });
  return pairs;
}

std::optional<Seed> seedAt(std::span<const Dot> dots, std::size_t dot) {
  const std::vector<OppositePair> pairs = oppositePairs(nearestOffsets(dots, dot));
  if (pairs.empty()) return {};
  const Vec2 first = pairs.front().axis;
  for (const OppositePair& pair : pairs) {
    const double cosine = std::abs(pair.axis.normalized().dot(first.normalized()));
    if (cosine < kAcross && pair.axis.norm() < kLengthRatio * first.norm())
      return Seed{dot, first, pair.axis, pairs.front().misfit + pair.misfit};
  }
  return {};
}

/// The seeds whose four neighbours fit best, of those with a usual spacing.
std::vector<Seed> bestSeeds(std::span<const Dot> dots) {
  std::vector<Seed> seeds;
  for (std::size_t i = 0; i < dots.size(); ++i) {
    if (const auto seed = seedAt(dots, i)) seeds.push_back(*seed);
  }
  if (seeds.empty()) return seeds;
  std::vector<double> lengths;
  for (const Seed& seed : seeds) lengths.push_back(seed.first.norm());
  std::nth_element(lengths.begin(), lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2), lengths.end());
  const double usual = lengths[lengths.size() / 2];
  for (Seed& seed : seeds) seed.misfit += std::abs(std::log(seed.first.norm() / usual));
  std::sort(seeds.begin(), seeds.end(), [](const Seed& a, const Seed& b) { return a.misfit < b.misfit; });
  seeds.resize(std::min(kSeeds, seeds.size()));
  return seeds;
}

/// The lattice while it grows.
class Lattice {
 public:
  Lattice(std::span<const Dot> dots, const Seed& seed) : dots_(dots), used_(dots.size(), false) {
    assignDot({0, 0}, seed.dot);
    const Vec2 centre = dots[seed.dot].place_px;
    const double reach = kReach * seed.first.norm();
    const std::pair<Site, Vec2> around[] = {
        {{1, 0}, seed.first}, {{-1, 0}, -seed.first}, {{0, 1}, seed.second}, {{0, -1}, -seed.second}};
    for (const auto& [site, offset] : around) assignNearestDot(site, centre + offset, reach);
  }

  void grow() {
    for (;;) {
      std::vector<Candidate> candidates = candidatesNow();
      std::sort(candidates.begin(), candidates.end(),
                [](const Candidate& a, const Candidate& b) { return a.misfit < b.misfit; });
      bool grew = false;
      const std::size_t best = (candidates.size() + 2) / 3;
      for (std::size_t i = 0; i < best; ++i) {
        const Candidate& c = candidates[i];
        if (used_[c.dot] || sites_.contains(c.site)) continue;
        assignDot(c.site, c.dot);
        grew = true;
      }
      if (!grew) return;
    }
  }

  /// Drops dots that fit their neighbours worse than these fit theirs, and nearly isolated ones; returns the median
  /// misfit.
  double clean() {
    double median = 0.0;
    for (int round = 0; round < kCleanings; ++round) {
      std::map<Site, double> misfits;
      for (const auto& [site, dot] : sites_) misfits[site] = misfitAt(site, dot);
      median = medianOf(misfits);
      std::vector<Site> dropped;
      for (const auto& [site, misfit] : misfits) {
        if (neighboursBeside(site) < 2 || isOutlier(misfits, site, misfit, median)) dropped.push_back(site);
      }
      if (dropped.empty()) break;
      for (const Site& site : dropped) sites_.erase(site);
    }
    return median;
  }

  const Sites& sites() const { return sites_; }

 private:
  struct Candidate {
    Site site;
    std::size_t dot = 0;
    double misfit = 0.0;
  };

  void assignDot(const Site& site, std::size_t dot) {
    sites_[site] = dot;
    used_[dot] = true;
  }

  void assignNearestDot(const Site& site, const Vec2& place, double reach) {
    const auto nearest = nearestFree(place, reach, {});
    if (nearest) assignDot(site, nearest->first);
  }

  /// Dot and misfit in pixels; with a usual area, one like it is preferred.
  std::optional<std::pair<std::size_t, double>> nearestFree(const Vec2& place, double reach,
                                                            const std::optional<double>& usual_area) const {
    std::optional<std::pair<std::size_t, double>> best;
    for (std::size_t i = 0; i < dots_.size(); ++i) {
      if (used_[i]) continue;
      const double distance = (dots_[i].place_px - place).norm();
      if (distance > reach) continue;
      double misfit = distance;
      if (usual_area && *usual_area > 0.0 && dots_[i].area_px > 0.0)
        misfit += kAreaWeight / kReach * reach * std::abs(std::log(dots_[i].area_px / *usual_area));
      if (!best || misfit < best->second) best = {i, misfit};
    }
    return best;
  }

  struct Around {
    std::vector<Neighbour> neighbours;
    double mean_area = 0.0;
  };

  Around around(const Site& site) const {
    Around found;
    for (int dc = -kPredictorSites; dc <= kPredictorSites; ++dc) {
      for (int dr = -kPredictorSites; dr <= kPredictorSites; ++dr) {
        if (dc == 0 && dr == 0) continue;
        const auto at = sites_.find({site.first + dc, site.second + dr});
        if (at == sites_.end()) continue;
        found.neighbours.push_back({Vec2(dc, dr), dots_[at->second].place_px});
        found.mean_area += dots_[at->second].area_px;
      }
    }
    if (!found.neighbours.empty()) found.mean_area /= static_cast<double>(found.neighbours.size());
    return found;
  }

  std::vector<Candidate> candidatesNow() const {
    std::map<Site, bool> asked;
    std::vector<Candidate> candidates;
    for (const auto& [site, dot] : sites_) {
      for (int dc = -kPredictorSites; dc <= kPredictorSites; ++dc) {
        for (int dr = -kPredictorSites; dr <= kPredictorSites; ++dr) {
          const Site free{site.first + dc, site.second + dr};
          if (sites_.contains(free) || !asked.emplace(free, true).second) continue;
          const Around near = around(free);
          const auto trend = fitTrend(near.neighbours);
          if (!trend) continue;
          const double spacing = 0.5 * (trend->slope.col(0).norm() + trend->slope.col(1).norm());
          const auto nearest = nearestFree(trend->value, kReach * spacing, near.mean_area);
          if (nearest) candidates.push_back({free, nearest->first, nearest->second / spacing});
        }
      }
    }
    return candidates;
  }

  double misfitAt(const Site& site, std::size_t dot) const {
    const auto trend = fitTrend(around(site).neighbours);
    if (!trend) return 1.0;
    const double spacing = 0.5 * (trend->slope.col(0).norm() + trend->slope.col(1).norm());
    return (dots_[dot].place_px - trend->value).norm() / std::max(spacing, 1e-9);
  }

  int neighboursBeside(const Site& site) const {
    return static_cast<int>(sites_.contains({site.first - 1, site.second})) +
           static_cast<int>(sites_.contains({site.first + 1, site.second})) +
           static_cast<int>(sites_.contains({site.first, site.second - 1})) +
           static_cast<int>(sites_.contains({site.first, site.second + 1}));
  }

  static double medianOf(const std::map<Site, double>& misfits) {
    std::vector<double> values;
    for (const auto& [site, misfit] : misfits) values.push_back(misfit);
    return upperMedianOf(std::move(values));
  }

  /// A wrong dot makes its neighbours misfit too: only the worst of a neighbourhood is one.
  static bool isOutlier(const std::map<Site, double>& misfits, const Site& site, double misfit, double median) {
    if (misfit <= std::max(kMinOutlier, kOutlierMedians * median)) return false;
    for (int dc = -1; dc <= 1; ++dc) {
      for (int dr = -1; dr <= 1; ++dr) {
        const auto beside = misfits.find({site.first + dc, site.second + dr});
        if (beside != misfits.end() && beside->second > misfit) return false;
      }
    }
    return true;
  }

  std::span<const Dot> dots_;
  std::vector<bool> used_;
  Sites sites_;
};

/// Mean steps from column to column and from row to row, px.
Mat2 meanSteps(std::span<const Dot> dots, const Sites& sites) {
  Mat2 steps = Mat2::Zero();
  double counts[2] = {0.0, 0.0};
  for (const auto& [site, dot] : sites) {
    const Site next[] = {{site.first + 1, site.second}, {site.first, site.second + 1}};
    for (int axis = 0; axis < 2; ++axis) {
      const auto beside = sites.find(next[axis]);
      if (beside == sites.end()) continue;
      steps.col(axis) += dots[beside->second].place_px - dots[dot].place_px;
      counts[axis] += 1.0;
    }
  }
  for (int axis = 0; axis < 2; ++axis) steps.col(axis) /= std::max(counts[axis], 1.0);
  return steps;
}

/// Columns to the right of the picture, rows up in it.
GridSite upright(const Site& site, bool swapped, int column_sign, int row_sign) {
  const int along = swapped ? site.second : site.first;
  const int other = swapped ? site.first : site.second;
  return {column_sign * along, row_sign * other};
}

void setSites(std::span<const Dot> dots, const Sites& sites, DotGrid& grid) {
  const Mat2 steps = meanSteps(dots, sites);
  const bool swapped = std::abs(steps(0, 0)) * steps.col(1).norm() < std::abs(steps(0, 1)) * steps.col(0).norm();
  const Vec2 along = steps.col(swapped ? 1 : 0);
  const Vec2 up = steps.col(swapped ? 0 : 1);
  const int column_sign = along.x() > 0.0 ? 1 : -1;
  const int row_sign = up.y() < 0.0 ? 1 : -1;  // pictures count downwards
  for (const auto& [site, dot] : sites) grid.dots.push_back({upright(site, swapped, column_sign, row_sign), dots[dot]});
  grid.spacing_px = 0.5 * (along.norm() + up.norm());
  const Vec2 upwards = row_sign * up;
  grid.roll_deg = std::atan2(upwards.x(), -upwards.y()) * kDegPerRad;
}

}  // namespace

DotGrid growGrid(std::span<const Dot> dots) {
  std::optional<Lattice> largest;
  for (const Seed& seed : bestSeeds(dots)) {
    Lattice lattice(dots, seed);
    lattice.grow();
    if (!largest || lattice.sites().size() > largest->sites().size()) largest.emplace(std::move(lattice));
  }
  DotGrid grid;
  std::vector<bool> in_grid(dots.size(), false);
  if (largest) {
    const double irregularity = largest->clean();
    if (largest->sites().size() >= kMinGrid) {
      grid.irregularity = irregularity;
      setSites(dots, largest->sites(), grid);
      for (const auto& [site, dot] : largest->sites()) in_grid[dot] = true;
    }
  }
  for (std::size_t i = 0; i < dots.size(); ++i) {
    if (!in_grid[i]) grid.strays.push_back(dots[i]);
  }
  return grid;
}

}  // namespace palpate::measure
