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
#include "view/viewer/files/file_preview.h"
#include "view/viewer/files/scene_snippet.h"
#include "view/viewer/files/turned_mesh.h"
#include "view/viewer/state/async_task.h"

namespace palpate::viewer {

class RequestHandler::Impl {
 public:
  explicit Impl(const RequestParts& parts)
      : parts_(parts), edited_(parts.viewer), seen_(parts.viewer), past_(parts.viewer), user_(parts.viewer) {}
  bool quits() const { return quits_; }

  void handle(const Request& request) {
    if (parts_.modes.handle(request, parts_.viewer) || needsConfirmation(request, edited_, user_)) return;
    std::visit([this](const auto& allowed) { handle(allowed); }, request);
  }

  // ---- the scene

  void handle(const OpenFile& request) {
    const bool recorded = trace::isForcesTable(pathOf(request.file)) || trace::isRecording(pathOf(request.file));
    if (recorded) return parts_.replay.load(request.file, past_.replay.chooses_beside, parts_.world, edited_.scene);
    if (request.unit || !hasNoUnit(pathOf(request.file))) {
      return parts_.world_swap.open(request.file, edited_, request.unit.value_or(scene::Unit::from_file));
    }
    to_measure_ = request;  // the newest one wins
  }

  /// Measures the file on its own thread: a body of 1.8 mm is one of 1.8 m. A slow or broken file is opened without a
  /// question, and shows its own error.
  void advance() {
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
  void checkOrientation() {
    const std::shared_ptr<const scene::Body>& body = parts_.world->body;
    const bool is_file = parts_.world->scene.body.kind == scene::BodyKind::mesh;
    if (const auto turned = turning_.collectResult()) {
      if (!turned->value) return user_.report(Severity::error, turned->error);
      edited_.scene.body.file = *turned->value;
      edited_.scene.body.unit = scene::Unit::millimetre;
      edited_.scene.body.group.clear();
      user_.output.changed |= kBodyChange;
      user_.report(Severity::info, trf("Turned over: {}", turned->value->string()));
    }
    if (const auto doubt = sides_.collectResult()) {
      turn_over_ = doubt->value.value_or(mesh::TurnOver::none);
      if (turn_over_ != mesh::TurnOver::none && !user_.question) {
        user_.ask({.kind = Question::Kind::turn,
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
    const bool bare = edited_.document.file.empty();
    sides_.start([body, bare] {
      const mesh::TurnOver doubt = doubtfulSides(body->skin, Vec3::UnitZ());
      return bare || doubt != mesh::TurnOver::open ? doubt : mesh::TurnOver::none;
    });
  }

  /// Asks where millimetres are doubtful.
  void askForUnit(OpenFile request, const std::optional<double>& longest_units) {
    const std::optional<UnitGuess> guess = longest_units ? unitGuess(*longest_units) : std::nullopt;
    request.sure = true;
    request.unit = guess ? guess->unit : scene::Unit::from_file;
    if (!guess) return handle(request);
    user_.ask({.kind = Question::Kind::unit,
               .words = guess->words,
               .answers = {guess->answer, toTranslate("Millimetres"), toTranslate("Cancel")},
               .then = request});
  }

  void handle(const OpenPreset& request) {
    parts_.world_swap.open(scene::presetScene(request.name), edited_);
    edited_.document.title = scene::presetNamed(request.name).title;
  }

  /// The scene's file, else the mesh's, else the built-in body.
  void handle(const Reload& /*request*/) {
    const scene::BodySettings& body = edited_.scene.body;
    if (!edited_.document.file.empty()) return parts_.world_swap.open(edited_.document.file.string(), edited_);
    if (body.kind == scene::BodyKind::mesh && !scene::isMadeScan(body))
      return parts_.world_swap.open(body.file.string(), edited_, body.unit);
    parts_.world_swap.open(parts_.default_scene, edited_);
  }

  /// Cancels the work that is shown as in progress (Viewer::useChanges).
  void handle(const CancelBuild& /*request*/) {
    parts_.replay.progress() ? parts_.replay.cancel() : parts_.world_swap.cancel(edited_, user_);
  }

  void handle(const SaveScene& request) { saveThen(request, std::nullopt); }

  void saveThen(const SaveScene& request, const std::optional<Request>& then) {
    const Outputs::Saving saving = parts_.outputs.saveScene(request, edited_, seen_);
    if (saving == Outputs::Saving::asked) user_.question->then = then;
    if (saving == Outputs::Saving::done && then) handle(asConfirmed(*then));
  }

  void handle(const CopyScene& /*request*/) {
    if (!parts_.host.set_clipboard) return user_.report(Severity::warning, "No clipboard is available");
    parts_.host.set_clipboard(sceneSnippet(edited_, seen_));
    user_.report(Severity::info, "Scene copied to the clipboard");
  }

  void handle(const ResetScene& /*request*/) { edited_.history.reset(edited_, seen_, user_); }
  void handle(const Undo& /*request*/) { edited_.history.undo(edited_, seen_, user_); }
  void handle(const Redo& /*request*/) { edited_.history.redo(edited_, seen_, user_); }
  void handle(const UseProfile& /*request*/) { parts_.outputs.useProfile(edited_); }

  /// Continues the request that waited for the answer, unless the saving failed or has a question of its own.
  void handle(const AnswerQuestion& request) {
    if (!user_.question) return;
    const Question question = *std::exchange(user_.question, std::nullopt);
    const std::string& chosen = request.answer;
    if (question.kind == Question::Kind::of_mode) return parts_.modes.answer(question, chosen, parts_.viewer);
    if (chosen == question.answers.back()) return;
    if (question.kind == Question::Kind::turn) {
      turning_.start([body = edited_.scene.body, turn_over = turn_over_, folder = parts_.outputs.folder()] {
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
      if (chosen != question.answers.front()) parts_.devices.openAsked();
      return;
    }
    if (question.kind == Question::Kind::end_class) {
      parts_.class_run.end(user_.class_shown);
      return handle(*question.then);
    }
    if (question.kind == Question::Kind::overwrite) return saveThen({question.file, true}, question.then);
    if (chosen == question.answers.front()) return saveThen({}, question.then);
    if (question.then) handle(asConfirmed(*question.then));
  }

  // ---- pictures and recordings

  void handle(const TakeScreenshot& request) { parts_.outputs.askForScreenshot(request); }
  void handle(const TakeClearScreenshot& /*request*/) { parts_.outputs.askForClearPicture(); }
  void handle(const ToggleSequence& /*request*/) { parts_.outputs.toggleSequence(); }
  void handle(const StartFilm& request) { parts_.outputs.startFilm(request.file); }
  void handle(const StopFilm& /*request*/) { parts_.outputs.stopFilm(); }

  void handle(const OpenBeside& request) { parts_.replay.load(request.file, true, parts_.world, edited_.scene); }

  void handle(const PlayScript& /*request*/) { parts_.replay.playScript(parts_.world); }
  void handle(const SavePlots& /*request*/) { parts_.outputs.savePlots(past_.plots); }
  void handle(const ToggleForces& /*request*/) { parts_.outputs.toggleForces(parts_.viewer.ticks_per_s); }

  void handle(const KeepRecording& /*request*/) { parts_.keeper.save(parts_.outputs.folder()); }

  void handle(const SetMark& request) { parts_.keeper.mark(request.words); }

  // ---- the window

  void handle(const GoHome& /*request*/) { parts_.camera.setView(view::StandardView::back); }

  void handle(const SetView& request) { parts_.camera.setView(request.side); }

  void handle(const GoToPlace& request) {
    try {
      const body::NamedPlace place =
          body::placeNamed(edited_.world.landmarks, view::placeInEnglish(edited_.world.landmarks, request.words));
      const bool waits = parts_.camera.flyToPlace(place.point);
      const std::string name = view::placeInLanguage(place.name);
      user_.report(Severity::info, waits ? trf("At {}. Enter presses the finger there", name) : name);
    } catch (const Error& error) {
      user_.report(Severity::warning, error.what());
    }
  }

  void handle(const ToggleFullScreen& /*request*/) {
    if (parts_.host.toggle_full_screen) parts_.host.toggle_full_screen();
  }

  void handle(const CopyView& /*request*/) {
    if (parts_.host.set_clipboard) parts_.host.set_clipboard(viewAsText(seen_.camera));
  }

  void handle(const PasteView& /*request*/) {
    if (const auto camera = viewFromText(parts_.host.clipboard ? parts_.host.clipboard() : "")) {
      parts_.camera.flyTo(*camera);
    } else {
      user_.report(Severity::warning, "The clipboard holds no view");
    }
  }

  void handle(const Quit& /*request*/) { quits_ = true; }

  void handle(const GiveWay& request) {
    if (!parts_.host.give_way) return;
    parts_.host.give_way(request.activity);
    quits_ = true;
  }

  // ---- a class

  void handle(const ShowClass& /*request*/) { seen_.state.shown.class_dialog = true; }
  void handle(const StartClass& request) { parts_.class_run.start(request, user_.class_shown); }
  void handle(const WatchClass& request) { parts_.class_run.watch(request.folder, user_.class_shown); }
  void handle(const JoinClass& request) { parts_.class_run.join(request.folder, user_.class_shown); }
  void handle(const EndClass& /*request*/) { parts_.class_run.end(user_.class_shown); }

  // ---- devices

  void handle(const OpenDevice& request) { parts_.devices.open(request.finger, request.words); }

  void handle(const CloseDevice& request) { parts_.devices.close(request.finger); }
  void handle(const FindDevices& /*request*/) { parts_.devices.lookForBackEnds(); }
  void handle(const StopDevices& /*request*/) { parts_.devices.stop(); }
  void handle(const ReleaseStop& /*request*/) { parts_.devices.release(); }

 private:
  RequestParts parts_;
  EditedScene& edited_;
  BodyView& seen_;
  PastTouches& past_;
  Conversation& user_;
  bool quits_ = false;
  std::optional<OpenFile> to_measure_;  ///< a mesh of unknown unit
  OpenFile measured_;
  AsyncTask<FilePreview> look_;
  const scene::Body* looked_at_body_ = nullptr;  ///< the question about its side was asked; only compared
  AsyncTask<mesh::TurnOver> sides_;
  mesh::TurnOver turn_over_ = mesh::TurnOver::none;  ///< if the answer is yes
  AsyncTask<std::filesystem::path> turning_;
};

RequestHandler::RequestHandler(const RequestParts& parts) : impl_(std::make_unique<Impl>(parts)) {}
RequestHandler::~RequestHandler() = default;
void RequestHandler::handle(const Request& request) { impl_->handle(request); }
void RequestHandler::advance() { impl_->advance(); }
bool RequestHandler::quits() const { return impl_->quits(); }

}  // namespace palpate::viewer
