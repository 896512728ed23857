// Which rows of a station's outbox may be sent now, and the commands that wait for it. Each by itself, without network
// and without threads of its own.
#pragma once

#include <chrono>
#include <deque>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <vector>

#include "palpate/base/stopwatch.h"
#include "palpate/classroom/station_link.h"

namespace palpate::classroom {

/// Rate, resending, and how much is tried while nobody acknowledges. One thread.
class OutboxSender {
 public:
  using Time = Clock::time_point;
  OutboxSender(const OutboxPace& pace, Time now) : pace_(pace), tokens_(kBurst), filled_(now) {}

  /// So many of the oldest rows may be looked at. Wider again with time, should the oldest be rows that nobody takes.
  std::size_t window(Time now) const;
  /// Forgets what has left the outbox.
  void restrictTo(const std::vector<training::OutboxEntry>& waiting);
  /// Not sent yet, or so long ago that it is sent again.
  bool due(const training::Uuid& row, Time now);
  /// A share of the rate that is allowed; false: wait.
  bool takeToken(Time now);
  void sent(const training::Uuid& row, Time now) { sent_[row] = now; }
  bool wasSent(const training::Uuid& row) const { return sent_.contains(row); }
  void acknowledged() { silent_since_.reset(); }

  /// As long as nothing is acknowledged, about so many are tried again: with the collector away, two hundred stations
  /// would else send all that they have every three seconds.
  static constexpr double kProbes = 20.0;

 private:
  static constexpr double kBurst = 5.0;  // rows at once: a trial comes with its block and an event

  OutboxPace pace_;
  std::unordered_map<training::Uuid, Time> sent_;
  double tokens_;
  Time filled_;
  std::optional<Time> silent_since_;  ///< something was sent twice, and nothing acknowledged since
};

/// Any thread.
class CommandQueue {
 public:
  using Time = Clock::time_point;
  void put(const Command& command, Time now);
  /// The oldest that has not expired.
  std::optional<Command> take(Time now);

  static constexpr std::size_t kMost = 32;

 private:
  struct Waiting {
    Command command;
    Time since;
  };
  std::mutex mutex_;
  std::deque<Waiting> queue_;
};

}  // namespace palpate::classroom
