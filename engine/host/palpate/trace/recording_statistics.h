// A recording in numbers: forces, depths and speeds of each finger, contacts, search and palpation,
// what the limiter did, which ticks are missing, and the places that were touched.
//
//   RecordingReader ─ ticks ─► RecordingMeasurement ─► RecordingStatistics ─► `palpate recording report`
//
// Ticks pass through once. The memory that it takes does not grow with them: series and histograms are of fixed size,
// lists end at kMaxListed while their counts go on. Names of safety bits belong to servo, so bits are counted here as
// they are.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/trace/bounded_series.h"
#include "palpate/trace/finger_course.h"
#include "palpate/trace/recording_reader.h"
#include "palpate/trace/sample.h"
#include "palpate/trace/touched_places.h"

namespace palpate::trace {

/// Length of the lists of contacts, phases and changed worlds: more are counted, not listed.
inline constexpr std::size_t kMaxListed = 5000;

/// One bit of a status.
struct BitTally {
  std::uint64_t ticks = 0;       ///< in which it was set
  std::uint64_t times = 0;       ///< that it came
  std::uint64_t first_tick = 0;  ///< of the first time
};
using BitTallies = std::array<BitTally, 32>;

struct FingerStatistics {
  explicit FingerStatistics();

  std::uint64_t ticks = 0;
  std::uint64_t touching = 0;  ///< of them
  std::uint64_t slipping = 0;  ///< of these
  /// In the order of Measured, of ticks in contact.
  std::array<FixedHistogram, kMeasured> in_contact;
  TickSeries series;
  BitTallies safety;
  BitTallies contact_status;
  std::uint64_t contacts = 0;
  std::uint64_t longest_contact_ticks = 0;
  double path_mm = 0.0;  ///< of all contacts
  std::array<std::uint64_t, kPhases> phase_ticks{};
  std::array<std::uint64_t, kPhases> phases{};  ///< how many

  const FixedHistogram& of(Measured measured) const { return in_contact[static_cast<std::size_t>(measured)]; }
};

/// Ticks in which nothing was recorded, although some were before and after.
struct TickGap {
  std::uint64_t after_tick = 0;
  std::uint64_t missing = 0;
};

struct RecordedTicks {
  std::uint64_t first = 0;
  std::uint64_t last = 0;
  std::uint64_t recorded = 0;  ///< with one finger at least
  std::uint64_t gaps = 0;
  TickGap longest_gap;
  std::uint64_t out_of_order = 0;  ///< left out: no writer leaves such
  std::uint64_t expected() const { return recorded == 0 ? 0 : last - first + 1; }
  std::uint64_t missing() const { return expected() - recorded; }
};

struct WorldChange {
  std::uint64_t tick = 0;
  std::uint32_t world = 0;
};

struct RecordingStatistics {
  double ticks_per_s = 1000.0;
  RecordedTicks ticks;
  std::vector<FingerStatistics> fingers;
  std::vector<Contact> contacts;    ///< by their ends, at most kMaxListed
  std::uint64_t contact_count = 0;  ///< of all
  std::vector<PhaseSpan> phases;    ///< by their ends, at most kMaxListed
  std::uint64_t phase_count = 0;
  std::vector<WorldChange> worlds;  ///< that it began with, and each change
  std::uint64_t world_changes = 0;  ///< after the first
  std::vector<TouchedPlace> places;
  std::uint64_t places_left_out = 0;  ///< ticks
  double seconds(std::uint64_t some_ticks) const { return static_cast<double>(some_ticks) / ticks_per_s; }
};

class RecordingMeasurement {
 public:
  RecordingMeasurement(std::size_t fingers, double ticks_per_s);

  /// All samples of a tick, as forEachTick gives them.
  void add(std::span<const Sample> samples);
  /// The last call.
  RecordingStatistics finish();

 private:
  struct Course {
    FingerMotion motion;
    ContactRuns contacts;
    PhaseRuns phases;
    std::uint32_t safety_before = 0;
    std::uint32_t status_before = 0;
  };
  bool follows(std::uint64_t tick);
  void add(const Sample& sample);
  void list(const std::optional<Contact>& contact);
  void list(const std::optional<PhaseSpan>& phase);

  RecordingStatistics statistics_;
  std::vector<Course> courses_;
  PlaceCollector places_;
};

/// Throws Error naming the block that is damaged.
RecordingStatistics measure(RecordingReader& recording, const TickSpan& span = {}, const Progress& progress = {});

}  // namespace palpate::trace
