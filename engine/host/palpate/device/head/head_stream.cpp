#include "palpate/device/head/head_stream.h"

#include <array>
#include <bit>
#include <cstdint>

namespace palpate::device {

namespace {

constexpr const char* kHeadTracker = "head tracker";
constexpr std::size_t kNumbers = 6;
constexpr double kMmInCm = 10.0;

/// Trackers send 250 a second at most; a flood must not keep a picture from being drawn.
constexpr int kMaxMessages = 64;

double numberAt(std::span<const unsigned char> bytes) noexcept {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < sizeof(bits); ++i) bits |= static_cast<std::uint64_t>(bytes[i]) << (8 * i);
  return std::bit_cast<double>(bits);
}

}  // namespace

std::optional<Vec3> parseHeadPlace(std::span<const unsigned char> message) noexcept {
  if (message.size() != kNumbers * sizeof(double)) return std::nullopt;
  Vec3 place;
  for (int axis = 0; axis < 3; ++axis) place[axis] = kMmInCm * numberAt(message.subspan(sizeof(double) * axis));
  if (!(place.norm() <= kFarthestHeadMm)) return std::nullopt;
  return place;
}

HeadStream::HeadStream(const std::string& which)
    : socket_(parseSocketAddress(which, {.port = kHeadPort}, kHeadTracker), kHeadTracker) {}

std::optional<Vec3> HeadStream::newest() noexcept {
  std::optional<Vec3> newest;
  std::array<char, 64> message;
  system::UdpPeer nobody;
  for (int read = 0; read < kMaxMessages; ++read) {
    const int bytes = socket_.port().receive(message, nobody);
    if (bytes < 0) break;
    if (static_cast<std::size_t>(bytes) > message.size()) continue;  // longer than any
    const std::optional<Vec3> place = parseHeadPlace(
        std::span(reinterpret_cast<const unsigned char*>(message.data()), static_cast<std::size_t>(bytes)));
    if (place) newest = place;
  }
  return newest;
}

}  // namespace palpate::device
