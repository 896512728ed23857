#include "palpate/film/webm_container.h"

#include <bit>

namespace palpate::film {

namespace {

/// Names of elements, with their length mark, as the specification prints them.
enum Element : std::uint32_t {
  kEbml = 0x1A45DFA3,
  kEbmlVersion = 0x4286,
  kEbmlReadVersion = 0x42F7,
  kMaxIdLength = 0x42F2,
  kMaxSizeLength = 0x42F3,
  kDocType = 0x4282,
  kDocTypeVersion = 0x4287,
  kDocTypeReadVersion = 0x4285,
  kSegment = 0x18538067,
  kSeekHead = 0x114D9B74,
  kSeek = 0x4DBB,
  kSeekId = 0x53AB,
  kSeekPosition = 0x53AC,
  kInfo = 0x1549A966,
  kTimestampScale = 0x2AD7B1,
  kDuration = 0x4489,
  kMuxingApp = 0x4D80,
  kWritingApp = 0x5741,
  kTracks = 0x1654AE6B,
  kTrackEntry = 0xAE,
  kTrackNumber = 0xD7,
  kTrackUid = 0x73C5,
  kTrackType = 0x83,
  kFlagLacing = 0x9C,
  kCodecId = 0x86,
  kVideo = 0xE0,
  kPixelWidth = 0xB0,
  kPixelHeight = 0xBA,
  kColour = 0x55B0,
  kMatrixCoefficients = 0x55B1,
  kRange = 0x55B9,
  kTransfer = 0x55BA,
  kPrimaries = 0x55BB,
  kCues = 0x1C53BB6B,
  kCuePoint = 0xBB,
  kCueTime = 0xB3,
  kCueTrackPositions = 0xB7,
  kCueTrack = 0xF7,
  kCueClusterPosition = 0xF1,
  kCluster = 0x1F43B675,
  kTimestamp = 0xE7,
  kSimpleBlock = 0xA3,
};

constexpr std::uint64_t kNanosecondsPerMs = 1'000'000;
constexpr std::uint64_t kBt709 = 1;
constexpr std::uint64_t kLimitedRange = 1;
constexpr std::uint64_t kTrack = 1;
constexpr std::int64_t kMaxClusterMs = 5000;  ///< a block counts from its cluster's begin in 16 bits
constexpr char kKeyBlock = '\x80';

std::string bigEndian(std::uint64_t value, int bytes) {
  std::string text;
  for (int i = bytes - 1; i >= 0; --i) text += static_cast<char>(value >> (8 * i) & 0xFF);
  return text;
}

/// Always eight bytes: places of later elements are known before their contents.
std::string encodeSize(std::uint64_t bytes) { return bigEndian(bytes | std::uint64_t{1} << 56, 8); }

std::string nameOf(Element element) { return bigEndian(element, (std::bit_width(std::uint32_t{element}) + 7) / 8); }

std::string holding(Element element, std::string_view content) {
  return nameOf(element) + encodeSize(content.size()) + std::string(content);
}

std::string number(Element element, std::uint64_t value) { return holding(element, bigEndian(value, 8)); }

std::string ebmlHead() {
  return holding(kEbml, number(kEbmlVersion, 1) + number(kEbmlReadVersion, 1) + number(kMaxIdLength, 4) +
                            number(kMaxSizeLength, 8) + holding(kDocType, "webm") + number(kDocTypeVersion, 4) +
                            number(kDocTypeReadVersion, 2));
}

std::string makeInfoElement(std::int64_t length_ms) {
  const auto bits = std::bit_cast<std::uint64_t>(static_cast<double>(length_ms));
  return holding(kInfo, number(kTimestampScale, kNanosecondsPerMs) + holding(kDuration, bigEndian(bits, 8)) +
                            holding(kMuxingApp, "palpate") + holding(kWritingApp, "palpate"));
}

std::string makeTracksElement(const view::ImageSize& size) {
  const std::string colour = holding(kColour, number(kMatrixCoefficients, kBt709) + number(kRange, kLimitedRange) +
                                                  number(kTransfer, kBt709) + number(kPrimaries, kBt709));
  const std::string video = holding(kVideo, number(kPixelWidth, static_cast<std::uint64_t>(size.width)) +
                                                number(kPixelHeight, static_cast<std::uint64_t>(size.height)) + colour);
  const std::string entry = number(kTrackNumber, kTrack) + number(kTrackUid, kTrack) + number(kTrackType, 1) +
                            number(kFlagLacing, 0) + holding(kCodecId, "V_VP9") + video;
  return holding(kTracks, holding(kTrackEntry, entry));
}

std::string seekTo(Element element, std::uint64_t position) {
  return holding(kSeek, holding(kSeekId, nameOf(element)) + number(kSeekPosition, position));
}

}  // namespace

void WebmContainer::add(std::string_view compressed, std::int64_t at_ms, bool is_key) {
  if (clusters_.empty() || is_key || at_ms - clusters_.back().begin_ms > kMaxClusterMs) {
    clusters_.push_back({at_ms, number(kTimestamp, static_cast<std::uint64_t>(at_ms))});
  }
  Cluster& cluster = clusters_.back();
  std::string block(1, static_cast<char>(0x80 | kTrack));
  block += bigEndian(static_cast<std::uint64_t>(at_ms - cluster.begin_ms), 2);
  block += is_key ? kKeyBlock : '\0';
  cluster.blocks += holding(kSimpleBlock, block.append(compressed));
  bytes_ += compressed.size();
}

std::vector<std::string> WebmContainer::pieces(const view::ImageSize& size, std::int64_t length_ms) const {
  const std::string info = makeInfoElement(length_ms);
  const std::string tracks = makeTracksElement(size);
  const auto cuesFrom = [&](std::uint64_t position) {
    std::string points;
    for (const Cluster& cluster : clusters_) {
      const std::string at = number(kCueTrack, kTrack) + number(kCueClusterPosition, position);
      points += holding(
          kCuePoint, number(kCueTime, static_cast<std::uint64_t>(cluster.begin_ms)) + holding(kCueTrackPositions, at));
      position += holding(kCluster, {}).size() + cluster.blocks.size();
    }
    return holding(kCues, points);
  };
  // Every size has eight bytes: the head is as long with its true places as without.
  const std::uint64_t seek_bytes = holding(kSeekHead, seekTo(kInfo, 0) + seekTo(kTracks, 0) + seekTo(kCues, 0)).size();
  const std::uint64_t cues_at = seek_bytes + info.size() + tracks.size();
  const std::string cues = cuesFrom(cues_at + cuesFrom(0).size());
  std::string head = holding(
      kSeekHead, seekTo(kInfo, seek_bytes) + seekTo(kTracks, seek_bytes + info.size()) + seekTo(kCues, cues_at));
  head += info + tracks + cues;
  std::uint64_t segment = head.size();
  for (const Cluster& cluster : clusters_) segment += holding(kCluster, {}).size() + cluster.blocks.size();
  std::vector<std::string> pieces = {ebmlHead() + nameOf(kSegment) + encodeSize(segment) + head};
  for (const Cluster& cluster : clusters_) pieces.push_back(holding(kCluster, cluster.blocks));
  return pieces;
}

}  // namespace palpate::film
