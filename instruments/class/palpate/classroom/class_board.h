// An instructor's view of a class: messages become one tile per station, those who need help first. Knows no network,
// no window and no clock: each message and each question carries its time.
//
//   topic, payload, now ─ acceptMessage ─► ClassBoard ─ tiles(now) ─► window, `palpate class watch --json`
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/classroom/messages.h"

namespace palpate::classroom {

/// Reasons to walk over to a station, the most urgent first.
enum class Need : std::uint8_t {
  alarm,          ///< the device was stopped
  three_errors,   ///< three wrong answers in a row
  idle,           ///< a trial is on the screen and nothing was touched for a minute
  sites_skipped,  ///< the last answer was given without pressing every place
  too_light,      ///< presses are lighter than what counts
  none,
};
/// "three wrong answers" in English, for tr(); empty for none.
std::string_view wordsOf(Need need);

struct BoardRules {
  int errors = 3;
  double light_n = 0.5;       ///< lighter presses do not count as felt (training/exploration.h)
  double light_for_s = 10.0;  ///< so long touched, and never harder
  double idle_s = 60.0;
  double stale_s = 2.0;  ///< older live data are shown grey
};

struct Tile {
  std::string station;
  bool online = false;
  StationStatus status;
  std::optional<StationState> state;  ///< no trainee is signed in
  LiveSample live;                    ///< the newest; of long ago, perhaps
  std::optional<double> age_s;        ///< age of the newest live sample; nothing: none ever came
  bool fresh = false;                 ///< online, and live data are not stale
  Need need = Need::none;
};

/// A force at a time, for the trace of one station; `s` on the clock of `acceptMessage`.
struct ForcePoint {
  double s = 0.0;
  double force_n = 0.0;
};

/// The class after its n-th measured block.
struct CurvePoint {
  int number = 0;
  int trainees = 0;
  double median = 0.0, low = 0.0, high = 0.0;  ///< threshold and its quartiles
};

class ClassBoard {
 public:
  explicit ClassBoard(std::string class_id, const BoardRules& rules = {});

  /// False: no message of this class, or none that is well formed.
  bool acceptMessage(std::string_view topic, std::string_view payload, double now_s);

  /// Tiles in need of help first, each kind by name; the others by name.
  std::vector<Tile> tiles(double now_s) const;
  std::optional<Tile> tile(std::string_view station, double now_s) const;
  /// The newest seconds of a station.
  std::vector<ForcePoint> forces(std::string_view station) const;

  /// Adds a block that was measured before the watch began, from the class's records.
  void remember(const training::Uuid& trainee, const training::BlockRow& block);
  /// After the first, second, ... finished measuring block of each trainee.
  std::vector<CurvePoint> learningCurve() const;

  const BoardRules& rules() const { return rules_; }

  static constexpr double kForcesKeptS = 20.0;

 private:
  struct StationRecord {
    StationStatus status;
    std::optional<StationState> state;
    double state_since_s = 0.0;  ///< when it changed
    LiveSample live;
    std::optional<double> live_s;   ///< when the newest came
    double touched_s = 0.0;         ///< the newest touch
    double firm_s = 0.0;            ///< the newest press that counts
    double touching_since_s = 0.0;  ///< start of touching in this trial; 0: not touched yet
    std::deque<ForcePoint> forces;
    // From the newest block row: T so far.
    double threshold = 0.0, low = 0.0, high = 0.0;
  };
  void applyLive(StationRecord& seen, const LiveSample& live, double now_s) const;
  static void applyState(StationRecord& seen, const std::optional<StationState>& state, double now_s);
  bool applyRow(StationRecord& seen, std::string_view kind, std::string_view payload);
  Need assessNeed(const StationRecord& seen, double now_s) const;
  Tile makeTile(const std::string& station, const StationRecord& seen, double now_s) const;

  std::string class_id_;
  BoardRules rules_;
  std::map<std::string, StationRecord, std::less<>> seen_;
  std::map<training::Uuid, training::Uuid> trainee_of_session_;
  /// Per trainee, the finished blocks by id (version 7: in order of time) and their thresholds.
  std::map<training::Uuid, std::map<training::Uuid, double>> measured_;
};

}  // namespace palpate::classroom
