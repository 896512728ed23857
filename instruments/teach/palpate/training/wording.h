// Texts that people read and hear: one place for every sentence, at most 12 words each, no blame, no numbers in a test.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "palpate/training/protocol.h"

namespace palpate::training {

/// The threshold reported at the end of a measuring block, and that of the one before it.
struct ShownThreshold {
  double median = 0.0, low = 0.0, high = 0.0;
};

std::string greeting(SessionKind kind);  ///< "Practice: you will hear whether you were right."
std::string instruction(const Protocol& protocol,
                        SessionKind kind);  ///< "One of the twelve places is stiffer. Press each, then answer."
std::string familiarisation(const Site& stiffer,
                            const Site& normal);  ///< "Site 4, left, is much stiffer. Site 10, right, is normal."
std::string feelBoth();                           ///< "Press both places first."
std::string stifferQuestion();
std::string familiarFeedback(const Site& stiffer);  ///< "It was site 4, left. Feel both again."
std::string wrongAnswerReview(const Site& site);    ///< "Your answer was site 4, left. Feel both places."
std::string rightAnswer(const Site& site);          ///< "Correct. Site 4, left."
std::string wrongAnswer(const Site& site);          ///< "It was site 9, right. Feel it now; press Next when ready."
std::string timeIsUp(bool feedback, const Site& site);
std::string deviceCheck(bool works);  ///< "Touch the back once, anywhere."
std::string breakOfferText();
std::string pausedNotice();
std::string goodbye(bool unfinished);
std::string answerSaved();               ///< tests
std::string notPressedYet(int missing);  ///< "Two places were not pressed yet."
std::string blockSummary(const BlockResult& result, SessionKind kind, const std::optional<ShownThreshold>& before);
std::string spellNumber(int number);  ///< "two"; digits above twelve
/// The first letter, where it is one of English; others stay.
std::string withCapital(std::string text);

}  // namespace palpate::training
