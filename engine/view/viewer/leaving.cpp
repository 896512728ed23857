#include "palpate/base/language.h"
#include "palpate/base/path_text.h"
#include "view/viewer/request_handler.h"

#include <fmt/format.h>

#include "palpate/trace/forces_table.h"
#include "palpate/trace/recording_reader.h"

namespace palpate::viewer {

namespace {

struct LeavesTheScene {
  /// A recording is shown in the present scene.
  bool operator()(const OpenFile& request) const {
    return !request.sure && !trace::isForcesTable(pathOf(request.file)) && !trace::isRecording(pathOf(request.file));
  }
  bool operator()(const OpenPreset& request) const { return !request.sure; }
  bool operator()(const Reload& request) const { return !request.sure; }
  bool operator()(const Quit& request) const { return !request.sure; }
  bool operator()(const GiveWay& request) const { return !request.sure; }
  template <class Other>
  bool operator()(const Other& /*request*/) const {
    return false;
  }
};

std::string nameOf(const EditedScene& edited) {
  const SceneDocument& document = edited.document;
  if (!document.file.empty()) return document.file.filename().string();
  return document.title.empty() ? edited.world.name : tr(document.title.c_str());
}

}  // namespace

bool needsConfirmation(const Request& request, const EditedScene& edited, Conversation& user) {
  const bool closes = std::holds_alternative<Quit>(request) || std::holds_alternative<GiveWay>(request);
  if (closes && user.class_shown.anything()) {
    user.ask({.kind = Question::Kind::end_class,
              .words = toTranslate("The class ends with this window. What was collected is kept."),
              .answers = {toTranslate("End the class"), toTranslate("Stay")},
              .then = request});
    return true;
  }
  if (!std::visit(LeavesTheScene(), request) || !edited.history.sceneChanged()) return false;
  user.ask(
      {.kind = Question::Kind::leave, .words = trf("{} was changed. Save it first?", nameOf(edited)), .then = request});
  return true;
}

std::string_view answerForKey(window::Key key, const std::optional<Question>& question) {
  if (!question) return {};
  const std::vector<std::string>& answers = question->answers;
  if (key == window::Key::enter || key == window::Key::pad_enter) return answers.front();
  return key == window::Key::escape ? answers.back() : std::string_view();
}

std::string titleOf(const EditedScene& edited) {
  return fmt::format("{}{} - Palpate", nameOf(edited), edited.history.changed() ? " *" : "");
}

}  // namespace palpate::viewer
