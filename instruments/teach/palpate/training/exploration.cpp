#include "palpate/training/exploration.h"

#include <algorithm>
#include <cmath>

#include "palpate/base/error.h"

namespace palpate::training {

Exploration::Exploration(const SiteSet& sites, const ExplorationSettings& settings, double tick_s)
    : sites_(sites.sites), settings_(settings), tick_s_(tick_s), felt_(sites.sites.size()) {
  if (!(tick_s > 0.0)) throw Error("exploration: a tick must be longer than 0 s");
}

/// On the map plane, so that a site under raised or sunk skin is still found; 0: none is within reach.
int Exploration::nearest(const Vec3& place) const noexcept {
  double least = settings_.radius_mm * settings_.radius_mm;
  int nearest_site = 0;
  for (const Site& site : sites_) {
    const double dx = place.x() - site.place_mm.x();
    const double dy = place.y() - site.place_mm.y();
    const double squared = dx * dx + dy * dy;
    // The front of a closed body lies on the same map plane: it is not a site.
    if (!(squared <= least) || std::abs(place.z() - site.point_mm.z()) > kMaxOverSiteMm) continue;
    least = squared;
    nearest_site = site.number;
  }
  return nearest_site;
}

void Exploration::follow(const trace::Sample& sample) noexcept {
  if (sample.finger >= kMaxFingers) return;
  Touching& finger = fingers_[sample.finger];
  const contact::FingerOutput& contact = sample.contact;
  const bool touches = contact.touch != contact::Touch::free;
  const int site = touches ? nearest(contact.anchor) : 0;
  if (touches || touching_finger_ == sample.finger) {
    touched_ = site;
    touching_finger_ = touches ? sample.finger : kMaxFingers;
  }
  const double force_n = sample.device_force.norm();
  const bool presses = site != 0 && force_n >= settings_.force_n;
  if (site != 0) {
    Felt& felt = felt_[static_cast<std::size_t>(site) - 1];
    felt.peak_n = std::max(felt.peak_n, force_n);
    felt.deepest_mm = std::max(felt.deepest_mm, contact.depth_mm);
    if (presses) {
      if (finger.site != site) ++felt.presses;
      felt.dwell_s += tick_s_;
      felt.force_s += force_n * tick_s_;
    }
  }
  finger.site = presses ? site : 0;
}

void Exploration::restart() noexcept {
  std::ranges::fill(felt_, Felt{});
  fingers_ = {};
}

bool Exploration::visited(int site) const {
  if (site < 1 || site > static_cast<int>(felt_.size())) return false;
  // Half a tick: a dwell is a sum of ticks, and must not miss its mark by rounding.
  return felt_[static_cast<std::size_t>(site) - 1].dwell_s >= settings_.dwell_s - 0.5 * tick_s_;
}

int Exploration::visitedSites() const {
  return static_cast<int>(std::ranges::count_if(sites_, [this](const Site& site) { return visited(site.number); }));
}

std::vector<int> Exploration::missing() const {
  std::vector<int> numbers;
  for (const Site& site : sites_) {
    if (!visited(site.number)) numbers.push_back(site.number);
  }
  return numbers;
}

std::vector<SiteVisit> Exploration::visits() const {
  std::vector<SiteVisit> visits;
  for (std::size_t i = 0; i < felt_.size(); ++i) {
    const Felt& felt = felt_[i];
    if (!(felt.peak_n > 0.0)) continue;
    visits.push_back({.site = sites_[i].number,
                      .presses = felt.presses,
                      .dwell_ms = 1000.0 * felt.dwell_s,
                      .peak_force_n = felt.peak_n,
                      .mean_force_n = felt.dwell_s > 0.0 ? felt.force_s / felt.dwell_s : 0.0,
                      .deepest_mm = felt.deepest_mm});
  }
  return visits;
}

}  // namespace palpate::training
