#include "measure/window/measuring_mode.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "measure/window/key_table_file.h"
#include "measure/window/measuring_window.h"
#include "palpate/base/error.h"
#include "palpate/base/language.h"
#include "palpate/base/output_file.h"
#include "palpate/base/text.h"
#include "palpate/body/places.h"
#include "palpate/measure/key_row.h"
#include "palpate/view/overlays/place_words.h"

namespace palpate::viewer {

namespace {

namespace fs = std::filesystem;

/// "12.5, -40": places of a body without names.
std::optional<Vec2> twoNumbers(std::string_view words) {
  const auto parts = split(words, ',');
  if (parts.size() != 2) return std::nullopt;
  const auto x = parseNumber(trimmed(parts[0]));
  const auto y = parseNumber(trimmed(parts[1]));
  return x && y ? std::optional(Vec2(*x, *y)) : std::nullopt;
}

void resolvePlace(AcceptForm& form, std::span<const body::SkinLandmark> landmarks) {
  form.at_mm.reset();
  form.place_name.clear();
  form.place_words.clear();
  if (trimmed(form.place).empty()) return;
  form.at_mm = twoNumbers(form.place);
  if (!form.at_mm) {
    try {
      const body::NamedPlace place = body::placeNamed(landmarks, view::placeInEnglish(landmarks, form.place));
      form.at_mm = Vec2(place.point.x(), place.point.y());
      form.place_name = place.name;
    } catch (const Error& error) {
      form.place_words = error.what();
      return;
    }
  }
  form.place_words = fmt::format("{}{}x {:.0f}, y {:.0f} mm", view::placeInLanguage(form.place_name),
                                 form.place_name.empty() ? "" : ": ", form.at_mm->x(), form.at_mm->y());
}

/// Objections to accepting, one sentence each.
std::string doubts(const measure::Measurement& measured, const KeyTableFile& table, const fs::path& file,
                   const std::string& name) {
  std::string words;
  for (const measure::Finding& finding : measured.findings) {
    if (finding.severity == measure::Severity::refusal)
      words += fmt::format("{}: {}\n", tr("Refused"), findingText(finding));
  }
  if (table.kind == KeyTableFile::Kind::other) {
    words += trf("{} is not a table of key points and would be overwritten.", file.string()) + "\n";
  } else if (table.has(name)) {
    words += trf("{} already has a row \"{}\", which would be replaced.", file.string(), name) + "\n";
  }
  return words;
}

KeyTableRow makeKeyTableRow(const measure::Measurement& measured, const std::string& name, const Vec2& at_mm) {
  const std::string header = measure::keyRowHeader();
  const std::string values = measure::keyRow(measured, name, at_mm);
  return {std::string(trimmed(header)), std::string(trimmed(values))};
}

void useInScene(scene::Scene& scene, const fs::path& file, UiOutput& output) {
  scene.ellipses.key_points = file;
  output.changed |= kMapChange;
  output.step = tr("measured key points");
}

}  // namespace

bool MeasuringMode::handle(const window::InputEvent& event, ViewerState& viewer, bool typing) {
  const Shown& shown = viewer.state.shown;
  if (!view_.open || event.kind != window::InputEvent::Kind::key || !event.down) return false;
  if (typing || shown.help || shown.messages) return false;
  return measuringKey(view_, event.key, event.modifiers, requests_);
}

bool MeasuringMode::handle(const window::Command& command, ViewerState& viewer) {
  if (command.kind != window::Command::Kind::act) return false;
  if (command.action == window::Action::measure_person) {
    view_.open = !view_.open;
    return true;
  }
  const Shown& shown = viewer.state.shown;
  const bool covered = shown.help || shown.messages;
  if (command.action != window::Action::cancel || !view_.open || covered) return false;
  view_.open = false;
  return true;
}

std::optional<ModeMenuItem> MeasuringMode::menuItem() const {
  return ModeMenuItem{window::Action::measure_person, view_.open};
}

void MeasuringMode::draw(const FreeArea& area) { measuringWindow(view_, area, requests_); }

bool MeasuringMode::handle(const Request& request, ViewerState& viewer) {
  if (const auto* open = std::get_if<OpenFile>(&request)) {
    if (!isPhotograph(open->file)) return false;
    handle(ShowPhoto{freePlace(view_), open->file}, viewer);
    return true;
  }
  const bool undoes = std::holds_alternative<Undo>(request);
  if (undoes || std::holds_alternative<Redo>(request)) {
    if (view_.open) undoOrRedo(undoes, viewer);
    return view_.open;
  }
  const auto* quit = std::get_if<Quit>(&request);
  const auto* way = std::get_if<GiveWay>(&request);
  const bool closes = (quit != nullptr && !quit->sure) || (way != nullptr && !way->sure);
  return closes && asksFirst(request, viewer);
}

/// Corrections in photographs stay while the view is closed, but go with the photographs.
bool MeasuringMode::asksFirst(Waiting waiting, Conversation& user) {
  if (!view_.unsaved) return false;
  waiting_ = std::move(waiting);
  user.ask({.kind = Question::Kind::of_mode,
            .words = toTranslate("The dots of the photographs were corrected. Accept the measurement first?"),
            .answers = {toTranslate("Accept"), toTranslate("Discard"), toTranslate("Stay")}});
  return true;
}

bool MeasuringMode::answer(const Question& question, std::string_view chosen, ViewerState& viewer) {
  const std::optional<Waiting> waiting = std::exchange(waiting_, std::nullopt);
  if (!waiting) return false;
  if (chosen == question.answers.back()) return true;
  const auto* request = std::get_if<MeasuringRequest>(&*waiting);
  if (request != nullptr && std::holds_alternative<AcceptMeasurement>(*request)) {
    handle(*request, viewer);
    return true;
  }
  if (chosen == question.answers.front() && accept(viewer, false) != Accepting::done) return true;
  view_.unsaved = false;
  if (request != nullptr) {
    requests_.push_back(*request);
  } else {
    viewer.request(std::get<Request>(*waiting));  // the scene may have been changed, too
  }
  return true;
}

void MeasuringMode::handle(const MeasuringRequest& request, ViewerState& viewer) {
  if (std::holds_alternative<CancelMeasuring>(request)) return work_.cancel();
  if (const auto* accepted = std::get_if<AcceptMeasurement>(&request)) {
    accept(viewer, accepted->sure);
    return;
  }
  if (asksFirst(request, viewer)) return;
  if (const auto* photo = std::get_if<ShowPhoto>(&request)) {
    choosePhoto(view_, photo->place, photo->file);
  } else {
    swapPhotos(view_);
    std::swap(pictures_[0], pictures_[1]);
  }
  view_.open = true;
}

void MeasuringMode::undoOrRedo(bool undoes, Conversation& user) {
  const std::string words = undoes ? undoCorrection(view_) : redoCorrection(view_);
  const std::string nothing = tr(undoes ? "Nothing to undo" : "Nothing to redo");
  const std::string done = undoes ? trf("Undo: {}", words) : trf("Redo: {}", words);
  user.report(Severity::info, words.empty() ? nothing : done);
}

void MeasuringMode::advance(ViewerState& viewer, std::span<const body::SkinLandmark> landmarks) {
  for (const MeasuringRequest& request : std::exchange(requests_, {})) handle(request, viewer);
  if (view_.open && view_.form.table.empty()) {
    const fs::path& of_scene = viewer.scene.ellipses.key_points;
    view_.form.table = of_scene.empty() ? "key_points.csv" : fs::absolute(of_scene).string();
  }
  startMeasuring();
  collectResult(viewer);
  view_.working = work_.busy();
  const MeasuringWork::State state = work_.state();
  view_.stage = state.stage;
  view_.done = state.done;
  if (view_.open) resolvePlace(view_.form, landmarks);
}

/// Starts work on stale results, but not while the mouse still drags a mark.
void MeasuringMode::startMeasuring() {
  MeasuringView& view = view_;
  if (view.stale == Stale::nothing || (view.stale == Stale::marks && view.drag)) return;
  const bool of_marks = std::exchange(view.stale, Stale::nothing) == Stale::marks && view.measured;
  if (!of_marks && !view.failure.empty()) view.failure.clear();
  MeasuringJob job{.settings = view.settings};
  if (of_marks) {
    job.marks = view.marks;
    job.of_photographs = of_photographs_;
    job.width_px = view.photos[0].width_px;
    job.height_px = view.photos[0].height_px;
  } else {
    for (std::size_t i = 0; i < view.photos.size(); ++i) job.files[i] = view.photos[i].file;
    if (!job.ofPhotographs()) return;
  }
  work_.request(std::move(job));
}

void MeasuringMode::collectResult(Conversation& user) {
  auto result = work_.collectResult();
  if (!result) return;
  MeasuringView& view = view_;
  for (std::size_t i = 0; i < view.photos.size(); ++i) {
    const std::optional<ReadPhoto>& read = result->photos[i];
    if (!read) continue;
    pictures_[i].emplace(read->image);
    view.photos[i] = {read->file, read->width_px, read->height_px, read->notes, pictures_[i]->texture()};
  }
  of_photographs_ = std::move(result->of_photographs_alone);
  if (result->measured) acceptMeasurement(view, result->measured, std::move(result->overlay), result->of_photographs);
  if (result->errors.empty()) return;
  view.failure = result->errors.front();
  for (const std::string& error : result->errors) user.report(Severity::error, error);
}

MeasuringMode::Accepting MeasuringMode::accept(ViewerState& viewer, bool sure) {
  MeasuringView& view = view_;
  if (const std::string obstacle = obstacleToAccept(view); !obstacle.empty()) {
    viewer.report(Severity::warning, obstacle);
    return Accepting::failed;
  }
  const std::string name = acceptedName(view.form);
  const fs::path file = (viewer.output_folder / view.form.table).lexically_normal();
  const KeyTableFile table = readKeyTable(file);
  if (const std::string against = doubts(*view.measured, table, file, name); !sure && !against.empty()) {
    waiting_ = MeasuringRequest(AcceptMeasurement{.sure = true});
    viewer.ask(
        {.kind = Question::Kind::of_mode, .words = against + tr("Accept anyway?"), .answers = {"Accept", "Cancel"}});
    return Accepting::asked;
  }
  try {
    writeFile(file, tableWith(table, makeKeyTableRow(*view.measured, name, *view.form.at_mm)));
  } catch (const std::exception& error) {
    viewer.report(Severity::error, error.what());
    return Accepting::failed;
  }
  view.unsaved = false;
  viewer.messages.clearErrors(file.string());
  if (view.form.use_in_scene) useInScene(viewer.scene, file, viewer.output);
  viewer.report(Severity::info, view.form.use_in_scene
                                    ? trf("Row added: {} is in {}; the skin follows it", name, file.string())
                                    : trf("Row added: {} is in {}", name, file.string()));
  return Accepting::done;
}

}  // namespace palpate::viewer
