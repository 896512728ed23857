// A simulated trainee sits through one session: walks the screens, presses the sites, decides, answers, and reads the
// feedback, without a window and as fast as it can.
//
//   Session ─ screen, hidden place ─► TraineeRun ─ presses ─► Touching ─ samples ─► Session
//                                        └─ felt stiffness ─ decide (observer.h) ─ answer ─► Session ─ rows ─► save
//
// Time is the touching's ticks and nothing else: the same seeds give the same rows, bit by bit.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "palpate/training/records/store.h"
#include "palpate/training/session/session.h"
#include "palpate/training/trainee/observer.h"
#include "palpate/training/trainee/touching.h"

namespace palpate::training {

struct TraineeOrders {
  ObserverSettings observer;
  LumpTraineeSettings lump_observer = {};  ///< for sessions with lumps (lump_trainee.h)
  int practised = 0;                       ///< blocks that it has learned from
  int most_trials = 0;                     ///< stops the block after this many; 0: continues to its end
  /// Rows in their order, after each answer and screen: a trial counts when this returns.
  std::function<void(std::vector<Row>)> save = {};
  std::function<void(const TrialRow&)> answered = {};  ///< once its rows are kept; may be empty
  std::function<bool()> stop = {};                     ///< queried before each press: true leaves the block
};

/// Leads a simulated trainee through either kind of session, from screen to screen.
class SittingRun {
 public:
  virtual ~SittingRun() = default;
  SittingRun(const SittingRun&) = delete;
  SittingRun& operator=(const SittingRun&) = delete;

  /// Runs to the end of the block, or until it is left.
  void run();
  Moment now() const;

 protected:
  /// Both must outlive it. `start_ms`: of the touching's tick 0.
  SittingRun(Sitting& sitting, Touching& touching, const TraineeOrders& orders, std::int64_t start_ms,
             std::uint64_t seed)
      : touching_(touching), orders_(orders), random_(seed), sitting_(sitting), start_ms_(start_ms) {}
  virtual void walkScreen() = 0;
  bool stops() const;
  void storeNewRows();

  Touching& touching_;
  TraineeOrders orders_;
  Random random_;
  int answers_ = 0;  ///< trials or bodies

 private:
  Sitting& sitting_;
  std::int64_t start_ms_;
};

class TraineeRun final : public SittingRun {
 public:
  TraineeRun(Session& session, Touching& touching, const TraineeOrders& orders, std::int64_t start_ms);

  /// The sites felt in the current or last trial, and their stiffness over the middle one's.
  struct FeltSites {
    std::vector<int> sites;
    std::vector<double> stiffness_n_per_mm;
    std::vector<double> ratios() const;
  };
  const FeltSites& felt() const { return felt_; }

 private:
  void walkScreen() override;
  void checkDevice();
  void compareTwo();
  void tryTrial();
  void search(int trial);
  void answer(int site);
  bool pressSite(int number);
  void readFeedback();

  Session& session_;
  Touching::EachTick each_tick_;
  std::optional<HiddenNow> held_;  ///< in the body now
  Vec2 place_mm_ = Vec2::Zero();   ///< finger's place on the map plane
  FeltSites felt_;
};

}  // namespace palpate::training
