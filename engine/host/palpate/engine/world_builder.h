// Builds worlds in the background: the old body stays touchable until the new one is there, the newest request wins.
//
//   request ─► worker thread of low priority [ read? ─ scene::build or rebuilt ─ check? ] ─► collectResult ─►
//   ServoThread::change
//
// A build is cancelled at its next progress report when a newer request, a cancellation or the end comes.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "palpate/base/stopwatch.h"
#include "palpate/scene/world.h"

namespace palpate::engine {

struct BuildRequest {
  scene::Scene scene;
  /// An existing body is used as it is: only the maps on it are built again.
  std::shared_ptr<const scene::World> body;
  /// Makes the scene first, on the worker's thread, in place of the one above: for scenes that must be read from a
  /// file. May throw. Usually empty.
  std::function<scene::Scene()> read;
};

struct BuildResult {
  BuildRequest request;
  std::shared_ptr<const scene::World> world;  ///< null if it failed
  std::string error;                          ///< reason, in one line
};

struct BuildProgress {
  std::string stage;
  double done = 0.0;     ///< in [0, 1]
  double since_s = 0.0;  ///< it began
};

/// Any thread but the servo's: every call locks for as long as it takes to move some pointers.
class WorldBuilder {
 public:
  /// Looks at a finished world on the worker's thread and throws to refuse it. May be empty.
  using Check = std::function<void(const scene::World&)>;

  /// `patient`: all other work of this computer goes first, a hand that touches meanwhile above all.
  explicit WorldBuilder(Check check = {}, bool patient = true);
  /// Gives up the work under way and joins.
  ~WorldBuilder();
  WorldBuilder(const WorldBuilder&) = delete;
  WorldBuilder& operator=(const WorldBuilder&) = delete;

  /// Replaces whatever was requested before, also a result that was not taken.
  void request(BuildRequest request);
  /// Forgets the newest request: no result will come.
  void cancel();
  /// The result of the newest request once it is there, at most once. Never waits for the work.
  std::optional<BuildResult> collectResult();
  /// Progress of the work under way, if any.
  std::optional<BuildProgress> progress() const;

 private:
  void run();
  void replaceRequest(std::optional<BuildRequest> request);
  BuildResult build(BuildRequest request, std::uint64_t number);
  void note(std::uint64_t number, std::string_view stage, double done);

  Check check_;
  bool patient_;
  mutable std::mutex mutex_;  // guards all but the atomic
  std::condition_variable wake_;
  std::optional<BuildRequest> next_;
  std::optional<BuildResult> result_;
  BuildProgress progress_;
  Clock::time_point began_;
  bool busy_ = false;
  bool quit_ = false;
  std::atomic<std::uint64_t> newest_{0};  // number of the newest request or cancellation
  std::thread thread_;                    // last: it uses all of the above
};

}  // namespace palpate::engine
