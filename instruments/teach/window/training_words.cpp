#include "teach/window/training_words.h"

#include <algorithm>
#include <array>

#include "palpate/base/language.h"
#include "palpate/training/wording.h"

namespace palpate::viewer {

namespace {

using training::Screen;
using training::SessionKind;

/// A device that gives this share of the forces, or more, gives them whole.
constexpr double kWholeForce = 0.995;

constexpr const char* kCardKeys = toTranslate("Arrow keys choose, Enter confirms, Esc goes back.");

// --- the front desk

TrainingScreen signInScreen(const TrainingView& view) {
  TrainingScreen screen = {
      .title = tr("Welcome"),
      .lines = {tr("Type the code on your card, then press Enter.")},
      .entry = TrainingScreen::Entry{tr("Code"), view.typed},
      .buttons = {button(TrainingAct::sign_in, tr("Sign in")),
                  button(TrainingAct::make_code, tr("I have no code"), tr("Makes one for you to write down."))},
      .keys = tr("Letters and digits type, Enter signs in.")};
  if (view.leads_back) screen.buttons.push_back(button(TrainingAct::no, tr("Back"), tr("To the start page.")));
  return screen;
}

TrainingScreen newCodeScreen(const TrainingView& view) {
  return {.title = tr("This code is new here. Continue?"),
          .lines = {tr("Is it the one on your card?")},
          .entry = TrainingScreen::Entry{tr("Code"), view.code},
          .buttons = {button(TrainingAct::yes, tr("Yes, continue")), button(TrainingAct::no, tr("No, type it again"))},
          .keys = tr(kCardKeys)};
}

TrainingScreen ownCodeScreen(const TrainingView& view) {
  return {.title = tr("This is your code"),
          .lines = {tr("Write it down and keep it. It is the only way back to your results.")},
          .entry = TrainingScreen::Entry{tr("Code"), view.code},
          .buttons = {button(TrainingAct::yes, tr("I have written it down")), button(TrainingAct::no, tr("Back"))},
          .keys = tr(kCardKeys)};
}

TrainingScreen consentScreen(const TrainingView& view) {
  return {.title = tr("What is kept"),
          .lines = {tr("Kept: your answers, their times, and how the finger moved and pressed."),
                    tr("Not kept: your name, email address or date of birth. You are known only by your code."),
                    tr("Your teacher sees the results of your code. You may have all of it deleted at any time.")},
          .buttons = {button(TrainingAct::yes, tr("I agree")),
                      button(TrainingAct::no, tr("I do not agree"), tr("Nothing is kept."))},
          .keys = tr(kCardKeys),
          .corner = view.code};
}

TrainingScreen handScreen(const TrainingView& view) {
  TrainingScreen screen;
  screen.title = tr("Which hand do you write with?");
  screen.buttons = {button(TrainingAct::choose, tr("Left")), button(TrainingAct::choose, tr("Right")),
                    button(TrainingAct::choose, tr("I would rather not say"))};
  for (std::size_t i = 0; i < screen.buttons.size(); ++i) screen.buttons[i].value = static_cast<int>(i);
  screen.corner = view.code;
  screen.keys = tr(kCardKeys);
  return screen;
}

TrainingScreen choiceScreen(const TrainingView& view) {
  TrainingScreen screen;
  screen.title = tr("What would you like to do?");
  for (std::size_t i = 0; i < view.offers.size(); ++i) {
    const Offer& offer = view.offers[i];
    screen.buttons.push_back({.act = TrainingAct::choose,
                              .value = static_cast<int>(i),
                              .label = offer.name,
                              .line = offer.line,
                              .badge = offer.suggested ? tr("suggested") : "",
                              .enabled = offer.enabled});
  }
  screen.buttons.push_back(button(TrainingAct::sign_out, tr("Sign out")));
  screen.corner = view.code;
  screen.keys = tr(kCardKeys);
  return screen;
}

TrainingScreen thimbleChoiceScreen(const TrainingView& view) {
  TrainingScreen screen;
  screen.title = tr("What touches your finger?");
  screen.lines = {trf("The device is {}. Results belong to what you feel with.", view.device)};
  for (std::size_t i = 0; i < kThimbles.size(); ++i) {
    screen.buttons.push_back({.act = TrainingAct::choose,
                              .value = static_cast<int>(i),
                              .label = tr(kThimbles[i].name),
                              .line = tr(kThimbles[i].line)});
  }
  screen.corner = view.code;
  screen.keys = tr(kCardKeys);
  return screen;
}

// --- a session

/// The trainee's answer, once it may be shown; 0: nothing.
int ownAnswer(const training::Session& session) {
  const bool shown = session.screen() == Screen::feedback && !session.trials().empty();
  return shown ? session.trials().back().site_answer : 0;
}

std::string wordAt(const SiteMark& mark, const training::Session& session) {
  if (session.screen() == Screen::familiarisation) {
    if (!session.feelsTruth()) return {};
    return mark.is_true ? tr("stiffer") : tr("normal");
  }
  if (mark.is_true) return mark.is_own ? tr("your answer: right") : tr("feel it here");
  return mark.is_own ? tr("your answer") : "";
}

void addSites(const TrainingView& view, TrainingScreen& screen) {
  const training::Session& session = *view.session;
  const auto pair = session.familiarPlaces();
  const bool asks = session.asks() && !view.waiting;
  const int truth = session.feelsTruth() && session.hidden() ? session.hidden()->site : 0;
  for (const training::Site& site : session.plan().sites.sites) {
    if (pair && site.number != pair->first && site.number != pair->second) continue;
    SiteMark mark{.number = site.number};
    mark.pressed = (asks || pair) && session.visited(site.number);
    mark.picked = view.picked == site.number && !view.waiting;
    mark.touched = session.touchedSite() == site.number && !view.waiting;
    mark.is_true = truth == site.number;
    mark.is_own = ownAnswer(session) == site.number;
    mark.word = wordAt(mark, session);
    screen.sites.push_back(std::move(mark));
  }
  screen.picks_sites = asks;
}

TrainingButton answerButton(const TrainingView& view) {
  const training::Site* site = view.session->plan().sites.numbered(view.picked);
  TrainingButton answer = button(TrainingAct::answer, tr("Answer"));
  if (site != nullptr) answer.label = trf("Answer: {}", training::spoken(*site));
  answer.enabled = site != nullptr && !view.waiting;
  return answer;
}

void familiarButtons(const TrainingView& view, TrainingScreen& screen) {
  screen.buttons = {answerButton(view), button(TrainingAct::leave, tr("Leave"))};
  screen.keys = view.by_mouse
                    ? tr("Number and Enter answer. Arrows go to the other place, Space presses and lifts. Esc leaves.")
                    : tr("Number and Enter answer, or the device's button on the place. Esc leaves.");
}

void trialButtons(const TrainingView& view, TrainingScreen& screen) {
  screen.buttons = {answerButton(view), button(TrainingAct::pause, tr("Pause")),
                    button(TrainingAct::leave, tr("Leave"))};
  screen.keys = view.by_mouse
                    ? tr("Number and Enter answer. Arrows go from place to place, Space presses and lifts. P pauses, "
                         "Esc leaves.")
                    : tr("Number and Enter answer, or the device's button on the place. P pauses, Esc leaves.");
  if (!view.waiting) screen.time_left = view.session->shareOfTimeLeft(view.now);
}

/// Practice alone shows progress and right answers.
void addProgress(const training::Session& session, TrainingScreen& screen) {
  const int most = session.trialsAtMost();
  const int number = session.trialNumber();
  const bool ended = session.result().has_value();
  const int answered = ended ? most : std::max(0, number - 1);
  if (most > 0) screen.done = std::min(1.0, static_cast<double>(answered) / most);
  if (!session.showsProgress() || number == 0) return;
  const auto& trials = session.trials();
  const auto right = std::ranges::count_if(trials, [](const training::TrialRow& trial) { return trial.correct; });
  const int shown = session.screen() == Screen::feedback ? number - 1 : number;
  screen.progress = trf("Trial {} of {}", std::max(1, shown), most);
  if (!trials.empty()) screen.progress += " · " + trf("{} of {} right", right, trials.size());
}

void nextButton(const char* label, TrainingScreen& screen) {
  screen.buttons = {button(TrainingAct::next, label), button(TrainingAct::leave, tr("Leave"))};
  screen.keys = tr("Space or Enter continues, Esc leaves.");
}

/// The mouse gives the hand nothing: the eye sees how far the finger sinks. The same words, rings and close view
/// wherever it presses, so they reveal no more than a hand would feel.
void addSink(const TrainingView& view, TrainingScreen& screen) {
  if (!view.by_mouse) return;
  screen.shows_sink = true;
  screen.lines.emplace_back(tr("Watch how far it sinks: fewer rings, stiffer. Right-drag turns the body."));
}

/// Without a device keys move the finger, too.
void addTouchKeys(const TrainingView& view, TrainingScreen& screen) {
  if (view.by_mouse) screen.keys += std::string(" ") + tr("Arrows go from place to place, T presses and lifts.");
}

/// The session's sentence is read first; a trial's own is above the last text.
void addSaid(const TrainingView& view, TrainingScreen& screen) {
  const training::Session& session = *view.session;
  const std::string said = session.said().text;
  if (session.screen() != Screen::trial) {
    screen.title = said;
    return;
  }
  screen.title = training::instruction(session.plan().protocol, session.plan().kind);
  const bool over = said == training::answerSaved() && view.said_long_ago;
  if (said != screen.title && !over) screen.notice = said;
}

TrainingScreen cardOfSession(const TrainingView& view, TrainingScreen screen) {
  const training::Session& session = *view.session;
  screen.place = TrainingPlace::card;
  screen.sites.clear();
  switch (session.screen()) {
    case Screen::instruction:
      screen.lines = {training::greeting(session.plan().kind),
                      tr("A dot fills when its place has been pressed enough. The ring shows the time.")};
      if (session.plan().kind == SessionKind::mastery) screen.lines.pop_back();
      nextButton(tr("Start"), screen);
      return screen;
    case Screen::block_summary:
      nextButton(session.showsProgress() ? tr("Another block") : tr("Finish"), screen);
      screen.buttons.back().label = tr("Finish");
      if (!session.showsProgress()) screen.buttons.pop_back();
      return screen;
    default:
      screen.buttons = {button(TrainingAct::next, tr("Back to the choice"))};
      screen.keys = tr("Space or Enter continues.");
      return screen;
  }
}

void addDeviceCheck(const TrainingView& view, TrainingScreen& screen) {
  screen.sites.clear();
  if (view.by_mouse) {
    screen.lines = {tr("Press with the left mouse button on the back. The wheel presses harder.")};
    screen.shows_sink = true;
  }
  if (view.force_share < kWholeForce) {
    screen.lines.push_back(trf("This device gives {:.0f} % of every force: all places feel softer to the same degree.",
                               100.0 * view.force_share));
  }
  if (view.ratios_kept_to_n > 0.0) {
    screen.lines.push_back(
        trf("Above {:.2g} N differences are harder to feel: press more gently.", view.ratios_kept_to_n));
  }
  nextButton(tr("Next"), screen);
  addTouchKeys(view, screen);
}

void addFeedback(const TrainingView& view, TrainingScreen& screen) {
  const training::Session& session = *view.session;
  addProgress(session, screen);
  if (!session.trials().empty()) {
    const training::TrialRow& trial = session.trials().back();
    screen.outcome = trial.correct ? TrainingScreen::Outcome::right : TrainingScreen::Outcome::wrong;
    const training::Site* own = session.plan().sites.numbered(trial.site_answer);
    if (own != nullptr && !trial.correct) screen.lines.push_back(training::wrongAnswerReview(*own));
  }
  addSink(view, screen);
  nextButton(tr("Next"), screen);
  addTouchKeys(view, screen);
}

TrainingScreen sessionScreen(const TrainingView& view) {
  TrainingScreen screen;
  screen.place = TrainingPlace::body;
  screen.corner = view.code;
  const training::Session& session = *view.session;
  addSaid(view, screen);
  addSites(view, screen);
  switch (session.screen()) {
    case Screen::device_check:
      addDeviceCheck(view, screen);
      break;
    case Screen::familiarisation:
      addSink(view, screen);
      if (session.asks()) {
        familiarButtons(view, screen);
      } else {
        screen.lines.insert(screen.lines.begin(), tr("Press one, then the other, until you feel the difference."));
        nextButton(tr("Next"), screen);
        addTouchKeys(view, screen);
      }
      break;
    case Screen::trial:
      addSink(view, screen);
      addProgress(session, screen);
      trialButtons(view, screen);
      break;
    case Screen::feedback:
      addFeedback(view, screen);
      break;
    case Screen::free_exploration:
      addSink(view, screen);
      screen.buttons = {button(TrainingAct::next, tr("Finish"))};
      screen.keys = tr("Enter finishes.");
      addTouchKeys(view, screen);
      break;
    default:
      screen = cardOfSession(view, std::move(screen));
  }
  if (view.waiting && screen.place == TrainingPlace::body) screen.notice = tr(kOneMoment);
  return screen;
}

TrainingScreen stageScreen(const TrainingView& view) {
  switch (view.stage) {
    case TrainingStage::sign_in:
      return signInScreen(view);
    case TrainingStage::new_code:
      return newCodeScreen(view);
    case TrainingStage::own_code:
      return ownCodeScreen(view);
    case TrainingStage::consent:
      return consentScreen(view);
    case TrainingStage::hand:
      return handScreen(view);
    case TrainingStage::choice:
      return choiceScreen(view);
    case TrainingStage::thimble:
      return thimbleChoiceScreen(view);
    case TrainingStage::session:
      return view.lumps != nullptr ? makeLumpScreen(view) : sessionScreen(view);
  }
  return {};
}

// --- overlays

TrainingScreen overScreen(const TrainingView& view) {
  TrainingScreen screen;
  screen.corner = view.code;
  screen.keys = tr(kCardKeys);
  switch (view.over) {
    case TrainingOver::paused:
      screen.title = training::pausedNotice();
      screen.buttons = {button(TrainingAct::go_on, tr("Continue")), button(TrainingAct::leave, tr("Leave"))};
      screen.keys = tr("P or Enter continues, Esc leaves.");
      break;
    case TrainingOver::leaving:
      screen.title = tr("Leave now?");
      screen.lines = {tr("Every answer is saved. Next time you continue from here.")};
      screen.buttons = {button(TrainingAct::no, tr("Stay")), button(TrainingAct::yes, tr("Leave"))};
      break;
    case TrainingOver::trouble:
      screen.title = tr("The last answer is not saved yet");
      screen.lines = {training::withCapital(view.trouble), tr("Nothing is lost: call your teacher, then try again.")};
      screen.trouble = true;
      screen.buttons = {button(TrainingAct::retry, tr("Try again"))};
      screen.keys = tr("Enter tries again.");
      break;
    case TrainingOver::message:
      screen.title = view.message;
      screen.lines = {tr("From your teacher.")};
      screen.buttons = {button(TrainingAct::yes, tr("All right"))};
      screen.keys = tr("Enter continues.");
      break;
    case TrainingOver::none:
      break;
  }
  return screen;
}

}  // namespace

TrainingScreen makeTrainingScreen(const TrainingView& view) {
  TrainingScreen screen = view.over == TrainingOver::none ? stageScreen(view) : overScreen(view);
  if (!view.notice.empty()) screen.notice = view.notice;
  if (!screen.buttons.empty()) screen.focus = std::min(view.focus, screen.buttons.size() - 1);
  return screen;
}

std::vector<std::string> wordsOf(const TrainingScreen& screen) {
  std::vector<std::string> words = {screen.title, screen.progress, screen.notice, screen.keys, screen.corner};
  words.insert(words.end(), screen.lines.begin(), screen.lines.end());
  if (screen.entry) {
    words.push_back(screen.entry->label);
    words.push_back(screen.entry->text);
  }
  for (const TrainingButton& button : screen.buttons) {
    words.insert(words.end(), {button.label, button.line, button.badge});
  }
  for (const SiteMark& site : screen.sites) {
    words.push_back(std::to_string(site.number));
    words.push_back(site.word);
  }
  std::erase(words, std::string());
  return words;
}

}  // namespace palpate::viewer
