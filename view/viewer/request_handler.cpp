#include "view/viewer/request_handler.h"

#include "palpate/trace/forces_table.h"
#include "palpate/trace/session_reader.h"
#include "view/viewer/files/scene_snippet.h"
#include "view/viewer/files/view_text.h"
#include "view/viewer/leaving.h"

namespace palpate::viewer {

void RequestHandler::handle(const Request& request) {
  if (parts_.modes.handle(request, parts_.session) || mustAskFirst(request, parts_.session)) return;
  std::visit([this](const auto& allowed) { fulfil(allowed); }, request);
}

// ---- the scene

void RequestHandler::fulfil(const OpenFile& request) {
  Session& session = parts_.session;
  const bool recorded = trace::isForcesTable(request.file) || trace::isSession(request.file);
  if (!recorded) return parts_.world_swap.open(request.file, session);
  parts_.replay.load(request.file, session.replay.chooses_beside, parts_.world, session);
}

void RequestHandler::fulfil(const OpenBuiltIn& /*request*/) {
  parts_.world_swap.open(parts_.default_scene, parts_.session);
}

/// The scene's file, else the mesh's, else the built-in torso.
void RequestHandler::fulfil(const Reload& /*request*/) {
  Session& session = parts_.session;
  const scene::BodySettings& body = session.scene.body;
  if (!session.document.file.empty()) return parts_.world_swap.open(session.document.file.string(), session);
  if (body.kind == scene::BodyKind::mesh) return parts_.world_swap.open(body.file.string(), session);
  parts_.world_swap.open(parts_.default_scene, session);
}

void RequestHandler::fulfil(const CancelBuild& /*request*/) { parts_.world_swap.cancel(parts_.session); }

void RequestHandler::fulfil(const SaveScene& request) { saveThen(request, std::nullopt); }

void RequestHandler::saveThen(const SaveScene& request, const std::optional<Request>& then) {
  Session& session = parts_.session;
  const Outputs::Saving saving = parts_.outputs.saveScene(session, request);
  if (saving == Outputs::Saving::asked) session.question->then = then;
  if (saving == Outputs::Saving::done && then) handle(madeSure(*then));
}

void RequestHandler::fulfil(const CopyScene& /*request*/) {
  Session& session = parts_.session;
  if (!parts_.host.set_clipboard) return session.report(Severity::warning, "There is no clipboard");
  parts_.host.set_clipboard(sceneSnippet(session));
  session.report(Severity::info, "What is seen and felt is on the clipboard, as a scene");
}

void RequestHandler::fulfil(const ResetScene& /*request*/) { parts_.session.history.reset(parts_.session); }
void RequestHandler::fulfil(const Undo& /*request*/) { parts_.session.history.undo(parts_.session); }
void RequestHandler::fulfil(const Redo& /*request*/) { parts_.session.history.redo(parts_.session); }
void RequestHandler::fulfil(const UseProfile& /*request*/) { parts_.outputs.useProfile(parts_.session); }

/// What waited for the answer is done, unless the saving failed or has to ask something itself.
void RequestHandler::fulfil(const AnswerQuestion& request) {
  Session& session = parts_.session;
  if (!session.question) return;
  const Question question = *std::exchange(session.question, std::nullopt);
  const std::string& chosen = request.answer;
  if (question.kind == Question::Kind::of_mode) return parts_.modes.answer(question, chosen, session);
  if (chosen == question.answers.back()) return;
  if (question.kind == Question::Kind::overwrite) return saveThen({question.file, true}, question.then);
  if (chosen == question.answers.front()) return saveThen({}, question.then);
  if (question.then) handle(madeSure(*question.then));
}

// ---- pictures and recordings

void RequestHandler::fulfil(const TakeScreenshot& request) { parts_.outputs.askForScreenshot(request.with_pop_ups); }
void RequestHandler::fulfil(const TakeClearScreenshot& /*request*/) { parts_.outputs.askForClearPicture(); }
void RequestHandler::fulfil(const ToggleSequence& /*request*/) { parts_.outputs.toggleSequence(parts_.session); }

void RequestHandler::fulfil(const OpenBeside& request) {
  parts_.replay.load(request.file, true, parts_.world, parts_.session);
}

void RequestHandler::fulfil(const PlayScript& /*request*/) { parts_.replay.playScript(parts_.world, parts_.session); }
void RequestHandler::fulfil(const SavePlots& /*request*/) { parts_.outputs.savePlots(parts_.session); }
void RequestHandler::fulfil(const ToggleForces& /*request*/) { parts_.outputs.toggleForces(parts_.session); }

void RequestHandler::fulfil(const KeepRecording& /*request*/) {
  parts_.keeper.keep(parts_.session, parts_.outputs.folder());
}

void RequestHandler::fulfil(const SetMark& request) { parts_.keeper.mark(parts_.session, request.words); }

// ---- the window

void RequestHandler::fulfil(const GoHome& /*request*/) { parts_.camera.setView(view::StandardView::back); }

void RequestHandler::fulfil(const ToggleFullScreen& /*request*/) {
  if (parts_.host.toggle_full_screen) parts_.host.toggle_full_screen();
}

void RequestHandler::fulfil(const CopyView& /*request*/) {
  if (parts_.host.set_clipboard) parts_.host.set_clipboard(viewAsText(parts_.session.camera));
}

void RequestHandler::fulfil(const PasteView& /*request*/) {
  if (const auto camera = viewFromText(parts_.host.clipboard ? parts_.host.clipboard() : "")) {
    parts_.camera.flyTo(*camera);
  } else {
    parts_.session.report(Severity::warning, "The clipboard holds no view");
  }
}

void RequestHandler::fulfil(const Quit& /*request*/) { quits_ = true; }

// ---- devices

void RequestHandler::fulfil(const OpenDevice& request) {
  parts_.devices.open(request.finger, request.words, parts_.session);
}

void RequestHandler::fulfil(const CloseDevice& request) { parts_.devices.close(request.finger, parts_.session); }
void RequestHandler::fulfil(const FindDevices& /*request*/) { parts_.devices.lookForBackEnds(parts_.session); }
void RequestHandler::fulfil(const StopDevices& /*request*/) { parts_.devices.stop(parts_.session); }
void RequestHandler::fulfil(const ReleaseStop& /*request*/) { parts_.devices.release(parts_.session); }

}  // namespace palpate::viewer
