// Undo and redo: of whole values, and of every change in the window.
#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "palpate/scene/scene.h"
#include "palpate/tissue/profile_settings.h"
#include "view/viewer/state/view_state.h"

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

// Every change by whatever control, gesture or key as a step that can be taken back, and whether there is something to
// save. It looks at the viewer's state once a frame instead of being told by each control: a new control needs nothing
// here.
//
//   session ─ as text ─ differs from the last quiet frame ─► step        undo, redo, reset ─► session,
//   UiOutput::changed

struct ViewerState;

/// All that can be taken back.
struct SessionSnapshot {
  scene::Scene scene = {};
  ViewState state = {};
  std::vector<tissue::ProfileKnot> drawn = {};  ///< the user's own profile
  scene::Scene document = {};                   ///< the scene with its look: sceneAsChanged
  // What is compared in each quiet frame: the document, and what it does not say.
  std::string document_text = {};
  std::string habits = {};
};

/// What is going on in this frame.
struct Stir {
  bool widget = false;  ///< a control is held
  bool hand = false;    ///< something is being moved on the body
  bool any = true;      ///< anything has happened that could change anything
};

class ChangeHistory {
 public:
  /// A scene was opened: there is nothing to take back and nothing to save.
  void begin(const ViewerState& viewer);
  /// Once a frame. A control that is held is one step however long it is dragged.
  void follow(ViewerState& viewer, const Stir& stir);
  /// What there is now is what the file says.
  void saved(const ViewerState& viewer);

  void undo(ViewerState& viewer);
  void redo(ViewerState& viewer);
  /// As it was opened or saved; a step like others.
  void reset(ViewerState& viewer);

  bool changed() const { return now_.document_text != saved_.document_text; }
  /// Of the body, its tissue and fingers. A look alone is saved with them, but is not worth a question on leaving.
  bool sceneChanged() const;
  const EditHistory<SessionSnapshot>& steps() const { return steps_; }

 private:
  void settle(ViewerState& viewer);
  void restore(SessionSnapshot to, ViewerState& viewer);

  SessionSnapshot now_;  ///< of the last quiet frame
  SessionSnapshot saved_;
  EditHistory<SessionSnapshot> steps_;
  bool by_widget_ = false;
  std::string words_;  ///< of the change under way (UiOutput::step)
};

}  // namespace palpate::viewer
