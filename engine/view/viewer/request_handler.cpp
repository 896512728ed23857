#include "view/viewer/request_handler.h"

#include <fmt/format.h>

#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/language.h"
#include "palpate/base/path_text.h"
#include "palpate/body/places.h"
#include "palpate/scene/body_parts.h"
#include "palpate/scene/presets.h"
#include "palpate/trace/forces_table.h"
#include "palpate/trace/recording_reader.h"
#include "palpate/view/overlays/place_words.h"
#include "view/viewer/files/scene_snippet.h"

namespace palpate::viewer {

void RequestHandler::handle(const Request& request) {
  if (parts_.modes.handle(request, parts_.viewer) || needsConfirmation(request, parts_.viewer)) return;
  std::visit([this](const auto& allowed) { handle(allowed); }, request);
}

// ---- the scene

void RequestHandler::handle(const OpenFile& request) {
  ViewerState& viewer = parts_.viewer;
  const bool recorded = trace::isForcesTable(pathOf(request.file)) || trace::isRecording(pathOf(request.file));
  if (recorded) return parts_.replay.load(request.file, viewer.replay.chooses_beside, parts_.world, viewer);
  if (request.unit || !hasNoUnit(pathOf(request.file))) {
    return parts_.world_swap.open(request.file, viewer, request.unit.value_or(scene::Unit::from_file));
  }
  to_measure_ = request;  // the newest one wins
}

/// Measures the file on its own thread: a body of 1.8 mm is one of 1.8 m. A slow or broken file is opened without a
/// question, and shows its own error.
void RequestHandler::advance() {
  checkOrientation();
  static constexpr PreviewLimits kLook{
      .max_bytes = std::uint64_t{256} << 20, .max_seconds = 3.0, .width = 1, .height = 1};
  const auto seen = look_.collectResult();
  if (seen && !to_measure_) askForUnit(measured_, seen->value ? seen->value->longest_units : std::nullopt);
  if (!to_measure_ || look_.busy()) return;
  measured_ = *std::exchange(to_measure_, std::nullopt);
  look_.start([file = pathOf(measured_.file)] { return previewFile(file, kLook); });
}

/// Each mesh once, when it is loaded; on its own thread.
void RequestHandler::checkOrientation() {
  ViewerState& viewer = parts_.viewer;
  const std::shared_ptr<const scene::Body>& body = parts_.world->body;
  const bool is_file = parts_.world->scene.body.kind == scene::BodyKind::mesh;
  if (const auto turned = turning_.collectResult()) {
    if (!turned->value) return viewer.report(Severity::error, turned->error);
    viewer.scene.body.file = *turned->value;
    viewer.scene.body.unit = scene::Unit::millimetre;
    viewer.scene.body.group.clear();
    viewer.output.changed |= kBodyChange;
    viewer.report(Severity::info, trf("Turned over: {}", turned->value->string()));
  }
  if (const auto doubt = sides_.collectResult()) {
    turn_over_ = doubt->value.value_or(mesh::TurnOver::none);
    if (turn_over_ != mesh::TurnOver::none && !viewer.question) {
      viewer.ask({.kind = Question::Kind::turn,
                  .words = toTranslate("This body may be inside out: you see and feel its inner side. Turn it over?"),
                  .answers = {toTranslate("Turn it over"), toTranslate("Leave it")}});
    }
  }
  if (body.get() == looked_at_body_ || sides_.busy() || parts_.modes.claims().window) return;
  looked_at_body_ = body.get();
  if (!is_file || body->closed || scene::isMadeScan(parts_.world->scene.body)) return;
  const bool was_turned = parts_.world->scene.body.file.stem().string().ends_with("_turned");
  if (was_turned) return;
  // A scene may show any side on purpose; a bare mesh is shown from behind.
  const bool bare = viewer.document.file.empty();
  sides_.start([body, bare] {
    const mesh::TurnOver doubt = doubtfulSides(body->skin, Vec3::UnitZ());
    return bare || doubt != mesh::TurnOver::open ? doubt : mesh::TurnOver::none;
  });
}

/// Asks where millimetres are doubtful.
void RequestHandler::askForUnit(OpenFile request, const std::optional<double>& longest_units) {
  const std::optional<UnitGuess> guess = longest_units ? unitGuess(*longest_units) : std::nullopt;
  request.sure = true;
  request.unit = guess ? guess->unit : scene::Unit::from_file;
  if (!guess) return handle(request);
  parts_.viewer.ask({.kind = Question::Kind::unit,
                     .words = guess->words,
                     .answers = {guess->answer, toTranslate("Millimetres"), toTranslate("Cancel")},
                     .then = request});
}

void RequestHandler::handle(const OpenPreset& request) {
  parts_.world_swap.open(scene::presetScene(request.name), parts_.viewer);
  parts_.viewer.document.title = scene::presetNamed(request.name).title;
}

/// The scene's file, else the mesh's, else the built-in body.
void RequestHandler::handle(const Reload& /*request*/) {
  ViewerState& viewer = parts_.viewer;
  const scene::BodySettings& body = viewer.scene.body;
  if (!viewer.document.file.empty()) return parts_.world_swap.open(viewer.document.file.string(), viewer);
  if (body.kind == scene::BodyKind::mesh && !scene::isMadeScan(body))
    return parts_.world_swap.open(body.file.string(), viewer, body.unit);
  parts_.world_swap.open(parts_.default_scene, viewer);
}

/// Cancels the work that is shown as in progress (Viewer::useChanges).
void RequestHandler::handle(const CancelBuild& /*request*/) {
  parts_.replay.progress() ? parts_.replay.cancel(parts_.viewer) : parts_.world_swap.cancel(parts_.viewer);
}

void RequestHandler::handle(const SaveScene& request) { saveThen(request, std::nullopt); }

void RequestHandler::saveThen(const SaveScene& request, const std::optional<Request>& then) {
  ViewerState& viewer = parts_.viewer;
  const Outputs::Saving saving = parts_.outputs.saveScene(viewer, request);
  if (saving == Outputs::Saving::asked) viewer.question->then = then;
  if (saving == Outputs::Saving::done && then) handle(asConfirmed(*then));
}

void RequestHandler::handle(const CopyScene& /*request*/) {
  ViewerState& viewer = parts_.viewer;
  if (!parts_.host.set_clipboard) return viewer.report(Severity::warning, "No clipboard is available");
  parts_.host.set_clipboard(sceneSnippet(viewer));
  viewer.report(Severity::info, "Scene copied to the clipboard");
}

void RequestHandler::handle(const ResetScene& /*request*/) { parts_.viewer.history.reset(parts_.viewer); }
void RequestHandler::handle(const Undo& /*request*/) { parts_.viewer.history.undo(parts_.viewer); }
void RequestHandler::handle(const Redo& /*request*/) { parts_.viewer.history.redo(parts_.viewer); }
void RequestHandler::handle(const UseProfile& /*request*/) { parts_.outputs.useProfile(parts_.viewer); }

/// Continues the request that waited for the answer, unless the saving failed or has a question of its own.
void RequestHandler::handle(const AnswerQuestion& request) {
  ViewerState& viewer = parts_.viewer;
  if (!viewer.question) return;
  const Question question = *std::exchange(viewer.question, std::nullopt);
  const std::string& chosen = request.answer;
  if (question.kind == Question::Kind::of_mode) return parts_.modes.answer(question, chosen, viewer);
  if (chosen == question.answers.back()) return;
  if (question.kind == Question::Kind::turn) {
    turning_.start([body = viewer.scene.body, turn_over = turn_over_, folder = parts_.outputs.folder()] {
      return writeTurned(body, turn_over, folder);
    });
    return;
  }
  if (question.kind == Question::Kind::unit) {
    OpenFile opened = std::get<OpenFile>(*question.then);
    if (chosen != question.answers.front()) opened.unit = scene::Unit::millimetre;
    return handle(opened);
  }
  if (question.kind == Question::Kind::devices) {
    if (chosen != question.answers.front()) parts_.devices.openAsked(viewer);
    return;
  }
  if (question.kind == Question::Kind::end_class) {
    parts_.class_run.end(viewer.class_shown);
    return handle(*question.then);
  }
  if (question.kind == Question::Kind::overwrite) return saveThen({question.file, true}, question.then);
  if (chosen == question.answers.front()) return saveThen({}, question.then);
  if (question.then) handle(asConfirmed(*question.then));
}

// ---- pictures and recordings

void RequestHandler::handle(const TakeScreenshot& request) { parts_.outputs.askForScreenshot(request); }
void RequestHandler::handle(const TakeClearScreenshot& /*request*/) { parts_.outputs.askForClearPicture(); }
void RequestHandler::handle(const ToggleSequence& /*request*/) { parts_.outputs.toggleSequence(parts_.viewer); }
void RequestHandler::handle(const StartFilm& request) { parts_.outputs.startFilm(parts_.viewer, request.file); }
void RequestHandler::handle(const StopFilm& /*request*/) { parts_.outputs.stopFilm(parts_.viewer); }

void RequestHandler::handle(const OpenBeside& request) {
  parts_.replay.load(request.file, true, parts_.world, parts_.viewer);
}

void RequestHandler::handle(const PlayScript& /*request*/) { parts_.replay.playScript(parts_.world, parts_.viewer); }
void RequestHandler::handle(const SavePlots& /*request*/) { parts_.outputs.savePlots(parts_.viewer); }
void RequestHandler::handle(const ToggleForces& /*request*/) { parts_.outputs.toggleForces(parts_.viewer); }

void RequestHandler::handle(const KeepRecording& /*request*/) {
  parts_.keeper.save(parts_.viewer, parts_.outputs.folder());
}

void RequestHandler::handle(const SetMark& request) { parts_.keeper.mark(parts_.viewer, request.words); }

// ---- the window

void RequestHandler::handle(const GoHome& /*request*/) { parts_.camera.setView(view::StandardView::back); }

void RequestHandler::handle(const SetView& request) { parts_.camera.setView(request.side); }

void RequestHandler::handle(const GoToPlace& request) {
  ViewerState& viewer = parts_.viewer;
  try {
    const body::NamedPlace place =
        body::placeNamed(viewer.world.landmarks, view::placeInEnglish(viewer.world.landmarks, request.words));
    const bool waits = parts_.camera.flyToPlace(place.point);
    const std::string name = view::placeInLanguage(place.name);
    viewer.report(Severity::info, waits ? trf("At {}. Enter presses the finger there", name) : name);
  } catch (const Error& error) {
    viewer.report(Severity::warning, error.what());
  }
}

void RequestHandler::handle(const ToggleFullScreen& /*request*/) {
  if (parts_.host.toggle_full_screen) parts_.host.toggle_full_screen();
}

void RequestHandler::handle(const CopyView& /*request*/) {
  if (parts_.host.set_clipboard) parts_.host.set_clipboard(viewAsText(parts_.viewer.camera));
}

void RequestHandler::handle(const PasteView& /*request*/) {
  if (const auto camera = viewFromText(parts_.host.clipboard ? parts_.host.clipboard() : "")) {
    parts_.camera.flyTo(*camera);
  } else {
    parts_.viewer.report(Severity::warning, "The clipboard holds no view");
  }
}

void RequestHandler::handle(const Quit& /*request*/) { quits_ = true; }

void RequestHandler::handle(const GiveWay& request) {
  if (!parts_.host.give_way) return;
  parts_.host.give_way(request.activity);
  quits_ = true;
}

// ---- a class

void RequestHandler::handle(const ShowClass& /*request*/) { parts_.viewer.state.shown.class_dialog = true; }
void RequestHandler::handle(const StartClass& request) { parts_.class_run.start(request, parts_.viewer.class_shown); }
void RequestHandler::handle(const WatchClass& request) {
  parts_.class_run.watch(request.folder, parts_.viewer.class_shown);
}
void RequestHandler::handle(const JoinClass& request) {
  parts_.class_run.join(request.folder, parts_.viewer.class_shown);
}
void RequestHandler::handle(const EndClass& /*request*/) { parts_.class_run.end(parts_.viewer.class_shown); }

// ---- devices

void RequestHandler::handle(const OpenDevice& request) {
  parts_.devices.open(request.finger, request.words, parts_.viewer);
}

void RequestHandler::handle(const CloseDevice& request) { parts_.devices.close(request.finger, parts_.viewer); }
void RequestHandler::handle(const FindDevices& /*request*/) { parts_.devices.lookForBackEnds(parts_.viewer); }
void RequestHandler::handle(const StopDevices& /*request*/) { parts_.devices.stop(parts_.viewer); }
void RequestHandler::handle(const ReleaseStop& /*request*/) { parts_.devices.release(parts_.viewer); }

}  // namespace palpate::viewer
