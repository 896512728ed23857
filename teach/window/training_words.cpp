#include "teach/window/training_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "palpate/training/wording.h"

namespace palpate::viewer {

namespace {

using training::Screen;
using training::SessionKind;

/// A device that gives this share of the forces, or more, gives them whole.
constexpr double kWholeForce = 0.995;

constexpr const char* kCardKeys = "Arrow keys choose, Enter takes, Esc goes back.";

TrainingButton button(TrainingAct act, std::string label, std::string line = {}) {
  return {.act = act, .label = std::move(label), .line = std::move(line)};
}

std::string withCapitalLetter(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

// --- the front desk

TrainingScreen signInScreen(const TrainingView& view) {
  TrainingScreen screen;
  screen.title = "Welcome";
  screen.lines = {"Type the code on your card, then press Enter."};
  screen.entry = TrainingScreen::Entry{"Code", view.typed};
  screen.buttons = {button(TrainingAct::sign_in, "Sign in"),
                    button(TrainingAct::make_code, "I have no code", "Makes one for you to write down.")};
  screen.keys = "Letters and digits type, Enter signs in.";
  return screen;
}

TrainingScreen newCodeScreen(const TrainingView& view) {
  TrainingScreen screen;
  screen.title = "This code is new here. Continue?";
  screen.entry = TrainingScreen::Entry{"Code", view.code};
  screen.lines = {"Is it the one on your card?"};
  screen.buttons = {button(TrainingAct::yes, "Yes, continue"), button(TrainingAct::no, "No, type it again")};
  screen.keys = kCardKeys;
  return screen;
}

TrainingScreen ownCodeScreen(const TrainingView& view) {
  TrainingScreen screen;
  screen.title = "This is your code";
  screen.entry = TrainingScreen::Entry{"Code", view.code};
  screen.lines = {"Write it down and keep it. It is the only way back to your results."};
  screen.buttons = {button(TrainingAct::yes, "I have written it down"), button(TrainingAct::no, "Back")};
  screen.keys = kCardKeys;
  return screen;
}

TrainingScreen consentScreen(const TrainingView& view) {
  TrainingScreen screen;
  screen.title = "What is kept";
  screen.lines = {"Kept: your answers, their times, and how the finger moved and pressed.",
                  "Not kept: your name, email address or date of birth. You are known only by your code.",
                  "Your teacher sees the results of your code. You may have all of it deleted at any time."};
  screen.buttons = {button(TrainingAct::yes, "I agree"), button(TrainingAct::no, "I do not agree", "Nothing is kept.")};
  screen.corner = view.code;
  screen.keys = kCardKeys;
  return screen;
}

TrainingScreen handScreen(const TrainingView& view) {
  TrainingScreen screen;
  screen.title = "Which hand do you write with?";
  screen.buttons = {button(TrainingAct::choose, "Left"), button(TrainingAct::choose, "Right"),
                    button(TrainingAct::choose, "I would rather not say")};
  for (std::size_t i = 0; i < screen.buttons.size(); ++i) screen.buttons[i].value = static_cast<int>(i);
  screen.corner = view.code;
  screen.keys = kCardKeys;
  return screen;
}

TrainingScreen choiceScreen(const TrainingView& view) {
  TrainingScreen screen;
  screen.title = "What would you like to do?";
  for (std::size_t i = 0; i < view.offers.size(); ++i) {
    const Offer& offer = view.offers[i];
    screen.buttons.push_back({.act = TrainingAct::choose,
                              .value = static_cast<int>(i),
                              .label = offer.name,
                              .line = offer.line,
                              .badge = offer.suggested ? "suggested" : "",
                              .enabled = offer.enabled});
  }
  screen.buttons.push_back(button(TrainingAct::sign_out, "Sign out"));
  screen.corner = view.code;
  screen.keys = kCardKeys;
  return screen;
}

TrainingScreen thimbleScreen(const TrainingView& view) {
  TrainingScreen screen;
  screen.title = "What touches your finger?";
  screen.lines = {fmt::format("The device is {}. Results belong to what you feel with.", view.device)};
  for (std::size_t i = 0; i < kThimbles.size(); ++i) {
    screen.buttons.push_back({.act = TrainingAct::choose,
                              .value = static_cast<int>(i),
                              .label = std::string(kThimbles[i].name),
                              .line = std::string(kThimbles[i].line)});
  }
  screen.corner = view.code;
  screen.keys = kCardKeys;
  return screen;
}

// --- a session

/// What was answered, once it may be shown; 0: nothing.
int ownAnswer(const training::Session& session) {
  const bool shown = session.screen() == Screen::feedback && !session.trials().empty();
  return shown ? session.trials().back().site_answer : 0;
}

std::string wordAt(const SiteMark& mark, const training::Session& session) {
  if (session.screen() == Screen::familiarisation) {
    if (!session.feelsTruth()) return {};
    return mark.is_true ? "stiffer" : "normal";
  }
  if (mark.is_true) return mark.is_own ? "your answer: right" : "feel it here";
  return mark.is_own ? "your answer" : "";
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
  TrainingButton answer = button(TrainingAct::answer, "Answer");
  if (site != nullptr) answer.label = fmt::format("Answer: {}", training::spoken(*site));
  answer.enabled = site != nullptr && !view.waiting;
  return answer;
}

void familiarButtons(const TrainingView& view, TrainingScreen& screen) {
  screen.buttons = {answerButton(view), button(TrainingAct::leave, "Leave")};
  screen.keys = view.by_mouse ? "Number and Enter answer. Arrows go to the other place, Space presses and lifts. "
                                "Esc leaves."
                              : "Number and Enter answer, or the device's button on the place. Esc leaves.";
}

void trialButtons(const TrainingView& view, TrainingScreen& screen) {
  screen.buttons = {answerButton(view), button(TrainingAct::pause, "Pause"), button(TrainingAct::leave, "Leave")};
  screen.keys = view.by_mouse ? "Number and Enter answer. Arrows go from place to place, Space presses and lifts. "
                                "P pauses, Esc leaves."
                              : "Number and Enter answer, or the device's button on the place. P pauses, Esc leaves.";
  if (!view.waiting) screen.time_left = view.session->shareOfTimeLeft(view.now);
}

/// Practice alone says how far it is and what was right.
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
  screen.progress = fmt::format("Trial {} of {}", std::max(1, shown), most);
  if (!trials.empty()) screen.progress += fmt::format(" · {} of {} right", right, trials.size());
}

void nextButton(const char* label, TrainingScreen& screen) {
  screen.buttons = {button(TrainingAct::next, label), button(TrainingAct::leave, "Leave")};
  screen.keys = "Space or Enter goes on, Esc leaves.";
}

/// The mouse gives the hand nothing: the eye sees how far the finger sinks. The same words, rings and close view
/// wherever it presses, so they tell no more than a hand would feel.
void addSink(const TrainingView& view, TrainingScreen& screen) {
  if (!view.by_mouse) return;
  screen.shows_sink = true;
  screen.lines.emplace_back("Watch how far it sinks: fewer rings, stiffer. Right-drag turns the body.");
}

/// Without a device the finger goes by keys, too.
void addTouchKeys(const TrainingView& view, TrainingScreen& screen) {
  if (view.by_mouse) screen.keys += " Arrows go from place to place, T presses and lifts.";
}

/// The sentence of the session is what is read first; a trial's own stands above what has just been said.
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
                      "A dot fills when its place has been pressed enough. The ring shows the time."};
      if (session.plan().kind == SessionKind::mastery) screen.lines.pop_back();
      nextButton("Start", screen);
      return screen;
    case Screen::block_summary:
      nextButton(session.showsProgress() ? "Another block" : "Finish", screen);
      screen.buttons.back().label = "Finish";
      if (!session.showsProgress()) screen.buttons.pop_back();
      return screen;
    default:
      screen.buttons = {button(TrainingAct::next, "Back to the choice")};
      screen.keys = "Space or Enter goes on.";
      return screen;
  }
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
      screen.sites.clear();
      if (view.by_mouse) {
        screen.lines = {"Press with the left mouse button on the back. The wheel presses harder."};
        screen.shows_sink = true;
      }
      if (view.force_share < kWholeForce) {
        screen.lines.push_back(
            fmt::format("This device gives {:.0f} % of every force: all places feel softer to the same degree.",
                        100.0 * view.force_share));
      }
      if (view.ratios_kept_to_n > 0.0) {
        screen.lines.push_back(
            fmt::format("Above {:.2g} N differences are harder to feel: press more gently.", view.ratios_kept_to_n));
      }
      nextButton("Next", screen);
      addTouchKeys(view, screen);
      break;
    case Screen::familiarisation:
      addSink(view, screen);
      if (session.asks()) {
        familiarButtons(view, screen);
      } else {
        screen.lines.insert(screen.lines.begin(), "Press one, then the other, until you feel the difference.");
        nextButton("Next", screen);
        addTouchKeys(view, screen);
      }
      break;
    case Screen::trial:
      addSink(view, screen);
      addProgress(session, screen);
      trialButtons(view, screen);
      break;
    case Screen::feedback:
      addProgress(session, screen);
      if (!session.trials().empty()) {
        const training::TrialRow& trial = session.trials().back();
        screen.outcome = trial.correct ? TrainingScreen::Outcome::right : TrainingScreen::Outcome::wrong;
        const training::Site* own = session.plan().sites.numbered(trial.site_answer);
        if (own != nullptr && !trial.correct) screen.lines.push_back(training::yourAnswerWas(*own));
      }
      addSink(view, screen);
      nextButton("Next", screen);
      addTouchKeys(view, screen);
      break;
    case Screen::free_exploration:
      addSink(view, screen);
      screen.buttons = {button(TrainingAct::next, "Finish")};
      screen.keys = "Enter finishes.";
      addTouchKeys(view, screen);
      break;
    default:
      screen = cardOfSession(view, std::move(screen));
  }
  if (view.waiting && screen.place == TrainingPlace::body) screen.notice = kOneMoment;
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
      return thimbleScreen(view);
    case TrainingStage::session:
      return sessionScreen(view);
  }
  return {};
}

// --- what lies over it

TrainingScreen overScreen(const TrainingView& view) {
  TrainingScreen screen;
  screen.corner = view.code;
  screen.keys = kCardKeys;
  switch (view.over) {
    case TrainingOver::paused:
      screen.title = training::pausedWords();
      screen.buttons = {button(TrainingAct::go_on, "Go on"), button(TrainingAct::leave, "Leave")};
      screen.keys = "P or Enter goes on, Esc leaves.";
      break;
    case TrainingOver::leaving:
      screen.title = "Leave now?";
      screen.lines = {"Every answer is saved. Next time you continue from here."};
      screen.buttons = {button(TrainingAct::no, "Stay"), button(TrainingAct::yes, "Leave")};
      break;
    case TrainingOver::trouble:
      screen.title = "The last answer is not saved yet";
      screen.lines = {withCapitalLetter(view.trouble), "Nothing is lost: call your teacher, then try again."};
      screen.trouble = true;
      screen.buttons = {button(TrainingAct::retry, "Try again")};
      screen.keys = "Enter tries again.";
      break;
    case TrainingOver::message:
      screen.title = view.message;
      screen.lines = {"From your teacher."};
      screen.buttons = {button(TrainingAct::yes, "All right")};
      screen.keys = "Enter goes on.";
      break;
    case TrainingOver::none:
      break;
  }
  return screen;
}

}  // namespace

TrainingScreen screenOf(const TrainingView& view) {
  TrainingScreen screen = view.over == TrainingOver::none ? stageScreen(view) : overScreen(view);
  if (!view.notice.empty()) screen.notice = view.notice;
  if (!screen.buttons.empty()) screen.focus = std::min(view.focus, screen.buttons.size() - 1);
  return screen;
}

}  // namespace palpate::viewer
