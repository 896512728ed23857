// A simulated trainee sits through one sitting: walks the screens, presses the sites, decides, answers, and reads the
// feedback, without a window and as fast as it can.
//
//   Sitting ─ screen, hidden place ─► TraineeRun ─ presses ─► Touching ─ samples ─► Sitting
//                                        └─ felt stiffness ─ decide (observer.h) ─ answer ─► Sitting ─ rows ─► keep
//
// Time is the touching's ticks and nothing else: the same seeds give the same rows, bit by bit.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "palpate/training/sitting.h"
#include "palpate/training/trainee/observer.h"
#include "palpate/training/trainee/touching.h"

namespace palpate::training {

struct TraineeOrders {
  ObserverSettings observer;
  int practised = 0;    ///< blocks that it has learned from
  int most_trials = 0;  ///< puts the block down after so many; 0: goes on to its end
  /// Rows in their order, after each answer and screen: a trial counts when this returns.
  std::function<void(std::vector<Row>)> keep = {};
  std::function<void(const TrialRow&)> answered = {};  ///< once its rows are kept; may be empty
  std::function<bool()> stop = {};                     ///< asked before each press: true puts the block down
};

class TraineeRun {
 public:
  /// Both must outlive it. `start_ms`: of the touching's tick 0.
  TraineeRun(Sitting& sitting, Touching& touching, const TraineeOrders& orders, std::int64_t start_ms);

  /// To the end of the block, or until it is put down.
  void run();
  Moment now() const;

  /// What was felt in the trial at hand or the last one: the sites, and their stiffness over the middle one's.
  struct FeltSites {
    std::vector<int> sites;
    std::vector<double> stiffness_n_per_mm;
    std::vector<double> ratios() const;
  };
  const FeltSites& felt() const { return felt_; }

 private:
  void walkScreen();
  void checkDevice();
  void tryTrial();
  void search(int trial);
  void answer(int site);
  bool pressSite(int number);
  void readFeedback();
  void keepRows();
  bool stops() const;

  Sitting& sitting_;
  Touching& touching_;
  TraineeOrders orders_;
  std::int64_t start_ms_;
  Random random_;
  Touching::EachTick each_tick_;
  std::optional<HiddenNow> held_;  ///< by the body now
  Vec2 place_mm_ = Vec2::Zero();   ///< of the finger, on the map plane
  FeltSites felt_;
  int answers_ = 0;
};

}  // namespace palpate::training
