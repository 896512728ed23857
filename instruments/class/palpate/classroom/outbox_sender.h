// Which rows of a station's outbox may be sent now, and the commands that wait for it. Each alone, without network and
// without threads of its own.
#pragma once

#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <vector>

#include "palpate/base/stopwatch.h"
#include "palpate/classroom/messages.h"
#include "palpate/training/records/store.h"

namespace palpate::classroom {

/// Rate of outgoing rows; numbers of docs/reference/class-protocol.md.
struct OutboxPace {
  double most_per_s = 50.0;  ///< keeps a class that reconnects after a break from flooding its collector
  double resend_s = 3.0;     ///< without an acknowledgement
  int most_under_way = 200;  ///< rows sent and not yet acknowledged
};

/// Limits the rate, resends, and tries fewer rows while none is acknowledged. One thread.
class OutboxSender {
 public:
  using Time = Clock::time_point;
  OutboxSender(const OutboxPace& pace, Time now) : pace_(pace), tokens_(kBurst), filled_(now) {}

  /// How many of the oldest rows may be looked at. Widens with time, in case the oldest are rows that are never
  /// accepted.
  std::size_t window(Time now) const;
  /// Forgets rows that have left the outbox.
  void restrictTo(const std::vector<training::OutboxEntry>& waiting);
  /// Not sent yet, or so long ago that it is sent again.
  bool due(const training::Uuid& row, Time now);
  /// A share of the rate that is allowed; false: wait.
  bool consumeToken(Time now);
  void sent(const training::Uuid& row, Time now) { sent_[row] = now; }
  bool wasSent(const training::Uuid& row) const { return sent_.contains(row); }
  void acknowledged() { silent_since_.reset(); }

  /// As long as nothing is acknowledged, about this many are tried again: with the collector away, two hundred stations
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
  std::optional<Command> popCommand(Time now);

  static constexpr std::size_t kMax = 32;

 private:
  struct Waiting {
    Command command;
    Time since;
  };
  std::mutex mutex_;
  std::deque<Waiting> queue_;
};

}  // namespace palpate::classroom
