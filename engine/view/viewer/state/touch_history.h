// The last minute of both fingers, tick by tick and complete, so that a frozen picture can be stepped back and forth.
// Pure; one thread.
#pragma once

#include <array>
#include <vector>

#include "palpate/trace/sample.h"
#include "view/viewer/state/fingers.h"

namespace palpate::viewer {

class TouchHistory {
 public:
  using Moment = std::array<trace::Sample, kFingers>;

  /// About 27 MB a minute at 1 kHz, allocated as it fills.
  explicit TouchHistory(double ticks_per_s = 1000.0, double seconds = 60.0);

  /// Add samples in the order of ticks, all fingers of a tick one after the other.
  void add(const trace::Sample& sample);
  void clear();

  bool empty() const { return moments_.empty(); }
  double oldestTime() const { return momentTime(0); }
  double newestTime() const { return momentTime(moments_.size() - 1); }
  double tick() const { return tick_s_; }
  /// The state at a time: the newest moment that is not later, else the oldest. Must not be empty.
  const Moment& at(double time_s) const;
  /// Calls `visit` for every sample, oldest first.
  template <class Visit>
  void forEach(const Visit& visit) const {
    for (std::size_t i = 0; i < moments_.size(); ++i) {
      for (const trace::Sample& sample : moment(i)) visit(sample);
    }
  }

 private:
  const Moment& moment(std::size_t i) const { return moments_[(first_ + i) % moments_.size()]; }
  double momentTime(std::size_t i) const;

  double tick_s_;
  std::size_t most_;
  std::vector<Moment> moments_;  // a ring once it is full
  std::size_t first_ = 0;
};

}  // namespace palpate::viewer
