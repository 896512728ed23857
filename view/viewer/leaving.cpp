#include "view/viewer/leaving.h"

#include <fmt/format.h>

#include "palpate/trace/forces_table.h"
#include "palpate/trace/session_reader.h"

namespace palpate::viewer {

namespace {

struct LeavesTheScene {
  /// A recording is looked at in the scene that there is.
  bool operator()(const OpenFile& request) const {
    return !request.sure && !trace::isForcesTable(request.file) && !trace::isSession(request.file);
  }
  bool operator()(const OpenBuiltIn& request) const { return !request.sure; }
  bool operator()(const Reload& request) const { return !request.sure; }
  bool operator()(const Quit& request) const { return !request.sure; }
  template <class Other>
  bool operator()(const Other& /*request*/) const {
    return false;
  }
};

std::string nameOf(const Session& session) {
  return session.document.file.empty() ? session.world.name : session.document.file.filename().string();
}

}  // namespace

bool mustAskFirst(const Request& request, Session& session) {
  if (!std::visit(LeavesTheScene(), request) || !session.history.changed()) return false;
  session.ask({.kind = Question::Kind::leave,
               .words = fmt::format("{} was changed. Save it first?", nameOf(session)),
               .then = request});
  return true;
}

std::string_view answerOf(window::Key key, const Session& session) {
  if (!session.question) return {};
  const std::vector<std::string>& answers = session.question->answers;
  if (key == window::Key::enter || key == window::Key::pad_enter) return answers.front();
  return key == window::Key::escape ? answers.back() : std::string_view();
}

std::string titleOf(const Session& session) {
  return fmt::format("{}{} - Palpate", nameOf(session), session.history.changed() ? " *" : "");
}

}  // namespace palpate::viewer
