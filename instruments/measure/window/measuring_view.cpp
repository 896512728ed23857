// Corrections by hand are snapshots of all marks: some hundred numbers a step. `stale`, checked once a frame, decides
// what is measured again.
#include "measure/window/measuring_view.h"

#include <algorithm>
#include <utility>

#include "palpate/base/language.h"
#include "palpate/base/text.h"
#include "palpate/measure/key_row.h"

namespace palpate::viewer {

namespace {

Corrections correctionsNow(const MeasuringView& view) { return {view.marks, view.settings.contact_px}; }

void measureAgain(MeasuringView& view) {
  view.corrected = view.unsaved = view.history.canUndo();
  view.stale = std::max(view.stale, Stale::marks);
}

void commitStep(MeasuringView& view, Corrections before, std::string words) {
  view.history.add(std::move(before), std::move(words));
  view.nudged.reset();
  measureAgain(view);
}

void restore(MeasuringView& view, Corrections to) {
  view.marks = std::move(to.marks);
  view.settings.contact_px = to.contact_px;
  view.selected.reset();
  view.drag.reset();
  view.nudged.reset();
  measureAgain(view);
}

/// The photograph that a tab shows alone.
std::optional<Photo> tabPhoto(MeasuringTab tab) {
  if (tab == MeasuringTab::before) return Photo::before;
  if (tab == MeasuringTab::after) return Photo::after;
  return std::nullopt;
}

/// Keys that mean the same here as elsewhere.
bool isGlobalAction(window::Action action) {
  using window::Action;
  static constexpr Action kEverywhere[] = {
      Action::help,   Action::full_screen,    Action::screenshot,    Action::screenshot_with_pop_ups,
      Action::undo,   Action::redo,           Action::cancel,        Action::quit,
      Action::clutch, Action::emergency_stop, Action::measure_person};
  return std::find(std::begin(kEverywhere), std::end(kEverywhere), action) != std::end(kEverywhere);
}

std::optional<Vec2> arrowDirection(window::Key key) {
  if (key == window::Key::left) return Vec2(-1.0, 0.0);
  if (key == window::Key::right) return Vec2(1.0, 0.0);
  if (key == window::Key::up) return Vec2(0.0, -1.0);
  if (key == window::Key::down) return Vec2(0.0, 1.0);
  return std::nullopt;
}

/// The innermost thing that can be left here.
bool cancelInnermost(MeasuringView& view) {
  if (view.dialog) {
    view.dialog.reset();
  } else if (view.selected) {
    view.selected.reset();
  } else if (view.tool != MeasuringTool::look) {
    view.tool = MeasuringTool::look;
  } else {
    return false;
  }
  return true;
}

/// Forgets results of other photographs.
void forgetMeasured(MeasuringView& view) {
  view.marks = {};
  view.history.clear();
  view.selected.reset();
  view.nudged.reset();
  view.drag.reset();
  view.measured = nullptr;
  view.overlay = {};
  view.failure.clear();
  view.settings.contact_px.reset();
  view.corrected = view.unsaved = false;
  view.stale = Stale::photographs;
}

void clampMiddle(MeasuringView& view) {
  const double rim = 0.5 / view.zoom;
  view.middle = view.middle.cwiseMax(Vec2::Constant(rim)).cwiseMin(Vec2::Constant(1.0 - rim));
}

}  // namespace

std::string acceptedName(const AcceptForm& form) { return form.name.empty() ? form.place_name : form.name; }

void choosePhoto(MeasuringView& view, Photo which, std::string file) {
  view.photo(which) = {.file = std::move(file)};
  forgetMeasured(view);
  view.tab = which == Photo::before ? MeasuringTab::before : MeasuringTab::after;
  view.dialog.reset();
}

std::optional<PhotoPair> pairAmong(std::span<const std::filesystem::path> files) {
  constexpr std::string_view kBefore = "before";
  for (const std::filesystem::path& file : files) {
    std::string name = file.filename().string();
    const std::size_t at = name.find(kBefore);
    if (at == std::string::npos) continue;
    name.replace(at, kBefore.size(), "after");
    const std::filesystem::path after = file.parent_path() / name;
    if (std::ranges::find(files, after) != files.end()) return PhotoPair{file.string(), after.string()};
  }
  return std::nullopt;
}

void swapPhotos(MeasuringView& view) {
  std::swap(view.photos[0], view.photos[1]);
  forgetMeasured(view);
}

Photo freePlace(const MeasuringView& view) {
  return view.photo(Photo::before).file.empty() ? Photo::before : Photo::after;
}

bool isPhotograph(std::string_view file) {
  static constexpr std::string_view kKinds[] = {".jpg", ".jpeg", ".png", ".tif", ".tiff"};
  const std::string kind = inSmallLetters(file.substr(std::min(file.size(), file.rfind('.'))));
  return std::find(std::begin(kKinds), std::end(kKinds), kind) != std::end(kKinds);
}

measure::DotPair photoMarks(const measure::Measurement& measured) {
  measure::DotPair marks{measured.grid.strays, measured.after_dots};
  for (const measure::GridDot& of_grid : measured.grid.dots) marks.before.push_back(of_grid.dot);
  return marks;
}

void acceptMeasurement(MeasuringView& view, std::shared_ptr<const measure::Measurement> measured,
                       measure::Overlay overlay, bool of_photographs) {
  if (of_photographs) {
    view.marks = photoMarks(*measured);
    view.history.clear();
    view.selected.reset();
    view.tab = MeasuringTab::result;
  }
  view.overlay = std::move(overlay);
  view.measured = std::move(measured);
  view.failure.clear();
}

std::optional<std::size_t> markAt(const MeasuringView& view, Photo which, const Vec2& at_px, double reach_px) {
  std::optional<std::size_t> nearest;
  double least = reach_px;
  const std::vector<measure::Dot>& marks = view.photoMarks(which);
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const double distance = (marks[i].place_px - at_px).norm();
    if (distance > least) continue;
    least = distance;
    nearest = i;
  }
  return nearest;
}

void useTool(MeasuringView& view, MeasuringTool tool) {
  view.tool = tool;
  const bool on_photographs =
      view.tab == MeasuringTab::before || view.tab == MeasuringTab::after || view.tab == MeasuringTab::all;
  if (tool == MeasuringTool::dots && !on_photographs) view.tab = MeasuringTab::before;
}

void pressPhoto(MeasuringView& view, Photo which, const Vec2& at_px, double reach_px, bool shift) {
  if (view.tool == MeasuringTool::contact) {
    if (which == Photo::before) setContact(view, at_px);
    return;
  }
  if (view.tool != MeasuringTool::dots || view.stale == Stale::photographs) return;
  view.drag = MarkDrag{.photo = which,
                       .from_px = at_px,
                       .mark = markAt(view, which, at_px, reach_px),
                       .selects = shift,
                       .before = correctionsNow(view)};
  if (view.drag->mark) view.selected = ChosenMark{which, *view.drag->mark};
}

void dragPhoto(MeasuringView& view, const Vec2& at_px, double slack_px) {
  if (!view.drag) return;
  MarkDrag& drag = *view.drag;
  if ((at_px - drag.from_px).norm() > slack_px) drag.moved = true;
  if (!drag.moved || !drag.mark || drag.selects) return;
  const Vec2 grabbed = drag.photo == Photo::before ? drag.before.marks.before[*drag.mark].place_px
                                                   : drag.before.marks.after[*drag.mark].place_px;
  view.photoMarks(drag.photo)[*drag.mark].place_px = grabbed + at_px - drag.from_px;
}

void releasePhoto(MeasuringView& view) {
  if (!view.drag) return;
  MarkDrag drag = *std::exchange(view.drag, std::nullopt);
  if (drag.selects) return;
  std::vector<measure::Dot>& marks = view.photoMarks(drag.photo);
  if (!drag.mark) {
    if (drag.moved) return;  // a slip, not a click
    marks.push_back({drag.from_px, 0.0});
    view.selected = ChosenMark{drag.photo, marks.size() - 1};
    return commitStep(view, std::move(drag.before), tr("add a dot"));
  }
  if (drag.moved) return commitStep(view, std::move(drag.before), tr("move a dot"));
  marks.erase(marks.begin() + static_cast<std::ptrdiff_t>(*drag.mark));
  view.selected.reset();
  commitStep(view, std::move(drag.before), tr("remove a dot"));
}

void removeSelected(MeasuringView& view) {
  if (!view.selected) return;
  Corrections before = correctionsNow(view);
  std::vector<measure::Dot>& marks = view.photoMarks(view.selected->photo);
  marks.erase(marks.begin() + static_cast<std::ptrdiff_t>(view.selected->index));
  view.selected.reset();
  commitStep(view, std::move(before), tr("remove a dot"));
}

void nudgeSelected(MeasuringView& view, const Vec2& by_px) {
  if (!view.selected) return;
  Corrections before = correctionsNow(view);
  view.photoMarks(view.selected->photo)[view.selected->index].place_px += by_px;
  if (view.nudged == view.selected) return measureAgain(view);  // one step, however often the key was pressed
  commitStep(view, std::move(before), tr("nudge a dot"));
  view.nudged = view.selected;
}

void setContact(MeasuringView& view, const std::optional<Vec2>& at_px) {
  if (view.settings.contact_px == at_px) return;
  commitStep(view, correctionsNow(view), at_px ? tr("mark the contact") : tr("forget the contact"));
  view.settings.contact_px = at_px;
}

std::string undoCorrection(MeasuringView& view) {
  const std::string words = view.history.undoLabel();
  if (view.history.canUndo()) restore(view, view.history.undo(correctionsNow(view)));
  return words;
}

std::string redoCorrection(MeasuringView& view) {
  const std::string words = view.history.redoLabel();
  if (view.history.canRedo()) restore(view, view.history.redo(correctionsNow(view)));
  return words;
}

void settingsChanged(MeasuringView& view) { view.stale = std::max(view.stale, Stale::marks); }

void zoomAbout(MeasuringView& view, const Vec2& place, double factor) {
  const double before = view.zoom;
  view.zoom = std::clamp(view.zoom * factor, 1.0, kMaxZoom);
  view.middle = place + (view.middle - place) * (before / view.zoom);
  clampMiddle(view);
}

void panBy(MeasuringView& view, const Vec2& by) {
  view.middle += by;
  clampMiddle(view);
}

bool measuringKey(MeasuringView& view, window::Key key, const window::Modifiers& modifiers,
                  MeasuringRequests& requests) {
  if (key == window::Key::escape) return cancelInnermost(view);
  if (view.dialog) return true;
  if (key == window::Key::tab) {
    const int step = modifiers.shift ? 3 : 1;
    view.tab = static_cast<MeasuringTab>((static_cast<int>(view.tab) + step) % 4);
  } else if (key == window::Key::enter || key == window::Key::pad_enter) {
    requests.emplace_back(AcceptMeasurement{});
  } else if (key == window::Key::delete_key) {
    removeSelected(view);
  } else if (key == window::Key::home) {
    zoomAbout(view, view.middle, 1.0 / kMaxZoom);
  } else if (const auto arrow = arrowDirection(key)) {
    nudgeSelected(view, *arrow * (modifiers.shift ? kFineNudgePx : kNudgePx));
  } else if (const auto pressed = window::findAction({key, modifiers})) {
    if (pressed->action == window::Action::open) view.dialog = tabPhoto(view.tab).value_or(freePlace(view));
    return !isGlobalAction(pressed->action);
  }
  return true;
}

std::string obstacleToAccept(const MeasuringView& view) {
  if (!view.settled()) return tr("It is still being measured");
  if (!view.measured || !view.measured->fit) return tr("No ellipse to accept");
  if (!view.form.at_mm) return tr("Set the place on the body first");
  const std::string fault = measure::faultOfKeyName(acceptedName(view.form));
  if (!fault.empty()) return trf("The name {}", fault);
  if (view.form.table.empty()) return tr("Name a table for it first");
  return {};
}

}  // namespace palpate::viewer
