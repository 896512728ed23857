// Numbers by std::from_chars and fmt::format_to_n, which know no locale and allocate nothing.
#include "palpate/device/detail/remote_gate.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "palpate/base/error.h"
#include "palpate/base/private_folder.h"
#include "palpate/base/text.h"
#include "palpate/device/trajectory.h"

namespace palpate::device {

namespace {

constexpr std::string_view kBlanks = " \t\r\n";
constexpr std::string_view kHello = "hello";
constexpr std::size_t kNonceDigits = 32;
constexpr std::uint64_t kMaxKeyFileBytes = 4096;

std::string_view nextWord(std::string_view& text) noexcept {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return text = {};
  const std::size_t end = std::min(text.find_first_of(kBlanks, begin), text.size());
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

std::string_view withoutBlanksAtTheEnd(std::string_view text) noexcept {
  const std::size_t last = text.find_last_not_of(kBlanks);
  return text.substr(0, last == std::string_view::npos ? 0 : last + 1);
}

/// Takes the last word off the text, and the one blank before it.
std::string_view lastWord(std::string_view& text) noexcept {
  text = withoutBlanksAtTheEnd(text);
  const std::size_t blank = text.rfind(' ');
  const std::size_t begin = blank == std::string_view::npos ? 0 : blank + 1;
  const std::string_view word = text.substr(begin);
  text = text.substr(0, begin == 0 ? 0 : blank);
  return word;
}

template <class Whole>
bool readWhole(std::string_view word, Whole& value) noexcept {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

bool isLetterOrDigit(char c) noexcept {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

template <class... Values>
std::size_t written(std::array<char, kMaxDatagramBytes>& text, fmt::format_string<Values...> format,
                    Values&&... values) noexcept {
  const auto end = fmt::format_to_n(text.data(), text.size(), format, std::forward<Values>(values)...);
  return std::min(end.size, text.size());
}

void countOne(std::atomic<std::uint64_t>& count) noexcept { count.fetch_add(1, std::memory_order_relaxed); }

}  // namespace

std::optional<RemotePose> parsePose(std::string_view message) noexcept {
  if (nextWord(message) != "p") return std::nullopt;
  RemotePose pose;
  for (int axis = 0; axis < 3; ++axis) {
    double& value = pose.tip_mm[axis];
    if (!readNumber(nextWord(message), value) || !(std::abs(value) <= kMaxCoordinateMm)) return std::nullopt;
  }
  const std::string_view buttons = nextWord(message);
  if (!buttons.empty() && !readWhole(buttons, pose.buttons)) return std::nullopt;
  if (!nextWord(message).empty()) return std::nullopt;
  return pose;
}

std::string readRemoteKey(const std::filesystem::path& file) {
  requireClosedFile(file);
  const std::string content = readFile(file, kMaxKeyFileBytes);
  const std::string_view key = trimmed(content);
  if (key.size() < kMinKeyBytes || key.size() > kMaxKeyBytes || !std::all_of(key.begin(), key.end(), isLetterOrDigit)) {
    throw Error::inFile(
        file.string(),
        fmt::format("must contain one line of {} to {} letters and digits; make one with openssl rand -hex 32",
                    kMinKeyBytes, kMaxKeyBytes));
  }
  return std::string(key);
}

RemoteGate::RemoteGate(const std::optional<std::string>& key, const Seed& seed, std::uint64_t handover_ticks) noexcept
    : handover_ticks_(handover_ticks) {
  if (key) key_.emplace(*key);
  std::copy(seed.begin(), seed.end(), nonce_.begin());
  beginConversation();
}

void RemoteGate::beginConversation() noexcept {
  fmt::format_to_n(nonce_.data() + Seed().size(), nonce_.size() - Seed().size(), "{:08x}", conversation_++);
  pose_number_ = answer_number_ = answers_left_ = 0;
}

void RemoteGate::tick(std::uint64_t tick) noexcept {
  if (!holder_ || tick < heard_tick_ + handover_ticks_) return;
  holder_.reset();
  beginConversation();
}

std::optional<RemotePose> RemoteGate::acceptPose(std::string_view datagram, const RemotePeer& from,
                                                 std::uint64_t tick) noexcept {
  reply_size_ = 0;
  if (holder_ && from != *holder_) {
    countOne(counts_.ignored);
    return std::nullopt;
  }
  std::string_view message = datagram.size() > kMaxDatagramBytes ? std::string_view() : datagram;
  if (key_) {
    if (message.starts_with(kHello)) {
      answerHello(message, datagram.size(), tick);
      return std::nullopt;
    }
    message = opened(message);
    if (message.empty()) {
      countOne(counts_.not_signed);
      return std::nullopt;
    }
  }
  const std::optional<RemotePose> pose = parsePose(message);
  if (!pose) {
    countOne(counts_.malformed);
    return std::nullopt;
  }
  holder_ = from;
  heard_tick_ = tick;
  answers_left_ = kAnswersPerPose;
  return pose;
}

std::optional<std::string_view> RemoteGate::verified(std::string_view message) const noexcept {
  const std::string_view signature = lastWord(message);
  const auto expected = hexOf(key_->of(message));
  if (!equalInConstantTime(signature, {expected.data(), expected.size()})) return std::nullopt;
  return message;
}

std::string_view RemoteGate::opened(std::string_view message) noexcept {
  auto text = verified(message);
  if (!text) return {};
  std::uint64_t number = 0;
  if (!readWhole(lastWord(*text), number) || number <= pose_number_) return {};
  if (lastWord(*text) != std::string_view(nonce_.data(), nonce_.size())) return {};
  pose_number_ = number;
  return *text;
}

void RemoteGate::answerHello(std::string_view message, std::size_t bytes, std::uint64_t tick) noexcept {
  auto text = verified(message);
  if (!text || bytes < kHelloBytes || greeted_tick_ == tick) return countOne(counts_.not_signed);
  const std::string_view theirs = lastWord(*text);
  if (*text != kHello || theirs.size() != kNonceDigits || !std::all_of(theirs.begin(), theirs.end(), isLetterOrDigit)) {
    return countOne(counts_.malformed);
  }
  greeted_tick_ = tick;
  const std::size_t size =
      written(reply_, "challenge {} {} {}", theirs, std::string_view(nonce_.data(), nonce_.size()), pose_number_);
  reply_size_ = signedSize(reply_, size);
}

std::size_t RemoteGate::signedSize(Text& text, std::size_t size) const noexcept {
  const auto signature = hexOf(key_->of({text.data(), size}));
  if (size + signature.size() + 2 > text.size()) return 0;
  text[size] = ' ';
  std::copy(signature.begin(), signature.end(), text.begin() + static_cast<std::ptrdiff_t>(size) + 1);
  text[size + 1 + signature.size()] = '\n';
  return size + signature.size() + 2;
}

std::string_view RemoteGate::answer(const Vec3& force) noexcept {
  if (!holder_ || answers_left_ == 0) return {};
  --answers_left_;
  std::size_t size = 0;
  if (key_) {
    size = written(answer_, "f {:.6f} {:.6f} {:.6f} {} {}", force.x(), force.y(), force.z(),
                   std::string_view(nonce_.data(), nonce_.size()), ++answer_number_);
    size = signedSize(answer_, size);
  } else {
    size = written(answer_, "f {:.6f} {:.6f} {:.6f}\n", force.x(), force.y(), force.z());
  }
  return {answer_.data(), size};
}

}  // namespace palpate::device
