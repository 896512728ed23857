// The last minute of every finger, for the plots: force, depth and speed at the servo's rate, drawn with the least and
// the greatest value of each pixel column so that no spike is lost. Pure; one thread.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "palpate/trace/sample.h"

namespace palpate::viewer {

struct PlotSample {
  double time_s = 0.0;
  float force_n = 0.0f;       ///< the whole
  float normal_n = 0.0f;      ///< its part along the skin's normal: the normal force
  float tangential_n = 0.0f;  ///< its part along the skin: the sideways force
  float depth_mm = 0.0f;
  float speed_mm_per_s = 0.0f;
  bool touching = false;
  bool slipping = false;
  bool limited = false;  ///< a device of the scene would not get this force: it is too strong or grows too fast
};

enum class PlotValue : std::uint8_t { force, normal_force, tangential_force, depth, speed };

struct Extent {
  float low = 0.0f;
  float high = 0.0f;
  bool any = false;
};

/// Events in one pixel column.
struct ColumnMarks {
  bool touching = false;
  bool slipping = false;
  bool limited = false;
};

class SampleHistory {
 public:
  explicit SampleHistory(double ticks_per_s = 1000.0, double seconds = 60.0);

  /// A force beyond `device_limit_n` counts as limited, like those that the limiter itself shortened.
  void add(const trace::Sample& sample, double device_limit_n = std::numeric_limits<double>::infinity());
  void clear();

  /// Oldest first.
  std::size_t size() const { return count_; }
  const PlotSample& at(std::size_t i) const { return samples_[(first_ + i) % samples_.size()]; }
  double newestTime() const { return count_ == 0 ? 0.0 : at(count_ - 1).time_s; }

  /// Least and greatest value in `columns` equal stretches of the time from `end_s` - `window_s` to `end_s`.
  std::vector<Extent> columns(PlotValue value, double end_s, double window_s, std::size_t columns) const;
  /// The same columns: whether the finger touched, slipped, was limited at any time in it.
  std::vector<ColumnMarks> marks(double end_s, double window_s, std::size_t columns) const;
  /// The sample nearest to a time, or null.
  const PlotSample* near(double time_s) const;

 private:
  std::size_t firstAfter(double time_s) const;
  /// Calls `visit(column, sample)` for the samples of a window, oldest first.
  template <class Visit>
  void forEachIn(double end_s, double window_s, std::size_t columns, const Visit& visit) const;

  std::vector<PlotSample> samples_;
  double tick_s_;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  Vec3 last_tip_ = Vec3::Zero();
  Vec3 last_hold_ = Vec3::Zero();
  std::uint64_t last_tick_ = 0;
  float speed_ = 0.0f;
};

float valueOf(const PlotSample& sample, PlotValue value);

/// The upper end of an axis: the smallest of 1, 2, 5, 10, 20, ... above `value`, at least `least`.
double axisEnd(double value, double least);

/// Both fingers' histories, and the part of them in the strips.
struct Plots {
  std::array<SampleHistory, 2> fingers;
  double window_s = 10.0;
  double end_s = 0.0;  ///< end of the strips, while paused
  bool paused = false;

  /// A finger's sample at a time, or null where its history does not reach back so far.
  const PlotSample* felt(std::size_t finger, double time_s) const {
    constexpr double kReachS = 0.1;
    const SampleHistory& history = fingers[finger];
    return history.size() == 0 || time_s < history.at(0).time_s - kReachS ? nullptr : history.near(time_s);
  }
  double newestTime() const { return std::max(fingers[0].newestTime(), fingers[1].newestTime()); }
  /// The end of the strips: the newest sample, or where they were stopped.
  double shownEnd() const { return paused ? end_s : newestTime(); }
  /// Age of the end of the strips, s.
  double pausedFor() const { return newestTime() - shownEnd(); }
};

/// The window of both fingers as a table: t_s, then normal_n, tangential_n, depth_mm, speed_mm_per_s, force_n per
/// finger.
std::string historyAsCsv(std::span<const SampleHistory> fingers, double end_s, double window_s);

}  // namespace palpate::viewer
