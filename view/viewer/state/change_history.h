// Every change by whatever control, gesture or key as a step that can be taken back, and whether there is something to
// save. It looks at the session once a frame instead of being told by each control: a new control needs nothing here.
//
//   session ─ as text ─ differs from the last quiet frame ─► step        undo, redo, reset ─► session, Asks::changed
#pragma once

#include <string>
#include <vector>

#include "palpate/scene/scene.h"
#include "palpate/tissue/profile_settings.h"
#include "view/viewer/state/edit_history.h"
#include "view/viewer/state/view_state.h"

namespace palpate::viewer {

struct Session;

/// All that can be taken back.
struct SessionSnapshot {
  scene::Scene scene = {};
  ViewState state = {};
  std::vector<tissue::ProfileKnot> drawn = {};  ///< the user's own profile
  scene::Scene document = {};                   ///< the scene with its look: sceneAsChanged
  // What is compared: the document, and what it does not say.
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
  void begin(const Session& session);
  /// Once a frame. A control that is held is one step however long it is dragged.
  void follow(Session& session, const Stir& stir);
  /// What there is now is what the file says.
  void saved(const Session& session);

  void undo(Session& session);
  void redo(Session& session);
  /// As it was opened or saved; a step like others.
  void reset(Session& session);

  bool changed() const { return now_.document_text != saved_.document_text; }
  const EditHistory<SessionSnapshot>& steps() const { return steps_; }

 private:
  void settle(Session& session);
  void restore(SessionSnapshot to, Session& session);

  SessionSnapshot now_;  ///< of the last quiet frame
  SessionSnapshot saved_;
  EditHistory<SessionSnapshot> steps_;
  bool by_widget_ = false;
  std::string words_;  ///< of the change under way (Asks::step)
};

}  // namespace palpate::viewer
