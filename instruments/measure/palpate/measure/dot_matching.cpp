#include "palpate/measure/dot_matching.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "palpate/measure/local_trend.h"

namespace palpate::measure {

namespace {

// All of the spacing of the dots.
constexpr double kFarthestShift = 0.6;  // beyond half of it the next dot is nearer, and the drift is refused anyway
constexpr double kCluster = 0.06;
constexpr double kAtRest = 0.12;
constexpr double kGrowing = 0.2;
constexpr double kPredicted = 0.12;
constexpr int kSitesAround = 2;  // sites that predict how the next one moved
// Area in the second picture over the first, of the usual ratio: outside, something covers a part of the dot.
constexpr double kMinAreaRatio = 0.75;
constexpr double kMaxAreaRatio = 1.33;

/// The motion that most dots share, px.
Vec2 commonShift(const DotGrid& grid, std::span<const Dot> after) {
  std::vector<Vec2> shifts;
  for (const GridDot& dot : grid.dots) {
    for (const Dot& mark : after) {
      const Vec2 shift = mark.place_px - dot.dot.place_px;
      if (shift.norm() < kFarthestShift * grid.spacing_px) shifts.push_back(shift);
    }
  }
  const double radius = kCluster * grid.spacing_px;
  Vec2 best = Vec2::Zero();
  std::size_t best_votes = 0;
  for (const Vec2& shift : shifts) {
    Vec2 sum = Vec2::Zero();
    std::size_t votes = 0;
    for (const Vec2& other : shifts) {
      if ((other - shift).norm() > radius) continue;
      sum += other;
      ++votes;
    }
    if (votes > best_votes) {
      best_votes = votes;
      best = sum / static_cast<double>(votes);
    }
  }
  return best;
}

struct Nearest {
  std::size_t mark = 0;
  double distance = 0.0;
};

std::optional<Nearest> nearestMark(std::span<const Dot> after, const std::vector<bool>& used, const Vec2& place_px,
                                   double reach_px) {
  std::optional<Nearest> best;
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (used[i]) continue;
    const double distance = (after[i].place_px - place_px).norm();
    if (distance < reach_px && (!best || distance < best->distance)) best = {i, distance};
  }
  return best;
}

/// A dot and a mark that are each other's nearest.
DotMatch mutualMatch(std::span<const Vec2> expected_px, std::span<const Dot> after, double reach_px) {
  DotMatch match{std::vector<std::optional<std::size_t>>(expected_px.size())};
  const std::vector<bool> none(after.size(), false);
  for (std::size_t i = 0; i < expected_px.size(); ++i) {
    const auto nearest = nearestMark(after, none, expected_px[i], reach_px);
    if (!nearest) continue;
    const Vec2 mark = after[nearest->mark].place_px;
    const bool is_mutual = std::none_of(expected_px.begin(), expected_px.end(),
                                        [&](const Vec2& other) { return (other - mark).norm() < nearest->distance; });
    if (is_mutual) match.of[i] = nearest->mark;
  }
  return match;
}

using DotsBySite = std::map<std::pair<int, int>, std::size_t>;

DotsBySite indexDotsBySite(const DotGrid& grid) {
  DotsBySite sites;
  for (std::size_t i = 0; i < grid.dots.size(); ++i) sites[{grid.dots[i].site.column, grid.dots[i].site.row}] = i;
  return sites;
}

/// Motion of a dot by its matched neighbours; none with fewer than two.
std::optional<Vec2> predictedMotion(const DotGrid& grid, const DotsBySite& sites, std::span<const Dot> after,
                                    const DotMatch& match, std::size_t dot) {
  std::vector<Neighbour> neighbours;
  const GridSite site = grid.dots[dot].site;
  for (int dc = -kSitesAround; dc <= kSitesAround; ++dc) {
    for (int dr = -kSitesAround; dr <= kSitesAround; ++dr) {
      const auto at = sites.find({site.column + dc, site.row + dr});
      if (at == sites.end() || !match.of[at->second]) continue;
      neighbours.push_back({Vec2(dc, dr), after[*match.of[at->second]].place_px - grid.dots[at->second].dot.place_px});
    }
  }
  if (neighbours.size() < 2) return {};
  constexpr std::size_t kNeverBent = 1000;
  if (const auto trend = fitTrend(neighbours, kNeverBent)) return trend->value;
  Vec2 mean = Vec2::Zero();
  for (const Neighbour& n : neighbours) mean += n.value / static_cast<double>(neighbours.size());
  return mean;
}

/// Grows from matched dots to unmatched neighbours, the best half of a round first.
void growInwards(const DotGrid& grid, std::span<const Dot> after, DotMatch& match) {
  const DotsBySite sites = indexDotsBySite(grid);
  std::vector<bool> used(after.size(), false);
  for (const auto& mark : match.of) {
    if (mark) used[*mark] = true;
  }
  struct Candidate {
    std::size_t dot;
    Nearest nearest;
  };
  for (;;) {
    std::vector<Candidate> candidates;
    for (std::size_t i = 0; i < grid.dots.size(); ++i) {
      if (match.of[i]) continue;
      const auto motion = predictedMotion(grid, sites, after, match, i);
      if (!motion) continue;
      const auto nearest = nearestMark(after, used, grid.dots[i].dot.place_px + *motion, kGrowing * grid.spacing_px);
      if (nearest) candidates.push_back({i, *nearest});
    }
    if (candidates.empty()) return;
    std::sort(candidates.begin(), candidates.end(),
              [](const Candidate& a, const Candidate& b) { return a.nearest.distance < b.nearest.distance; });
    for (std::size_t i = 0; i < (candidates.size() + 1) / 2; ++i) {
      if (used[candidates[i].nearest.mark]) continue;
      used[candidates[i].nearest.mark] = true;
      match.of[candidates[i].dot] = candidates[i].nearest.mark;
    }
  }
}

void count(DotMatch& match) {
  match.count = static_cast<std::size_t>(
      std::count_if(match.of.begin(), match.of.end(), [](const auto& mark) { return mark.has_value(); }));
}

/// Drops marks whose area shows that they are partly covered, since their centroid is not the dot's.
void dropHalfHidden(const DotGrid& grid, std::span<const Dot> after, DotMatch& match) {
  std::vector<double> ratios;
  const auto ratio_of = [&](std::size_t i) {
    const double before = grid.dots[i].dot.area_px;
    return before > 0.0 ? after[*match.of[i]].area_px / before : 0.0;
  };
  for (std::size_t i = 0; i < match.of.size(); ++i) {
    if (match.of[i] && ratio_of(i) > 0.0) ratios.push_back(ratio_of(i));
  }
  if (ratios.empty()) return;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  for (std::size_t i = 0; i < match.of.size(); ++i) {
    if (!match.of[i] || ratio_of(i) == 0.0) continue;
    const double relative = ratio_of(i) / *middle;
    if (relative < kMinAreaRatio || relative > kMaxAreaRatio) match.of[i].reset();
  }
}

}  // namespace

DotMatch matchDots(const DotGrid& grid, std::span<const Dot> after) {
  const Vec2 shift = commonShift(grid, after);
  std::vector<Vec2> expected;
  for (const GridDot& dot : grid.dots) expected.emplace_back(dot.dot.place_px + shift);
  DotMatch match = mutualMatch(expected, after, kAtRest * grid.spacing_px);
  growInwards(grid, after, match);
  dropHalfHidden(grid, after, match);
  count(match);
  return match;
}

DotMatch matchAt(const DotGrid& grid, std::span<const Vec2> predicted_px, std::span<const Dot> after) {
  DotMatch match = mutualMatch(predicted_px, after, kPredicted * grid.spacing_px);
  dropHalfHidden(grid, after, match);
  count(match);
  return match;
}

}  // namespace palpate::measure
