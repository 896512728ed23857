// The body of a trial: a scene with its tissue made even (for tests) and a hidden place in it; and how it was felt.
//
//   present scene, protocol, HiddenNow ─ trialScene ─► Scene ─ scene::rebuilt ─► World
//
// At the centre of the hidden place, and over its inner part, the stiffness is exactly `feltRatio` times the base under
// every force law, because laws are proportional to the map.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "palpate/device/device_profile.h"
#include "palpate/scene/scene.h"
#include "palpate/trace/sample.h"
#include "palpate/training/records/rows.h"
#include "palpate/training/session/session.h"

namespace palpate::training {

/// The factor that a finger on the skin feels over the place: the change, weakened by its depth, and the raised bone.
double feltRatio(const HiddenPlace& place, double change, ChangeMeaning meaning);

/// The base that a device can render together with the largest change of any session, at most the protocol's. A device
/// that cannot is given the whole body softer (servo/device_limits.h), more for a larger change: that would reveal the
/// answer's size, so the base is lowered once instead, for all sessions alike. `stiffest`: the most that the hand may
/// feel, N/mm.
double renderableBase(const Protocol& protocol, double stiffest_n_per_mm);

/// The same for a scene's fingers on a device.
double renderableBase(const Protocol& protocol, const scene::Scene& scene, const device::DeviceProfile& profile);

/// A site's hidden place as the scene's own dysfunction.
maps::Dysfunction dysfunctionAt(const Site& site, const HiddenPlace& place, double change, ChangeMeaning meaning);

/// `base` keeps its body, fingers, device limits and look; its own dysfunctions are taken out. Without
/// natural_stiffness the tissue is the same everywhere and answers by Hooke's law at once.
scene::Scene trialScene(const scene::Scene& base, const Protocol& protocol, SessionKind kind, const SiteSet& sites,
                        const std::optional<HiddenNow>& hidden);

// Effort in a trial, from its samples: how hard, how fast, searching or staying.
//
//   trace::Sample of every tick ─ follow ─► forces and speed of the trial, for its row
//
// Masters press steadily and harder where they stay than where they search (Laufer et al. 2015). One thread; no
// allocation.

class TrialWatch {
 public:
  explicit TrialWatch(double tick_s) : tick_s_(tick_s) {}

  void restart() noexcept { *this = TrialWatch(tick_s_); }
  void follow(const trace::Sample& sample) noexcept;
  /// Means over the time in which the skin was touched; 0 without any.
  void writeTo(TrialRow& row) const;

 private:
  static constexpr std::size_t kMaxFingers = 4;
  struct Mean {
    double sum = 0.0;
    std::uint64_t ticks = 0;
    void add(double value) {
      sum += value;
      ++ticks;
    }
    double value() const { return ticks == 0 ? 0.0 : sum / static_cast<double>(ticks); }
  };
  struct Moving {
    Vec3 tip = Vec3::Zero();
    Vec3 velocity = Vec3::Zero();  ///< smoothed, mm/s
    bool touched = false;
  };
  double tick_s_;
  std::array<Moving, kMaxFingers> fingers_{};
  Mean force_, speed_, searching_, staying_;
  double peak_n_ = 0.0;
};

}  // namespace palpate::training
