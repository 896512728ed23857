#include "view/viewer/state/edit_history.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "palpate/base/language.h"
#include "palpate/base/text.h"
#include "palpate/scene/scene_edit.h"
#include "palpate/scene/scene_writer.h"
#include "view/viewer/state/scene_document.h"
#include "view/viewer/state/state_file.h"
#include "view/viewer/state/viewer_state.h"

namespace palpate::viewer {

namespace {

/// State that is kept from run to run and does not count as a change: open panels, places of windows.
constexpr std::array<std::string_view, 11> kNoHabits = {"version",    "window_", "full_screen", "panel",
                                                        "plots",      "numbers", "reach",       "hints",
                                                        "start_page", "recent",  "language"};

bool isHabit(std::string_view line) {
  return std::none_of(kNoHabits.begin(), kNoHabits.end(),
                      [&](std::string_view name) { return line.starts_with(name); });
}

std::string formatHabits(const ViewState& state, const std::vector<tissue::ProfileKnot>& drawn) {
  std::string habits;
  const std::string all = stateAsToml({state, {}});
  for (const std::string_view line : split(all, '\n')) {
    if (isHabit(line)) habits += fmt::format("{}\n", line);
  }
  for (const tissue::ProfileKnot& knot : drawn) habits += fmt::format("profile = {} {}\n", knot.q, knot.value);
  return habits;
}

SessionSnapshot makeSnapshot(const EditedScene& edited, const BodyView& seen) {
  SessionSnapshot snapshot{.scene = edited.scene,
                           .state = seen.state,
                           .drawn = edited.profile.drawn,
                           .document = sceneAsChanged(edited.scene, seen)};
  snapshot.document_text = scene::sceneAsToml(snapshot.document);
  snapshot.habits = formatHabits(snapshot.state, snapshot.drawn);
  return snapshot;
}

bool areSame(const std::vector<tissue::ProfileKnot>& a, const std::vector<tissue::ProfileKnot>& b) {
  const auto same = [](const tissue::ProfileKnot& k, const tissue::ProfileKnot& l) {
    return k.q == l.q && k.value == l.value;
  };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

std::string shortened(const std::string& value) {
  constexpr std::size_t kMax = 24;
  if (value.empty()) return tr("the default");
  return value.size() <= kMax && value.find('\n') == std::string::npos ? value : "...";
}

/// The name of the first line that differs.
std::string changedHabit(const std::string& was, const std::string& is) {
  const auto before = split(was, '\n');
  const auto now = split(is, '\n');
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (i < before.size() && before[i] == now[i]) continue;
    std::string name(trimmed(now[i].substr(0, now[i].find('='))));
    std::replace(name.begin(), name.end(), '_', ' ');
    if (!name.empty()) return name;
  }
  return "profile";
}

std::string wordsFor(const SessionSnapshot& was, const SessionSnapshot& is) {
  const auto differences = scene::differences(was.document, is.document);
  if (differences.empty()) return changedHabit(was.habits, is.habits);
  const scene::Difference& first = differences.front();
  const std::string name =
      fmt::format("{}{}{}", first.table, first.table.empty() || first.key.empty() ? "" : " ", first.key);
  return trf("{} from {} to {}", name, shortened(first.was), shortened(first.is));
}

}  // namespace

void ChangeHistory::begin(const EditedScene& edited, const BodyView& seen) {
  now_ = makeSnapshot(edited, seen);
  saved_ = now_;
  steps_.clear();
  by_widget_ = false;
  words_.clear();
}

void ChangeHistory::follow(const EditedScene& edited, const BodyView& seen, const Stir& stir, UiOutput& output) {
  if (!output.step.empty()) words_ = std::exchange(output.step, {});
  const bool held = stir.widget || stir.hand;
  if (!held && (stir.any || by_widget_)) settle(edited, seen);
  by_widget_ = stir.widget;
}

/// The depth of a press, the only habit that a hand on the body changes, is part of touching, not a step.
void ChangeHistory::settle(const EditedScene& edited, const BodyView& seen) {
  SessionSnapshot is = makeSnapshot(edited, seen);
  std::string words = std::exchange(words_, {});
  const bool habit = is.habits != now_.habits;
  if (is.document_text == now_.document_text && !habit) return;
  const bool step = is.document_text != now_.document_text || by_widget_;
  if (step) steps_.add(now_, words.empty() ? wordsFor(now_, is) : std::move(words));
  now_ = std::move(is);
}

void ChangeHistory::saved(const EditedScene& edited, const BodyView& seen) {
  now_ = makeSnapshot(edited, seen);
  saved_ = now_;
}

bool ChangeHistory::sceneChanged() const { return scene::sceneAsToml(now_.scene) != scene::sceneAsToml(saved_.scene); }

void ChangeHistory::undo(EditedScene& edited, BodyView& seen, Conversation& user) {
  settle(edited, seen);
  if (!steps_.canUndo()) return user.report(Severity::info, "Nothing to undo");
  user.report(Severity::info, trf("Undo: {}", steps_.undoLabel()));
  restore(steps_.undo(now_), edited, seen, user.output);
}

void ChangeHistory::redo(EditedScene& edited, BodyView& seen, Conversation& user) {
  settle(edited, seen);
  if (!steps_.canRedo()) return user.report(Severity::info, "Nothing to redo");
  user.report(Severity::info, trf("Redo: {}", steps_.redoLabel()));
  restore(steps_.redo(now_), edited, seen, user.output);
}

void ChangeHistory::reset(EditedScene& edited, BodyView& seen, Conversation& user) {
  settle(edited, seen);
  if (now_.document_text == saved_.document_text && now_.habits == saved_.habits) {
    return user.report(Severity::info, "Nothing was changed");
  }
  steps_.add(now_, tr("reset"));
  user.report(Severity::info, "Everything is as it was opened or saved");
  restore(saved_, edited, seen, user.output);
}

void ChangeHistory::restore(SessionSnapshot to, EditedScene& edited, BodyView& seen, UiOutput& output) {
  for (const scene::Difference& difference : scene::differences(edited.scene, to.scene)) {
    output.changed |= tableConsequences(difference.table);
  }
  edited.scene = std::move(to.scene);
  ViewState& state = seen.state;
  to.state.shown = state.shown;
  to.state.hints = state.hints;
  to.state.start_page = state.start_page;
  to.state.recent = std::move(state.recent);
  to.state.stereo.monitor_row = state.stereo.monitor_row;
  state = std::move(to.state);
  const auto kept = [](auto& editor, std::size_t items) {
    editor.before.reset();
    editor.selected = std::min(editor.selected, static_cast<int>(items) - 1);
  };
  kept(edited.editor, edited.scene.dysfunctions.size());
  kept(edited.lump_editor, edited.scene.lumps.size());
  // The file of the user's profile has one name, so its contents are written back.
  ProfileEdit& profile = edited.profile;
  if (!areSame(profile.drawn, to.drawn) && !to.drawn.empty() &&
      edited.scene.deformation.forms.normal_profile.kind == tissue::ProfileKind::user) {
    profile.knots = to.drawn;
    output.request(UseProfile{});
  }
  profile.drawn = std::move(to.drawn);
  now_ = makeSnapshot(edited, seen);
}

std::uint32_t tableConsequences(std::string_view table) {
  if (table == "body") return kBodyChange;
  if (table == "friction" || table == "device") return kFingerChange;
  if (table == "tissue") return kFingerChange | kMapChange;   // relaxation belongs to the finger
  if (table == "contact") return kFingerChange | kMapChange;  // the source of the contact is built with the maps
  if (table == "output" || table == "safety" || table == "view") return kNothing;
  if (table == "finger") return kFingerChange | kMapChange;  // their radii, and the paths of the world
  return kMapChange;
}

}  // namespace palpate::viewer
