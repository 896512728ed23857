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
#include <unordered_map>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/mesh/triangle_mesh.h"
#include "palpate/trace/bounded_series.h"
#include "palpate/trace/finger_course.h"
#include "palpate/trace/recording_reader.h"
#include "palpate/trace/sample.h"

namespace palpate::trace {

// Where fingers were on a body, how long and how hard: places of a recording, and the body's surface that they reach.
//
//   samples ─► PlaceCollector ─ a few thousand TouchedPlaces ─┐
//                                    skin of the built world ─┴─► touchedSurface ─► maps, area that was touched
//
// A place is a cell of space, so an hour needs no more memory than the skin has room for.

/// Edge of a cell: a quarter of a fingertip's radius.
inline constexpr double kPlaceCellMm = 2.0;

/// All ticks in which a finger's proxy lay in one cell and on one triangle.
struct TouchedPlace {
  std::uint32_t world = 0;
  std::uint32_t finger = 0;
  Index triangle = kNoIndex;  ///< of the world's skin
  Vec3 place = Vec3::Zero();  ///< their mean, mm
  std::uint64_t ticks = 0;
  double peak_force_n = 0.0;
};

class PlaceCollector {
 public:
  static constexpr std::size_t kMaxPlaces = std::size_t{1} << 19;

  /// Ticks without contact are left out.
  void add(const Sample& sample);
  /// By world, finger, triangle, cell.
  std::vector<TouchedPlace> places() const;
  /// Ticks whose place found no room or is not a plausible number.
  std::uint64_t leftOut() const { return left_out_; }

 private:
  using Key = std::array<std::int64_t, 6>;  ///< world, finger, triangle, cell
  struct KeyHash {
    std::size_t operator()(const Key& key) const noexcept;
  };
  struct Cell {
    Vec3 sum = Vec3::Zero();
    std::uint64_t ticks = 0;
    double peak_force_n = 0.0;
  };
  std::unordered_map<Key, Cell, KeyHash> cells_;
  std::uint64_t left_out_ = 0;
};

/// A point finger reaches as far as this: one cell.
inline constexpr double kMinReachMm = kPlaceCellMm;
/// Skin whose normal leans less than 60 degrees from straight out of the back is the back: flanks that face sideways
/// and the tops of the shoulders are not.
inline constexpr double kDorsalNormalZ = 0.5;

/// The skin with what was felt on it, a triangle each. Triangles near touched places are cut so small that the edge of
/// what was touched is a round one on a coarse mesh too.
struct TouchedSurface {
  mesh::TriangleMesh mesh;
  std::vector<double> ticks;  ///< fingers together; 0: not touched
  std::vector<double> peak_force_n;
  double touched_mm2 = 0.0;
  double dorsal_mm2 = 0.0;          ///< of the back (kDorsalNormalZ)
  double touched_dorsal_mm2 = 0.0;  ///< of the back, touched
  std::uint64_t astray_ticks = 0;   ///< of places that lie on no triangle of this skin
};

/// A place touches what lies within the reach of its finger and faces the same way. `reach_mm`: the radius of each
/// finger; at least kMinReachMm is taken. The skin must have a triangle.
TouchedSurface touchedSurface(const mesh::TriangleMesh& skin, std::span<const TouchedPlace> places,
                              std::span<const double> reach_mm);

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
