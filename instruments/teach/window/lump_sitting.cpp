#include "teach/window/lump_sitting.h"

#include <fmt/format.h>

#include <utility>

#include "palpate/base/language.h"
#include "palpate/scene/lumps_of_body.h"

namespace palpate::viewer {

namespace {

using lumps::LumpQuestion;
using training::LumpScreen;

/// A touch counts as pointing from this force in the hand on, N: what rests on the skin names nothing.
constexpr double kPointsN = 0.1;

TrainingButton buttonFor(TrainingAct act, std::string label, int value = 0) {
  return {.act = act, .value = value, .label = std::move(label)};
}

TrainingScreen cardFor(const LumpView& view) {
  TrainingScreen screen;
  if (view.session->screen() == LumpScreen::instruction) {
    screen.lines = {tr("A place is named by touching it: touch it last, then press Here.")};
    if (view.by_mouse) {
      screen.lines.emplace_back(
          tr("With the mouse you see what the hand would feel: rings show how far the finger sinks, fewer over a lump. "
             "Deep lumps need a device."));
    }
    screen.buttons = {buttonFor(TrainingAct::next, tr("Start")), buttonFor(TrainingAct::leave, tr("Leave"))};
  } else {
    screen.buttons = {buttonFor(TrainingAct::next, tr("Finish"))};
  }
  return screen;
}

/// The finger of the keyboard is there where no device holds it.
std::string keysOf(const LumpView& view) {
  const LumpScreen shown = view.session->screen();
  std::string keys = tr("Enter presses the marked button, Tab marks the next.");
  if (view.by_mouse && (shown == LumpScreen::trial || shown == LumpScreen::feedback)) {
    keys += std::string(" ") + tr("Arrows move the finger, T presses and lifts.");
  }
  if (shown == LumpScreen::trial) return keys + " " + tr("P pauses, Esc leaves.");
  return shown == LumpScreen::instruction || shown == LumpScreen::feedback ? keys + " " + tr("Esc leaves.") : keys;
}

/// The mouse gives the hand nothing: the eye sees how far the finger sinks, by the same force everywhere. Rings and
/// close view are of the skin alone, so they reveal no more than a hand would feel.
void addSink(const LumpView& view, TrainingScreen& screen) {
  if (!view.by_mouse) return;
  screen.shows_sink = true;
  screen.lines.emplace_back(tr("Watch how far it sinks: fewer rings over something hard. Right-drag turns the body."));
}

void addButtons(const LumpView& view, TrainingScreen& screen) {
  const training::LumpSession& session = *view.session;
  if (session.screen() == LumpScreen::feedback) {
    screen.buttons = {buttonFor(TrainingAct::next, tr("Next")), buttonFor(TrainingAct::leave, tr("Leave"))};
    return;
  }
  if (session.question() == LumpQuestion::place) {
    screen.buttons = {buttonFor(TrainingAct::answer, tr("Here"))};
    screen.buttons.back().enabled = view.touched && !view.waiting;
    if (session.isExam()) screen.buttons.push_back(buttonFor(TrainingAct::no, tr("No more lumps")));
  } else {
    int value = 0;
    for (std::string& label : training::lumpChoices(session.question())) {
      screen.buttons.push_back(buttonFor(TrainingAct::choose, std::move(label), value++));
      screen.buttons.back().enabled = !view.waiting;
    }
  }
  screen.buttons.push_back(buttonFor(TrainingAct::pause, tr("Pause")));
  screen.buttons.push_back(buttonFor(TrainingAct::leave, tr("Leave")));
}

}  // namespace

LumpSessionRun::LumpSessionRun(training::Store& store, LiveServo& servo, const training::LumpSessionPlan& plan,
                               const training::Moment& now)
    : rows_(store, servo, plan.row.file), session_(plan, now) {}

std::string LumpSessionRun::finish(std::string_view ended_by, const training::Moment& now) {
  session_.leave(now);
  const bool kept = save();
  const std::string words = rows_.finish(session_.plan().row.id, ended_by);
  return kept ? words : trouble();
}

TrialWorld::Body LumpSessionRun::wanted() const {
  const bool felt = session_.screen() == LumpScreen::trial || session_.screen() == LumpScreen::feedback;
  if (!felt || session_.paused()) return {};
  return {.hidden = training::HiddenNow{.site = session_.bodyNumber(), .change = 0.0}, .trial = session_.bodyNumber()};
}

scene::Scene LumpSessionRun::makeScene(const scene::Scene& base) const {
  return training::lumpScene(base, session_.plan().bodies->task(), session_.hidden());
}

void LumpSessionRun::handleNewWorld(const scene::World& world) {
  feet_.clear();
  for (const auto& lump : world.lumps) feet_.push_back(lump->lump.foot);
  markPlaces();
}

void LumpSessionRun::feel(const trace::Sample& sample, const training::Moment& now) {
  session_.feel(sample, now);
  if (session_.paused() || sample.contact.touch == contact::Touch::free || sample.device_force.norm() < kPointsN)
    return;
  touched_ = sample.contact.proxy;
  markPlaces();
}

void LumpSessionRun::namePlace(const training::Moment& now) {
  if (!touched_ || !session_.answer(Vec2(touched_->head<2>()), now)) return;
  named_.push_back(*touched_);
  touched_.reset();
}

bool LumpSessionRun::deviceButton(const training::Moment& now) {
  const bool points = session_.question() == LumpQuestion::place && touched_;
  return act(points ? TrainingAct::answer : TrainingAct::next, 0, now);
}

bool LumpSessionRun::act(TrainingAct act, int value, const training::Moment& now) {
  const int body = session_.bodyNumber();
  switch (act) {
    case TrainingAct::next:
      if (session_.screen() == LumpScreen::finished) return true;
      session_.next(now);
      break;
    case TrainingAct::choose:
      session_.answer(value, now);
      break;
    case TrainingAct::answer:
      namePlace(now);
      break;
    case TrainingAct::no:
      session_.noMore(now);
      break;
    case TrainingAct::pause:
      session_.pause(now);
      break;
    case TrainingAct::go_on:
      session_.goOn(now);
      break;
    default:
      break;
  }
  if (session_.bodyNumber() != body) {
    touched_.reset();
    named_.clear();
    feet_.clear();
  }
  markPlaces();
  return false;
}

/// The named places, then the touched one or, in feedback, the lumps.
void LumpSessionRun::markPlaces() {
  places_ = named_;
  if (!session_.shown().empty()) {
    places_.insert(places_.end(), feet_.begin(), feet_.end());
  } else if (touched_ && session_.question() == LumpQuestion::place) {
    places_.push_back(*touched_);
  }
}

TrainingScreen LumpSessionRun::screen(const std::string& corner, bool waiting, bool by_mouse) const {
  return makeLumpScreen({.session = &session_,
                         .corner = corner,
                         .waiting = waiting,
                         .touched = touched_.has_value(),
                         .by_mouse = by_mouse,
                         .named = named_.size(),
                         .marks = places_.size()});
}

TrainingScreen makeLumpScreen(const LumpView& view) {
  const LumpScreen shown = view.session->screen();
  const bool on_body = shown == LumpScreen::trial || shown == LumpScreen::feedback;
  TrainingScreen screen = on_body ? TrainingScreen() : cardFor(view);
  screen.corner = view.corner;
  screen.title = view.session->said().text;
  screen.keys = keysOf(view);
  if (!on_body) return screen;
  screen.place = TrainingPlace::body;
  if (view.waiting) screen.notice = tr("One moment ...");
  screen.done = static_cast<double>(view.session->bodyNumber() - 1) / view.session->bodiesAtMost();
  for (std::size_t i = 0; i < view.marks; ++i) {
    SiteMark mark{.number = static_cast<int>(i) + 1};
    mark.is_true = shown == LumpScreen::feedback && i >= view.named;
    mark.is_own = shown == LumpScreen::feedback && i < view.named;
    mark.picked = shown == LumpScreen::trial && i >= view.named;
    mark.pressed = i < view.named;
    if (mark.is_true) mark.word = tr("feel it here");
    if (mark.is_own) mark.word = tr("your answer");
    screen.sites.push_back(std::move(mark));
  }
  addSink(view, screen);
  addButtons(view, screen);
  return screen;
}

}  // namespace palpate::viewer
