// Screens of a session with lumps: words, buttons and marks. Pure.
#include "palpate/base/language.h"
#include "palpate/training/session/lump_session.h"
#include "teach/window/training_words.h"

namespace palpate::viewer {

namespace {

using lumps::LumpQuestion;
using training::Screen;

TrainingScreen cardFor(const TrainingView& view) {
  TrainingScreen screen;
  if (view.lumps->screen() == Screen::instruction) {
    screen.lines = {tr("A place is named by touching it: touch it last, then press Here.")};
    if (view.by_mouse) {
      screen.lines.emplace_back(
          tr("With the mouse you see what the hand would feel: rings show how far the finger sinks, fewer over a lump. "
             "Deep lumps need a device."));
    }
    screen.buttons = {button(TrainingAct::next, tr("Start")), button(TrainingAct::leave, tr("Leave"))};
  } else {
    screen.buttons = {button(TrainingAct::next, tr("Finish"))};
  }
  return screen;
}

/// The finger of the keyboard is there where no device holds it.
std::string keysOf(const TrainingView& view) {
  const Screen shown = view.lumps->screen();
  std::string keys = tr("Enter presses the marked button, Tab marks the next.");
  if (view.by_mouse && (shown == Screen::trial || shown == Screen::feedback)) {
    keys += std::string(" ") + tr("Arrows move the finger, T presses and lifts.");
  }
  if (shown == Screen::trial) return keys + " " + tr("P pauses, Esc leaves.");
  return shown == Screen::instruction || shown == Screen::feedback ? keys + " " + tr("Esc leaves.") : keys;
}

/// The mouse gives the hand nothing: the eye sees how far the finger sinks, by the same force everywhere. Rings and
/// close view are of the skin alone, so they reveal no more than a hand would feel.
void addSinkOfLumps(const TrainingView& view, TrainingScreen& screen) {
  if (!view.by_mouse) return;
  screen.shows_sink = true;
  screen.lines.emplace_back(tr("Watch how far it sinks: fewer rings over something hard. Right-drag turns the body."));
}

void addButtons(const TrainingView& view, TrainingScreen& screen) {
  const training::LumpSession& session = *view.lumps;
  if (session.screen() == Screen::feedback) {
    screen.buttons = {button(TrainingAct::next, tr("Next")), button(TrainingAct::leave, tr("Leave"))};
    return;
  }
  if (session.question() == LumpQuestion::place) {
    screen.buttons = {button(TrainingAct::answer, tr("Here"))};
    screen.buttons.back().enabled = view.touched && !view.waiting;
    if (session.isExam()) screen.buttons.push_back(button(TrainingAct::no, tr("No more lumps")));
  } else {
    int value = 0;
    for (std::string& label : training::lumpChoices(session.question())) {
      screen.buttons.push_back(
          {.act = TrainingAct::choose, .value = value++, .label = std::move(label), .enabled = !view.waiting});
    }
  }
  screen.buttons.push_back(button(TrainingAct::pause, tr("Pause")));
  screen.buttons.push_back(button(TrainingAct::leave, tr("Leave")));
}

}  // namespace

TrainingScreen makeLumpScreen(const TrainingView& view) {
  const Screen shown = view.lumps->screen();
  const bool on_body = shown == Screen::trial || shown == Screen::feedback;
  TrainingScreen screen = on_body ? TrainingScreen() : cardFor(view);
  screen.corner = view.code;
  screen.title = view.lumps->said().text;
  screen.keys = keysOf(view);
  if (!on_body) return screen;
  screen.place = TrainingPlace::body;
  if (view.waiting) screen.notice = tr(kOneMoment);
  screen.done = static_cast<double>(view.lumps->bodyNumber() - 1) / view.lumps->bodiesAtMost();
  for (std::size_t i = 0; i < view.marks; ++i) {
    SiteMark mark{.number = static_cast<int>(i) + 1};
    mark.is_true = shown == Screen::feedback && i >= view.named;
    mark.is_own = shown == Screen::feedback && i < view.named;
    mark.picked = shown == Screen::trial && i >= view.named;
    mark.pressed = i < view.named;
    if (mark.is_true) mark.word = tr("feel it here");
    if (mark.is_own) mark.word = tr("your answer");
    screen.sites.push_back(std::move(mark));
  }
  addSinkOfLumps(view, screen);
  addButtons(view, screen);
  return screen;
}

}  // namespace palpate::viewer
