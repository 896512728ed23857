#include "view/viewer/leaving.h"

#include <fmt/format.h>

#include "palpate/trace/forces_table.h"
#include "palpate/trace/session_reader.h"

namespace palpate::viewer {

namespace {

/// A recorded table is looked at in the scene that there is.
bool leavesTheScene(const Wish& wish) {
  switch (wish.kind) {
    case Wish::Kind::open:
      return !isPhotograph(wish.file) && !trace::isForcesTable(wish.file) && !trace::isSession(wish.file);
    case Wish::Kind::default_scene:
    case Wish::Kind::reload:
    case Wish::Kind::quit:
      return true;
    default:
      return false;
  }
}

/// What was corrected in photographs stays while the view is closed, but goes with them.
bool leavesThePhotographs(const Wish& wish) {
  switch (wish.kind) {
    case Wish::Kind::open:
      return isPhotograph(wish.file);
    case Wish::Kind::measure_before:
    case Wish::Kind::measure_after:
    case Wish::Kind::swap_photos:
    case Wish::Kind::quit:
      return true;
    default:
      return false;
  }
}

std::string nameOf(const Session& session) {
  return session.document.file.empty() ? session.world.name : session.document.file.filename().string();
}

}  // namespace

bool mustAskFirst(const Wish& wish, Session& session) {
  if (!wish.sure && session.measuring.unsaved && leavesThePhotographs(wish)) {
    session.ask({.kind = Question::Kind::unmeasure,
                 .words = "The dots of the photographs were corrected. Accept the measurement first?",
                 .then = wish});
    return true;
  }
  if (wish.sure || !leavesTheScene(wish) || !session.history.changed()) return false;
  session.ask({.kind = Question::Kind::leave,
               .words = fmt::format("{} was changed. Save it first?", nameOf(session)),
               .then = wish});
  return true;
}

std::string_view answerOf(window::Key key, const Session& session) {
  if (!session.question) return {};
  const auto answers = answersTo(*session.question);
  if (key == window::Key::enter || key == window::Key::pad_enter) return answers.front();
  return key == window::Key::escape ? answers.back() : std::string_view();
}

std::string titleOf(const Session& session) {
  return fmt::format("{}{} - Palpate", nameOf(session), session.history.changed() ? " *" : "");
}

}  // namespace palpate::viewer
