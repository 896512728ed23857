// Back end `remote`: another program moves the finger and gets its force, by datagrams on this machine
// (docs/remote.md).
//
//   their program ─ "p x y z" ─► UDP, 127.0.0.1:PORT ─► read_tip      write_force ─► "f x y z" ─► whoever sent last
//
// The servo's thread asks the socket itself and never waits: a tick costs two or three system calls, no lock and no
// memory. Nothing is kept of a client but its address, so slow, dead and many of them cost nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "palpate/device/back_ends.h"

namespace palpate::device {

inline constexpr int kRemotePort = 4730;

/// A client that is silent for longer has no position and gets no force, ticks: programs at 100 Hz are welcome.
inline constexpr std::uint64_t kMostSilentTicks = 20;

/// A longer datagram is refused.
inline constexpr std::size_t kMostMessageBytes = 256;

struct RemotePose {
  Vec3 tip_mm = Vec3::Zero();
  std::uint32_t buttons = 0;
};

/// "p x y z" or "p x y z buttons", numbers between blanks, a line end allowed; nothing for anything else, for what is
/// not finite and for places farther than kMaxCoordinateMm. No allocation.
std::optional<RemotePose> parsePose(std::string_view message) noexcept;

Probe probeRemote(const OpenOptions& options);

/// `which` is a port, or ADDRESS:PORT to listen elsewhere than on this machine; empty: kRemotePort.
Device openRemote(const OpenOptions& options);

}  // namespace palpate::device
