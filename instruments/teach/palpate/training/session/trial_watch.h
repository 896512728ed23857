// Effort in a trial, from its samples: how hard, how fast, searching or staying.
//
//   trace::Sample of every tick ─ follow ─► forces and speed of the trial, for its row
//
// Masters press steadily and harder where they stay than where they search (Laufer et al. 2015). One thread; no
// allocation.
#pragma once

#include <array>
#include <cstdint>

#include "palpate/trace/sample.h"
#include "palpate/training/records/rows.h"

namespace palpate::training {

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
