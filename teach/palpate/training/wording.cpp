#include "palpate/training/wording.h"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "palpate/training/learning_curve.h"

namespace palpate::training {

namespace {

constexpr std::array<std::string_view, 13> kNumberWords = {"zero",  "one",   "two",  "three", "four",   "five",  "six",
                                                           "seven", "eight", "nine", "ten",   "eleven", "twelve"};

std::string withCapital(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

int choicesOf(const Protocol& protocol) {
  return protocol.sites.empty() ? 12 : static_cast<int>(protocol.sites.size());
}

std::string percent(double change) { return fmt::format("{:.0f}", 100.0 * change); }

std::string thresholdWords(const ThresholdSummary& threshold) {
  if (!threshold.telling()) return "More trials are needed to measure your smallest change.";
  return fmt::format("Your smallest reliable change: about {} % ({}–{} %).", percent(threshold.median),
                     percent(threshold.low), percent(threshold.high));
}

std::string comparison(const ThresholdSummary& now, const ShownThreshold& before) {
  const ThresholdSummary then{.median = before.median, .low = before.low, .high = before.high};
  if (!now.telling() || !then.telling()) return {};
  const std::string last = fmt::format(" Last time: {} %.", percent(before.median));
  return changeBetween(then, now).clear ? last : last + " Too early to call a change.";
}

std::string verdictWords(Verdict verdict) {
  if (verdict == Verdict::pass) return "Passed.";
  if (verdict == Verdict::not_yet) return "Not yet. Practise, then come again.";
  return "Too close to call. Please repeat the examination.";
}

std::string practiceWords(const BlockResult& result, SessionKind kind) {
  const std::string right = fmt::format("{} of {} were right.", result.correct, result.trials);
  if (kind != SessionKind::mastery) return "Block finished. " + right;
  if (!result.level) return "Block finished. " + right + " No level was mastered yet.";
  return fmt::format("Block finished. {} Smallest level mastered: {} %.", right, percent(*result.level));
}

}  // namespace

std::string numberInWords(int number) {
  if (number >= 0 && static_cast<std::size_t>(number) < kNumberWords.size()) {
    return std::string(kNumberWords[static_cast<std::size_t>(number)]);
  }
  return fmt::format("{}", number);
}

std::string greeting(SessionKind kind) {
  switch (kind) {
    case SessionKind::practice:
      return "Practice: after each answer you hear whether it was right.";
    case SessionKind::mastery:
      return "Mastery: three of four right leads to the next level.";
    case SessionKind::pre_test:
      return "Test before practice. Your answers are saved; there is no feedback.";
    case SessionKind::post_test:
      return "Test after practice. Your answers are saved; there is no feedback.";
    case SessionKind::exam:
      return "Examination. Your answers are saved; there is no feedback.";
    case SessionKind::retention:
      return "Retention test. Your answers are saved; there is no feedback.";
    case SessionKind::free:
      return "Free exploration. Feel whatever you like.";
  }
  return {};
}

std::string instruction(const Protocol& protocol, SessionKind kind) {
  if (kind == SessionKind::free) return "Feel whatever you like. Nothing is asked.";
  return fmt::format("One of the {} places is stiffer. Press each, then answer.", numberInWords(choicesOf(protocol)));
}

std::string familiarisation(const Site& stiffer, const Site& normal) {
  return fmt::format("{}, is much stiffer. {}, is normal.", withCapital(spoken(stiffer)), withCapital(spoken(normal)));
}

std::string feelBoth() { return "Press both places first, one after the other."; }

std::string whichIsStiffer() { return "Which of the two is stiffer now? Press both, then answer."; }

std::string familiarAgain(const Site& stiffer) {
  return fmt::format("It was {}. Feel both again, then press Next.", spoken(stiffer));
}

std::string yourAnswerWas(const Site& site) {
  return fmt::format("Your answer was {}. Feel both places.", spoken(site));
}

std::string rightAnswer(const Site& site) {
  return withCapital(fmt::format("Correct. {}.", withCapital(spoken(site))));
}

std::string wrongAnswer(const Site& site) {
  return fmt::format("It was {}. Feel it now; press Next when ready.", spoken(site));
}

std::string timeIsUp(bool feedback, const Site& site) {
  if (!feedback) return "Time is up. Here is the next one.";
  return fmt::format("Time is up. It was {}. Feel it now.", spoken(site));
}

std::string deviceCheck(bool works) {
  return works ? "Your device works. Press Next." : "Touch the back once, anywhere.";
}

std::string breakOffered() { return "You may take a break: press Pause."; }

std::string pausedWords() { return "Paused. Nothing counts until you go on."; }

std::string goodbye(bool unfinished) {
  return unfinished ? "Saved. Next time you continue from here." : "Saved. Thank you.";
}

std::string answerSaved() { return "Answer saved."; }

std::string notPressedYet(int missing) {
  return withCapital(missing == 1 ? "one place has not been pressed yet."
                                  : fmt::format("{} places have not been pressed yet.", numberInWords(missing)));
}

std::string blockSummary(const BlockResult& result, SessionKind kind, const std::optional<ShownThreshold>& before) {
  switch (kind) {
    case SessionKind::practice:
    case SessionKind::mastery:
      return practiceWords(result, kind);
    case SessionKind::exam:
      return "Examination finished. " + verdictWords(result.verdict);
    case SessionKind::pre_test:
    case SessionKind::post_test:
    case SessionKind::retention:
      break;
    case SessionKind::free:
      return "Free exploration has ended.";
  }
  const std::string words = thresholdWords(result.threshold);
  return before ? words + comparison(result.threshold, *before) : words;
}

}  // namespace palpate::training
