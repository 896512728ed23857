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

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "palpate/classroom/class_settings.h"
#include "palpate/classroom/messages.h"
#include "palpate/classroom/outbox_sender.h"
#include "palpate/training/records/store.h"

namespace palpate::classroom {

struct StationInfo {
  std::string app;     ///< "palpate 0.9"
  std::string device;  ///< "mouse"
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

}  // namespace palpate::classroom
