// Messages to the user: one at a time over the picture, all of them kept in a list. Pure.
#pragma once

#include <cstddef>
#include <deque>
#include <string>

namespace palpate::viewer {

enum class Severity : unsigned char { info, warning, error };

struct Message {
  Severity severity = Severity::info;
  std::string text;
  double at_s = 0.0;
};

inline constexpr double kInfoS = 4.0;
inline constexpr double kWarningS = 10.0;
inline constexpr std::size_t kKeptMessages = 200;

/// Infos and warnings disappear by themselves; an error stays until it is dismissed, and goes before the others.
class Messages {
 public:
  void add(Severity severity, const std::string& text, double now_s);
  /// Adds it to the list only, for things that the window shows in another way.
  void note(const std::string& text, double now_s);
  /// The message to show now, or null.
  const Message* toast(double now_s) const;
  void dismiss();
  /// Call on success after a failure: removes errors that begin with this text.
  void clearErrors(const std::string& beginning);

  const std::deque<Message>& all() const { return all_; }
  std::size_t unread() const { return unread_; }
  void markRead() { unread_ = 0; }

 private:
  std::deque<Message> all_;
  std::deque<Message> waiting_;  // errors first
  std::size_t unread_ = 0;
};

}  // namespace palpate::viewer
