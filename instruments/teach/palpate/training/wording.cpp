#include "palpate/training/wording.h"

#include <fmt/format.h>

#include <array>

#include "palpate/base/language.h"
#include "palpate/training/learning_curve.h"

namespace palpate::training {

namespace {

constexpr std::array<const char*, 13> kNumberWords = {
    toTranslate("zero"), toTranslate("one"),    toTranslate("two"),   toTranslate("three"), toTranslate("four"),
    toTranslate("five"), toTranslate("six"),    toTranslate("seven"), toTranslate("eight"), toTranslate("nine"),
    toTranslate("ten"),  toTranslate("eleven"), toTranslate("twelve")};

int choiceCount(const Protocol& protocol) {
  return protocol.sites.empty() ? 12 : static_cast<int>(protocol.sites.size());
}

std::string percent(double change) { return fmt::format("{:.0f}", 100.0 * change); }

std::string thresholdSentence(const ThresholdSummary& threshold) {
  if (!threshold.isConclusive()) return tr("More trials are needed to measure your smallest change.");
  return trf("Your smallest reliable change: about {} % ({}–{} %).", percent(threshold.median), percent(threshold.low),
             percent(threshold.high));
}

std::string comparison(const ThresholdSummary& now, const ShownThreshold& before) {
  const ThresholdSummary then{.median = before.median, .low = before.low, .high = before.high};
  if (!now.isConclusive() || !then.isConclusive()) return {};
  const std::string last = " " + trf("Last time: {} %.", percent(before.median));
  return changeBetween(then, now).clear ? last : last + " " + tr("Too early to call a change.");
}

std::string verdictSentence(Verdict verdict) {
  if (verdict == Verdict::pass) return tr("Passed.");
  if (verdict == Verdict::not_yet) return tr("Not yet. Practise, then come again.");
  return tr("Too close to call. Please repeat the examination.");
}

std::string practiceSummary(const BlockResult& result, SessionKind kind) {
  std::string words = tr("Block finished.");
  if (result.trials > 0 || result.excluded == 0) {
    words += " " + trf("{} of {} were right.", result.correct, result.trials);
  }
  if (result.excluded > 0) {
    const auto count = static_cast<std::size_t>(result.excluded);
    words += " " + trnf("{} answer does not count: the place to find was never touched.",
                        "{} answers do not count: the place to find was never touched.", count, count);
  }
  if (kind != SessionKind::mastery) return words;
  if (!result.level) return words + " " + tr("No level was mastered yet.");
  return words + " " + trf("Smallest level mastered: {} %.", percent(*result.level));
}

}  // namespace

std::string withCapital(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

std::string spellNumber(int number) {
  if (number >= 0 && static_cast<std::size_t>(number) < kNumberWords.size()) {
    return tr(kNumberWords[static_cast<std::size_t>(number)]);
  }
  return fmt::format("{}", number);
}

std::string greeting(SessionKind kind) {
  switch (kind) {
    case SessionKind::practice:
      return tr("Practice: after each answer you hear whether it was right.");
    case SessionKind::mastery:
      return tr("Mastery: three of four right leads to the next level.");
    case SessionKind::pre_test:
      return tr("Test before practice. Your answers are saved; there is no feedback.");
    case SessionKind::post_test:
      return tr("Test after practice. Your answers are saved; there is no feedback.");
    case SessionKind::exam:
      return tr("Examination. Your answers are saved; there is no feedback.");
    case SessionKind::retention:
      return tr("Retention test. Your answers are saved; there is no feedback.");
    case SessionKind::free:
      return tr("Free exploration. Feel whatever you like.");
    case SessionKind::lump:
      return tr("Lumps: after each answer you hear whether it was right.");
    case SessionKind::lump_exam:
      return tr("Examination with lumps. Your answers are saved; there is no feedback.");
  }
  return {};
}

std::string instruction(const Protocol& protocol, SessionKind kind) {
  if (kind == SessionKind::free) return tr("Feel whatever you like. Nothing is asked.");
  return trf("One of the {} places is stiffer. Press each, then answer.", spellNumber(choiceCount(protocol)));
}

std::string familiarisation(const Site& stiffer, const Site& normal) {
  return trf("{}, is much stiffer. {}, is normal.", withCapital(spoken(stiffer)), withCapital(spoken(normal)));
}

std::string feelBoth() { return tr("Press both places first, one after the other."); }

std::string stifferQuestion() { return tr("Which of the two is stiffer now? Press both, then answer."); }

std::string familiarFeedback(const Site& stiffer) {
  return trf("It was {}. Feel both again, then press Next.", spoken(stiffer));
}

std::string wrongAnswerReview(const Site& site) { return trf("Your answer was {}. Feel both places.", spoken(site)); }

std::string rightAnswer(const Site& site) { return trf("Correct. {}.", withCapital(spoken(site))); }

std::string wrongAnswer(const Site& site) {
  return trf("It was {}. Feel it now; press Next when ready.", spoken(site));
}

std::string timeIsUp(bool feedback, const Site& site) {
  if (!feedback) return tr("Time is up. Here is the next one.");
  return trf("Time is up. It was {}. Feel it now.", spoken(site));
}

std::string deviceCheck(bool works) {
  return works ? tr("Your device works. Press Next.") : tr("Touch the back once, anywhere.");
}

std::string breakOfferText() { return tr("You may take a break: press Pause."); }

std::string pausedNotice() { return tr("Paused. Nothing counts until you continue."); }

std::string goodbye(bool unfinished) {
  return unfinished ? tr("Saved. Next time you continue from here.") : tr("Saved. Thank you.");
}

std::string answerSaved() { return tr("Answer saved."); }

std::string notPressedYet(int missing) {
  return withCapital(trnf("one place has not been pressed yet.", "{} places have not been pressed yet.",
                          static_cast<std::size_t>(missing), spellNumber(missing)));
}

std::string blockSummary(const BlockResult& result, SessionKind kind, const std::optional<ShownThreshold>& before) {
  switch (kind) {
    case SessionKind::practice:
    case SessionKind::mastery:
      return practiceSummary(result, kind);
    case SessionKind::exam:
      return tr("Examination finished.") + (" " + verdictSentence(result.verdict));
    case SessionKind::pre_test:
    case SessionKind::post_test:
    case SessionKind::retention:
      break;
    case SessionKind::free:
    case SessionKind::lump:
    case SessionKind::lump_exam:
      return tr("Free exploration has ended.");
  }
  const std::string words = thresholdSentence(result.threshold);
  return before ? words + comparison(result.threshold, *before) : words;
}

}  // namespace palpate::training
