// Undo and redo of whole values.
#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <utility>

namespace palpate::viewer {

inline constexpr std::size_t kUndoSteps = 100;

template <class Value>
class EditHistory {
 public:
  /// A step has been done that began with this value; `words` name it: "move dysfunction 2".
  void add(Value before, std::string words) {
    undo_.push_back({std::move(before), std::move(words)});
    if (undo_.size() > kUndoSteps) undo_.pop_front();
    redo_.clear();
  }
  void clear() {
    undo_.clear();
    redo_.clear();
  }

  bool canUndo() const { return !undo_.empty(); }
  bool canRedo() const { return !redo_.empty(); }
  std::string undoWords() const { return undo_.empty() ? std::string() : undo_.back().words; }
  std::string redoWords() const { return redo_.empty() ? std::string() : redo_.back().words; }

  /// The value from before the step; `now` is kept for redo. Without a step it is `now`.
  Value undo(Value now) { return swap(undo_, redo_, std::move(now)); }
  Value redo(Value now) { return swap(redo_, undo_, std::move(now)); }

 private:
  struct Step {
    Value value;
    std::string words;
  };

  Value swap(std::deque<Step>& from, std::deque<Step>& to, Value now) {
    if (from.empty()) return now;
    Step step = std::move(from.back());
    from.pop_back();
    to.push_back({std::move(now), std::move(step.words)});
    return std::move(step.value);
  }

  std::deque<Step> undo_;
  std::deque<Step> redo_;
};

}  // namespace palpate::viewer
