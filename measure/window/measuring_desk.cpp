#include "measure/window/measuring_desk.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "measure/window/key_table_file.h"
#include "palpate/base/error.h"
#include "palpate/base/output_file.h"
#include "palpate/base/text.h"
#include "palpate/body/places.h"
#include "palpate/measure/key_row.h"

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
      const body::NamedPlace place = body::placeNamed(landmarks, form.place);
      form.at_mm = Vec2(place.point.x(), place.point.y());
      form.place_name = place.name;
    } catch (const Error& error) {
      form.place_words = error.what();
      return;
    }
  }
  form.place_words = fmt::format("{}{}x {:.0f}, y {:.0f} mm", form.place_name, form.place_name.empty() ? "" : ": ",
                                 form.at_mm->x(), form.at_mm->y());
}

fs::path tableOf(const Session& session) {
  return (session.output_folder / session.measuring.form.table).lexically_normal();
}

/// What speaks against it, a sentence each.
std::string doubts(const Session& session, const KeyTableFile& table, const fs::path& file, const std::string& name) {
  std::string words;
  for (const measure::Finding& finding : session.measuring.measured->findings) {
    if (finding.severity == measure::Severity::refusal) words += fmt::format("Refused: {}\n", finding.text);
  }
  if (table.kind == KeyTableFile::Kind::other) {
    words += fmt::format("{} is no table of key points and would be written over.\n", file.string());
  } else if (table.has(name)) {
    words += fmt::format("{} has a row \"{}\" already: it would be replaced.\n", file.string(), name);
  }
  return words;
}

KeyTableRow rowOf(const measure::Measurement& measured, const std::string& name, const Vec2& at_mm) {
  const std::string header = measure::keyRowHeader();
  const std::string values = measure::keyRow(measured, name, at_mm);
  return {std::string(trimmed(header)), std::string(trimmed(values))};
}

void useInScene(Session& session, const fs::path& file) {
  session.scene.ellipses.key_points = file;
  session.asks.changed |= kMapChange;
  session.asks.step = "measured key points";
}

}  // namespace

bool MeasuringDesk::grant(const Wish& wish, Session& session) {
  MeasuringView& view = session.measuring;
  switch (wish.kind) {
    case Wish::Kind::measure_before:
    case Wish::Kind::measure_after:
      choosePhoto(view, wish.kind == Wish::Kind::measure_before ? Photo::before : Photo::after, wish.file);
      break;
    case Wish::Kind::swap_photos:
      swapPhotos(view);
      std::swap(pictures_[0], pictures_[1]);
      break;
    case Wish::Kind::accept_measurement:
      accept(session, wish.sure);
      return true;
    case Wish::Kind::cancel_measuring:
      work_.cancel();
      return true;
    default:
      return false;
  }
  view.open = true;
  return true;
}

void MeasuringDesk::advance(Session& session, std::span<const body::SkinLandmark> landmarks) {
  MeasuringView& view = session.measuring;
  if (view.open && view.form.table.empty()) {
    const fs::path& of_scene = session.scene.ellipses.key_points;
    view.form.table = of_scene.empty() ? "key_points.csv" : fs::absolute(of_scene).string();
  }
  begin(view);
  take(session);
  view.working = work_.busy();
  const MeasuringWork::State state = work_.state();
  view.stage = state.stage;
  view.done = state.done;
  if (view.open) resolvePlace(view.form, landmarks);
}

/// What is stale goes to work; marks not before the mouse has let them go.
void MeasuringDesk::begin(MeasuringView& view) {
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
  work_.wish(std::move(job));
}

void MeasuringDesk::take(Session& session) {
  auto result = work_.take();
  if (!result) return;
  MeasuringView& view = session.measuring;
  for (std::size_t i = 0; i < view.photos.size(); ++i) {
    const std::optional<ReadPhoto>& read = result->photos[i];
    if (!read) continue;
    pictures_[i].emplace(read->image);
    view.photos[i] = {read->file, read->width_px, read->height_px, read->notes, pictures_[i]->texture()};
  }
  of_photographs_ = std::move(result->of_photographs_alone);
  if (result->measured) takeMeasured(view, result->measured, std::move(result->overlay), result->of_photographs);
  if (result->errors.empty()) return;
  view.failure = result->errors.front();
  for (std::string& error : result->errors) session.report(Severity::error, std::move(error));
}

MeasuringDesk::Accepting MeasuringDesk::accept(Session& session, bool sure) {
  MeasuringView& view = session.measuring;
  if (const std::string obstacle = obstacleToAccept(view); !obstacle.empty()) {
    session.report(Severity::warning, obstacle);
    return Accepting::failed;
  }
  const std::string name = acceptedName(view.form);
  const fs::path file = tableOf(session);
  const KeyTableFile table = readKeyTable(file);
  if (const std::string against = doubts(session, table, file, name); !sure && !against.empty()) {
    session.ask({.kind = Question::Kind::accept,
                 .words = against + "Accept all the same?",
                 .then = Wish{.kind = Wish::Kind::accept_measurement, .sure = true}});
    return Accepting::asked;
  }
  try {
    writeFile(file, tableWith(table, rowOf(*view.measured, name, *view.form.at_mm)));
  } catch (const std::exception& error) {
    session.report(Severity::error, error.what());
    return Accepting::failed;
  }
  view.unsaved = false;
  if (view.form.use_in_scene) useInScene(session, file);
  session.report(Severity::info, fmt::format("{} is in {}{}", name, file.string(),
                                             view.form.use_in_scene ? "; the skin follows it" : ""));
  return Accepting::done;
}

}  // namespace palpate::viewer
