// Sessions of simulated trainees from end to end, kept as a person's are: the session, its recording, its rows in a
// station's file of results; one after the other through a programme, or for a whole class.
//
//   TraineeBench, TraineeSession ─ runSession ─► Store, sessions/<session>.session
//
// A block that was interrupted continues. Deterministic: ids, times and answers come from the seed and the start.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "palpate/device/hand_device.h"
#include "palpate/lumps/lump_block.h"
#include "palpate/scene/world.h"
#include "palpate/training/records/store.h"
#include "palpate/training/session/session.h"
#include "palpate/training/trainee/observer.h"

namespace palpate::training {

/// Settings and files that all sessions of a run share.
struct TraineeBench {
  Protocol protocol;
  SiteSet sites;
  std::shared_ptr<const scene::World> body;  ///< null: nothing is touched (imagined_touch.h)
  device::HandChoice hand = {.hand = device::HandKind::thimble, .device = scene::DeviceModel::touch_x};
  bool recording_files = true;  ///< each session is recorded tick by tick; not without a body
  Uuid station;
  std::function<bool()> stop = {};  ///< true: stops the current session
  std::function<void(const TrialRow&)> answered = {};
};

/// The twelve sites, or the protocol's own. Throws Error.
SiteSet sitesOn(const scene::World& body, const Protocol& protocol);

struct TraineeSession {
  ObserverSettings observer;
  LumpTraineeSettings lump_observer = {};  ///< for sessions with lumps
  SessionKind kind = SessionKind::pre_test;
  Uuid trainee;
  std::uint64_t seed = 1;
  std::int64_t start_ms = 0;
  int practised = 0;  ///< blocks that it has learned from
  int most_trials = 0;
};

/// Result of one session.
struct SessionOutcome {
  SessionRow row;
  BlockRow block;
  std::vector<TrialRow> trials;       ///< trials of this session
  std::optional<BlockResult> result;  ///< result of the whole block, once it is over
  lumps::LumpCounts lumps = {};       ///< over the whole block so far, in a session with lumps
  bool resumed = false;
  double simulated_s = 0.0;
};

/// Throws Error as BodyTouch, Session and Store do.
SessionOutcome runSession(Store& store, const TraineeBench& bench, const TraineeSession& session);

/// One trainee's sessions, one after the other, a few days apart.
struct TraineeCourse {
  ObserverSettings observer;
  LumpTraineeSettings lump_observer = {};
  Uuid trainee;
  std::vector<SessionKind> kinds;
  bool goes_on = false;  ///< those kinds that the records hold already are left out
  std::uint64_t seed = 1;
  std::int64_t start_ms = 0;  ///< start of the first session, or later where the records hold newer ones
  int most_trials = 0;
};

/// It learns from every practice that the records hold. Ends early when the bench's `stop` returns true.
void runProgramme(Store& store, const TraineeBench& bench, const TraineeCourse& course,
                  const std::function<void(const SessionOutcome&)>& after_each);

/// The station of simulated trainees, and one of them; kept before the first session.
StationRow simulatedStation(std::int64_t start_ms);
TraineeRow simulatedTrainee(const std::string& class_id, const std::string& code, std::int64_t created_ms,
                            const std::string& key = {});
/// A code as a real one is written, from a seed.
std::string simulatedCode(std::uint64_t seed, int number);

/// The programme of the Virtual Haptic Back: a pre-test, six practices, a post-test.
std::vector<SessionKind> vhbCourse();

/// Trainee number `number` of a class: thresholds before and after are log-normal around the given means, with this
/// SD of the logarithm; who begins well ends well (r = 0.5).
ObserverSettings oneOfClass(const ObserverSettings& mean, double spread, std::uint64_t seed, int number);

}  // namespace palpate::training
