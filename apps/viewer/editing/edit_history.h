// Undo and redo of whole values: one entry a gesture, so that a drag of a hundred mouse events is one step back.
#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <utility>

namespace palpate::viewer {

inline constexpr std::size_t kUndoSteps = 100;

/// A gesture is `begin` (remembers the value), any number of changes, `commit` (one step, unless nothing changed).
template <class Value>
class EditHistory {
 public:
  void begin(const Value& now) {
    if (!open_) before_ = now;
    open_ = true;
  }

  /// `words` name the step: "move dysfunction 2".
  void commit(const Value& now, std::string words) {
    if (!std::exchange(open_, false) || before_ == now) return;
    undo_.push_back({std::move(before_), std::move(words)});
    if (undo_.size() > kUndoSteps) undo_.pop_front();
    redo_.clear();
  }

  /// Forgets a gesture and gives back the value from before it.
  Value abandon(const Value& now) {
    if (!std::exchange(open_, false)) return now;
    return before_;
  }

  bool canUndo() const { return !undo_.empty(); }
  bool canRedo() const { return !redo_.empty(); }
  std::string undoWords() const { return undo_.empty() ? std::string() : undo_.back().words; }
  std::string redoWords() const { return redo_.empty() ? std::string() : redo_.back().words; }

  Value undo(const Value& now) { return swap(undo_, redo_, now); }
  Value redo(const Value& now) { return swap(redo_, undo_, now); }

 private:
  struct Step {
    Value value;
    std::string words;
  };

  Value swap(std::deque<Step>& from, std::deque<Step>& to, const Value& now) {
    open_ = false;
    if (from.empty()) return now;
    Step step = std::move(from.back());
    from.pop_back();
    to.push_back({now, std::move(step.words)});
    return std::move(step.value);
  }

  std::deque<Step> undo_;
  std::deque<Step> redo_;
  Value before_{};
  bool open_ = false;
};

}  // namespace palpate::viewer
