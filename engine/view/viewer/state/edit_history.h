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
  /// Adds a finished step with the value before it and its name: "move dysfunction 2".
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
  std::string undoLabel() const { return undo_.empty() ? std::string() : undo_.back().words; }
  std::string redoLabel() const { return redo_.empty() ? std::string() : redo_.back().words; }

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

struct BodyView;
struct Conversation;
struct EditedScene;
struct UiOutput;

/// Everything that can be undone.
struct SessionSnapshot {
  scene::Scene scene = {};
  ViewState state = {};
  std::vector<tissue::ProfileKnot> drawn = {};  ///< the user's own profile
  scene::Scene document = {};                   ///< the scene with its look: sceneAsChanged
  // Compared in each quiet frame: the document, and state that it does not contain.
  std::string document_text = {};
  std::string habits = {};
};

/// Activity in this frame.
struct Stir {
  bool widget = false;  ///< a control is held
  bool hand = false;    ///< something is being moved on the body
  bool any = true;      ///< anything that could cause a change
};

/// Every change by whatever control, gesture or key as a step that can be undone, and whether there is something to
/// save. It compares the viewer's state once a frame instead of relying on each control: a new control needs nothing
/// here.
///
///   viewer state ─ as text ─ differs from the last quiet frame ─► step       undo, redo, reset ─► state,
///   UiOutput::changed
class ChangeHistory {
 public:
  /// Call for a newly opened scene: nothing to undo and nothing to save.
  void begin(const EditedScene& edited, const BodyView& seen);
  /// Once a frame. Holding a control is one step however long it is dragged.
  void follow(const EditedScene& edited, const BodyView& seen, const Stir& stir, UiOutput& output);
  /// Call when the present state equals the file.
  void saved(const EditedScene& edited, const BodyView& seen);

  void undo(EditedScene& edited, BodyView& seen, Conversation& user);
  void redo(EditedScene& edited, BodyView& seen, Conversation& user);
  /// Restores the opened or saved state; a step like others.
  void reset(EditedScene& edited, BodyView& seen, Conversation& user);

  bool changed() const { return now_.document_text != saved_.document_text; }
  /// Whether body, tissue or fingers changed. A changed look is saved with them, but is not worth a question on
  /// leaving.
  bool sceneChanged() const;
  const EditHistory<SessionSnapshot>& steps() const { return steps_; }

 private:
  void settle(const EditedScene& edited, const BodyView& seen);
  void restore(SessionSnapshot to, EditedScene& edited, BodyView& seen, UiOutput& output);

  SessionSnapshot now_;  ///< in the last quiet frame
  SessionSnapshot saved_;
  EditHistory<SessionSnapshot> steps_;
  bool by_widget_ = false;
  std::string words_;  ///< name of the current change (UiOutput::step)
};

}  // namespace palpate::viewer
