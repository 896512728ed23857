// Sittings of simulated trainees from end to end, kept as a person's are: the sitting, its session file, its rows in a
// station's file of results; one after the other through a course, or for a whole class.
//
//   TraineeBench, TraineeSitting ─ sitThrough ─► Store, sessions/<sitting>.session
//
// A block that was interrupted goes on. Deterministic: ids, times and answers come from the seed and the start.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "palpate/device/hand_device.h"
#include "palpate/scene/world.h"
#include "palpate/training/records/store.h"
#include "palpate/training/sitting.h"
#include "palpate/training/trainee/observer.h"

namespace palpate::training {

/// What all sittings of a run share.
struct TraineeBench {
  Protocol protocol;
  SiteSet sites;
  std::shared_ptr<const scene::World> body;  ///< null: nothing is touched (imagined_touch.h)
  device::HandChoice hand = {.hand = device::HandKind::thimble, .device = scene::DeviceModel::touch_x};
  bool session_files = true;  ///< each sitting is recorded tick by tick; not without a body
  Uuid station;
  std::function<bool()> stop = {};  ///< true: the sitting at hand is put down
  std::function<void(const TrialRow&)> answered = {};
};

/// The twelve sites, or the protocol's own. Throws Error.
SiteSet sitesOn(const scene::World& body, const Protocol& protocol);

struct TraineeSitting {
  ObserverSettings observer;
  SittingKind kind = SittingKind::pre_test;
  Uuid trainee;
  std::uint64_t seed = 1;
  std::int64_t start_ms = 0;
  int practised = 0;  ///< blocks that it has learned from
  int most_trials = 0;
};

/// What came of one.
struct SatThrough {
  SittingRow row;
  BlockRow block;
  std::vector<TrialRow> trials;       ///< of this sitting
  std::optional<BlockResult> result;  ///< of the whole block, once it is over
  bool resumed = false;
  double simulated_s = 0.0;
};

/// Throws Error as BodyTouch, Sitting and Store do.
SatThrough sitThrough(Store& store, const TraineeBench& bench, const TraineeSitting& sitting);

/// One trainee's sittings, one after the other, a few days apart.
struct TraineeCourse {
  ObserverSettings observer;
  Uuid trainee;
  std::vector<SittingKind> kinds;
  bool goes_on = false;  ///< those kinds that the records hold already are left out
  std::uint64_t seed = 1;
  std::int64_t start_ms = 0;  ///< of the first, or later where the records hold newer ones
  int most_trials = 0;
};

/// It learns from every practice that the records hold. Ends early when the bench's `stop` says so.
void sitCourse(Store& store, const TraineeBench& bench, const TraineeCourse& course,
               const std::function<void(const SatThrough&)>& after_each);

/// The station of simulated trainees, and one of them; kept before the first sitting.
StationRow simulatedStation(std::int64_t start_ms);
TraineeRow simulatedTrainee(const std::string& class_id, const std::string& code, std::int64_t created_ms,
                            const std::string& key = {});
/// A code as a real one is written, from a seed.
std::string simulatedCode(std::uint64_t seed, int number);

/// The course of the Virtual Haptic Back: a pre-test, six practices, a post-test.
std::vector<SittingKind> vhbCourse();

/// Trainee number `number` of a class: thresholds before and after are log-normal around the given means, with this
/// SD of the logarithm; who begins well ends well (r = 0.5).
ObserverSettings oneOfClass(const ObserverSettings& mean, double spread, std::uint64_t seed, int number);

}  // namespace palpate::training
