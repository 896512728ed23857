// The viewer's input: the events of a frame, pass by pass, become commands, and commands are performed.
#include "palpate/body/places.h"
#include "palpate/view/overlays/place_words.h"
#include "palpate/window/gui_passes.h"
#include "view/viewer/editing/acts.h"
#include "view/viewer/editing/dysfunction_editor.h"
#include "view/viewer/editing/lump_editor.h"
#include "view/viewer/panels/gui_layout.h"
#include "view/viewer/panels/panels.h"
#include "view/viewer/viewer.h"

namespace palpate::viewer {

namespace {

using Kind = window::Command::Kind;

/// Whether typed text is for a dialog or the search, not for the body.
bool ownsKeyboard(const PlaceSearch& search) { return dialogShown() || search.open; }

}  // namespace

/// A newly opened text field gets the keyboard before the next event.
void Viewer::drawGuiPasses(std::span<const window::InputEvent> events, double points, double elapsed_s) {
  constexpr double kInstantS = 1e-4;
  // A dialog knows its place from its second pass on; a click on the page while the viewer was made meant this one.
  const int passes_before = !looked_ && seen_.state.shown.start ? 2 : 0;
  for (int i = 0; i < passes_before; ++i) drawGuiPass({}, points, kInstantS);
  for (const std::span<const window::InputEvent> pass : window::guiPasses(events)) {
    const bool owned = ownsKeyboard(user_.place_search);
    drawGuiPass(pass, points, std::exchange(elapsed_s, kInstantS));
    // Its window appears, its field is focused, the field receives text; and once it is closed, no longer.
    const bool changed = owned != ownsKeyboard(user_.place_search);
    for (int i = 0; changed && i < 3; ++i) drawGuiPass({}, points, kInstantS);
  }
}

void Viewer::drawGuiPass(std::span<const window::InputEvent> events, double points, double elapsed_s) {
  gui_.begin(seen_.size_points, points, elapsed_s, events);
  showCursor();
  lookAround();
  handle(events);
  intro_.advance(pointer_, *world_, user_.now_s);
  pointer_.advance(seen_, user_.now_s);
  placeRulerLabel();
  const auto& place = pointer_.placeOf(seen_.active_finger);
  user_.place_words =
      place ? view::placeInLanguage(body::describePlace(edited_.world.landmarks, place->point)) : std::string();
  drawGui(viewer_, modes_, {example_pictures_, file_preview_});
  gui_.end();
}

void Viewer::handle(std::span<const window::InputEvent> events) {
  input_.settings = seen_.state.input;
  input_.useFinger(seen_.active_finger);
  std::vector<window::Command> commands;
  for (const window::InputEvent& event : events) {
    using EventKind = window::InputEvent::Kind;
    const bool typing = gui_.wantsText() || ownsKeyboard(user_.place_search);
    if (devices_.handle(event, typing)) continue;
    if (event.kind == EventKind::key && event.down && event.key == window::Key::escape && closeMenus()) continue;
    if (event.kind == EventKind::drop && !modes_.claims().window) user_.request(OpenFile{event.text});
    if (event.kind == EventKind::move || event.kind == EventKind::button) intro_.end(pointer_);
    if (user_.question && event.kind == EventKind::key) {
      const std::string_view chosen = event.down ? answerForKey(event.key, user_.question) : std::string_view();
      if (!chosen.empty()) user_.request(AnswerQuestion{std::string(chosen)});
      continue;
    }
    if (modes_.handle(event, viewer_, typing)) continue;
    window::Situation situation;
    situation.over_gui = gui_.wantsMouse() || user_.question || dialogShown() || modes_.claims().touch;
    situation.gui_wants_text = typing;
    situation.editing = edited_.editing() || seen_.ruler.active;
    situation.on_skin = event.kind == EventKind::button && pointer_.skinAt(event.at).has_value();
    commands.clear();
    input_.handle(event, situation, commands);
    for (const window::Command& command : commands) handle(command);
  }
}

void Viewer::handle(const window::Command& command) {
  if (modes_.handle(command, viewer_)) return;
  countHint(command, user_.hint, seen_.state.hints);
  if (command.kind == Kind::act) return actOn(command);
  const bool of_lumps = edited_.lump_editor.active;
  const int selected = of_lumps ? edited_.lump_editor.selected : edited_.editor.selected;
  // With nothing selected the wheel has nothing to size, so it zooms.
  if (command.kind == Kind::edit_size && (seen_.ruler.active || selected < 0)) {
    window::Command zoom = command;
    zoom.kind = Kind::zoom;
    pointer_.apply(zoom, seen_, user_.now_s);
    return;
  }
  if (pointer_.apply(command, seen_, user_.now_s)) {
    const auto& place = pointer_.placeOf(seen_.active_finger);
    const bool presses = command.kind == Kind::press || command.kind == Kind::hold;
    if (presses && place) seen_.reading = readVertex(*world_, place->point);
    return;
  }
  if (seen_.ruler.active) return measure(command);
  const auto place = pointer_.skinAt(command.at);
  std::optional<Vec2> on_map;
  if (place) on_map = Vec2(place->point.x(), place->point.y());
  of_lumps ? applyEdit(command, on_map, edited_.lumps(user_.output))
           : applyEdit(command, on_map, edited_.dysfunctions(user_.output));
}

void Viewer::actOn(const window::Command& command) {
  if (replayKey(command.action, command.fine, past_.replay)) return;
  if (pointer_.step(command.action, command.fine, seen_)) return;
  if (!camera_.act(command.action)) perform(command.action, viewer_);
}

void Viewer::measure(const window::Command& command) {
  if (command.kind != Kind::edit_grab) return;
  if (const auto place = pointer_.skinAt(command.at)) measureAt(*place, world_->surface, seen_.ruler);
}

}  // namespace palpate::viewer
