#include "view/viewer/state/messages.h"

#include <algorithm>

#include "palpate/base/language.h"

namespace palpate::viewer {

void Messages::add(Severity severity, const std::string& text, double now_s) {
  all_.push_back({severity, tr(text.c_str()), now_s});
  if (all_.size() > kKeptMessages) all_.pop_front();
  if (severity != Severity::info) ++unread_;
  // A newer info or warning replaces an older one; errors queue up.
  std::erase_if(waiting_, [](const Message& m) { return m.severity != Severity::error; });
  waiting_.push_back(all_.back());
}

void Messages::note(const std::string& text, double now_s) {
  all_.push_back({Severity::info, tr(text.c_str()), now_s});
  if (all_.size() > kKeptMessages) all_.pop_front();
}

const Message* Messages::toast(double now_s) const {
  for (const Message& message : waiting_) {
    if (message.severity == Severity::error) return &message;
  }
  if (waiting_.empty()) return nullptr;
  const Message& newest = waiting_.back();
  const double stays = newest.severity == Severity::warning ? kWarningS : kInfoS;
  return now_s - newest.at_s <= stays ? &newest : nullptr;
}

void Messages::dismiss() {
  const auto error =
      std::find_if(waiting_.begin(), waiting_.end(), [](const Message& m) { return m.severity == Severity::error; });
  if (error != waiting_.end()) {
    waiting_.erase(error);
  } else {
    waiting_.clear();
  }
}

void Messages::clearErrors(const std::string& beginning) {
  std::erase_if(waiting_,
                [&](const Message& m) { return m.severity == Severity::error && m.text.starts_with(beginning); });
}

}  // namespace palpate::viewer
