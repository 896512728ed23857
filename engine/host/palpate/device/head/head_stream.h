// Where a head is, as a tracker's program sends it: opentrack's output "UDP over network", which the phone and webcam
// trackers (AITrack, SmoothTrack and others) speak too. For a co-located display.
//
//   opentrack ─ 48 bytes ─► UDP, 127.0.0.1:4242 ─► newest(), once a picture ─► Viewer::headAt ─► window/head_tracker.h
//
// Only the picture follows it, never a force: a program that reaches the port can move a camera within bounds.
//
// The message: x, y, z in cm and yaw, pitch, roll in degrees, six little-endian doubles, from the place where the head
// was when the tracker was centred: x to the right, y up, z away from the screen (opentrack inverts an axis where a
// tracker has it the other way round). The angles are not used: eyes turn about the point that is tracked, nearly.
#pragma once

#include <optional>
#include <span>

#include "palpate/base/vec.h"
#include "palpate/device/detail/remote_socket.h"

namespace palpate::device {

inline constexpr int kHeadPort = 4242;

/// Farther from where it was centred no head is, mm.
inline constexpr double kFarthestHeadMm = 2000.0;

/// From the centre, mm; nothing for a message of another length, for numbers that are not finite and beyond
/// kFarthestHeadMm.
std::optional<Vec3> parseHeadPlace(std::span<const unsigned char> message) noexcept;

/// `which` is a port, or ADDRESS:PORT to listen elsewhere than on this machine; empty: kHeadPort. Throws Error.
class HeadStream {
 public:
  explicit HeadStream(const std::string& which);

  /// The last good place of what has come since it was asked before; at most kMaxMessages of it are read. Does not
  /// wait.
  std::optional<Vec3> newest() noexcept;

 private:
  UdpSocket socket_;
};

}  // namespace palpate::device
