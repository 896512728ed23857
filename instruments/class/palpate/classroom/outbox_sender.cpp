#include "palpate/classroom/outbox_sender.h"

#include <algorithm>
#include <cmath>

namespace palpate::classroom {

namespace {

double secondsFrom(Clock::time_point then, Clock::time_point now) {
  return std::chrono::duration<double>(now - then).count();
}

}  // namespace

std::size_t OutboxSender::window(Time now) const {
  const auto most = static_cast<std::size_t>(pace_.most_under_way);
  if (!silent_since_) return most;
  const double rounds = std::min(20.0, secondsFrom(*silent_since_, now) / (4.0 * pace_.resend_s));
  return std::min(most, static_cast<std::size_t>(kProbes * std::exp2(rounds)));
}

void OutboxSender::restrictTo(const std::vector<training::OutboxEntry>& waiting) {
  std::unordered_map<training::Uuid, Time> kept;
  for (const auto& entry : waiting) {
    if (const auto found = sent_.find(entry.row); found != sent_.end()) kept.insert(*found);
  }
  sent_ = std::move(kept);
}

bool OutboxSender::due(const training::Uuid& row, Time now) {
  const auto found = sent_.find(row);
  if (found == sent_.end()) return true;
  if (secondsFrom(found->second, now) < pace_.resend_s) return false;
  if (!silent_since_) silent_since_ = now;
  return true;
}

bool OutboxSender::consumeToken(Time now) {
  tokens_ = std::min(kBurst, tokens_ + pace_.most_per_s * secondsFrom(filled_, now));
  filled_ = now;
  if (tokens_ < 1.0) return false;
  tokens_ -= 1.0;
  return true;
}

void CommandQueue::put(const Command& command, Time now) {
  const std::lock_guard lock(mutex_);
  if (queue_.size() >= kMax) queue_.pop_front();
  queue_.push_back({command, now});
}

std::optional<Command> CommandQueue::popCommand(Time now) {
  const std::lock_guard lock(mutex_);
  while (!queue_.empty()) {
    const Waiting oldest = std::move(queue_.front());
    queue_.pop_front();
    if (secondsFrom(oldest.since, now) <= kCommandExpiryS) return oldest.command;
  }
  return std::nullopt;
}

}  // namespace palpate::classroom
