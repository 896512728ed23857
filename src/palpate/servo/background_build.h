// Builds partitions on a thread of its own while everything else goes on: ask, look at the progress, take the result.
//
// Only the latest request counts: a newer one stops the work on an older one. A finished partition is handed over
// without waiting, so the haptic thread may take it. It is also never the haptic thread that pays for freeing an old
// one: the builder keeps a reference to what it handed over and lets go of it at its next build.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "palpate/hdb/partition.h"

namespace palpate::servo {

/// How a request ended: with a partition or with the text of an error.
struct BuildResult {
  std::uint64_t request = 0;
  std::shared_ptr<const hdb::Partition> partition;
  std::string error;
};

class BackgroundBuild {
 public:
  BackgroundBuild();
  /// Stops the work and joins; at most a hundredth of a build goes by until then.
  ~BackgroundBuild();
  BackgroundBuild(const BackgroundBuild&) = delete;
  BackgroundBuild& operator=(const BackgroundBuild&) = delete;

  /// Replaces whatever was asked before, also a result that nobody took. Returns the request's number. Any thread but
  /// the haptic one: it locks, and it may free a result.
  std::uint64_t request(std::shared_ptr<const mesh::TriangleMesh> mesh, const hdb::BuildSettings& settings);

  /// Forgets the latest request: no result will come.
  void cancel();

  /// Of the latest request, in [0, 1]; 1 when nothing is being built. Any thread.
  double progress() const noexcept { return progress_.load(std::memory_order_relaxed); }

  /// The result of the latest request once it is there, at most once. Never waits: in the rare moment in which the
  /// builder is putting the result down there is none yet. Any thread.
  std::optional<BuildResult> take() noexcept;

 private:
  struct Request {
    std::uint64_t number = 0;
    std::shared_ptr<const mesh::TriangleMesh> mesh;
    hdb::BuildSettings settings;
  };

  void work();
  BuildResult build(const Request& request);
  /// A result of no request (number 0) only says that the work has stopped.
  void handOver(BuildResult result);
  bool isLatest(std::uint64_t request) const { return latest_.load(std::memory_order_acquire) == request; }

  std::atomic<double> progress_{1.0};
  std::atomic<std::uint64_t> latest_{0};  // number of the latest request or cancellation

  std::mutex mutex_;  // held for moving pointers only
  std::condition_variable wake_;
  std::optional<Request> next_;        // guarded by mutex_
  std::optional<BuildResult> result_;  // guarded by mutex_
  bool stop_ = false;                  // guarded by mutex_

  std::vector<std::shared_ptr<const hdb::Partition>> handed_over_;  // the builder's thread only
  std::thread thread_;                                              // last: it uses all of the above
};

}  // namespace palpate::servo
