// A station's side of a class: rows of the outbox go to the collector until it reports that they are in the database;
// state and finger go to the instructor; the instructor's commands come back. Without a class or a network the session
// continues as usual, and waiting rows go out later.
//
//   Store's outbox ─► rows, oldest first, resent until acknowledged ─► collector ─ ack ─► Store::acknowledged
//   publishState, publishLive ─► instructor           instructor ─ cmd ─► popCommand
//
// Everything here runs in threads of its own and is never called from the servo's: the window polls and publishes at
// its own pace. No call waits for the network or the disk.
//
//   StationLink link(classroom::readMember("station.toml"), store, {"palpate 0.9", "mouse"});
//   link.publishState(makeStationState(session));              // whenever; goes out when it differs
//   link.publishLive(live);                           // every picture; goes out ten times a second
//   while (auto command = link.popCommand()) ...     // every picture
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "palpate/base/stopwatch.h"
#include "palpate/classroom/class_settings.h"
#include "palpate/classroom/messages.h"
#include "palpate/training/records/store.h"

namespace palpate::classroom {

struct StationInfo {
  std::string app;     ///< "palpate 0.9"
  std::string device;  ///< "mouse"
};

/// Rate of outgoing rows; numbers of docs/reference/class-protocol.md.
struct OutboxPace {
  double most_per_s = 50.0;  ///< keeps a class that reconnects after a break from flooding its collector
  double resend_s = 3.0;     ///< without an acknowledgement
  int most_under_way = 200;  ///< rows sent and not yet acknowledged
};

/// Messages sent since the link began.
struct LinkCounts {
  std::uint64_t live = 0;
  std::uint64_t rows = 0;     ///< repeats among them
  std::uint64_t repeats = 0;  ///< rows not acknowledged in time
  std::size_t refused = 0;    ///< rows that the class would not have; tried again after ten minutes
};

class StationLink {
 public:
  /// Turns the outbox of `store` on and opens a connection of its own to the same file. A missing broker is not an
  /// error. Throws Error for certificates that cannot be used and for a file that cannot be opened.
  StationLink(const Member& member, training::Store& store, const StationInfo& info, const OutboxPace& pace = {});
  /// Signs off: the retained state is cleared, the status says offline. Waits for the network at most a second.
  ~StationLink();
  StationLink(const StationLink&) = delete;
  StationLink& operator=(const StationLink&) = delete;

  // Any thread.
  void publishState(const StationState& state);
  /// Clears the retained state: no trainee is signed in.
  void clearState();
  void publishLive(const LiveSample& live);
  void publishSafety(const std::string& safety);  ///< "ok", or what stopped the device
  std::optional<Command> popCommand();            ///< oldest first; those that have expired are never given

  bool connected() const;
  std::size_t waiting() const;  ///< rows that the class does not have yet
  LinkCounts counts() const;
  /// In words for a status line: why it is not connected, that the disk is nearly full; empty: all is well.
  std::string trouble() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Less is left on the disk than a few hours of sessions need.
inline constexpr double kMinDiskBytes = 1e9;

// Which rows of a station's outbox may be sent now, and the commands that wait for it. Each alone, without network and
// without threads of its own.

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
