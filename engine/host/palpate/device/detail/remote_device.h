// Back end `remote`: another program moves the finger and gets its force, by datagrams on this machine or, with a key,
// over a network (docs/reference/remote.md).
//
//   their program ─ "p x y z" ─► UDP, 127.0.0.1:PORT ─► read_tip      write_force ─► "f x y z" ─► who holds the finger
//
// The servo's thread reads the socket itself and never waits: a tick costs two or three system calls, no lock and no
// memory. Nothing is kept of a client but its address, so slow, dead and many of them cost nothing.
#pragma once

#include "palpate/device/back_ends.h"

namespace palpate::device {

inline constexpr int kRemotePort = 4730;
inline constexpr const char* kRemoteAddress = "127.0.0.1";

/// A flood of messages must not keep a tick from ending.
inline constexpr int kMaxDatagramsPerTick = 32;

/// Names the file of the key that both sides share. Beyond loopback there must be one.
inline constexpr const char* kRemoteKeyVariable = "PALPATE_REMOTE_KEY_FILE";

Probe probeRemote(const OpenOptions& options);

/// `which` is a port, or ADDRESS:PORT to listen elsewhere than on this machine; empty: kRemotePort.
Device openRemote(const OpenOptions& options);

}  // namespace palpate::device
