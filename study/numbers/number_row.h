// One number of the dissertation beside ours, and what is to be said about it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/fidelity.h"
#include "palpate/base/words.h"

namespace palpate::study {

enum class Verdict {
  reproduced,      ///< ours, rounded as the text does, is the printed number
  misprint,        ///< ours differs, and an erratum says why
  not_reproduced,  ///< ours differs and nothing explains it: the study fails
  inconsistent,    ///< a statement that the text's own numbers contradict
  not_computable,  ///< needs the author's computer, scan or subjects
};

struct NumberRow {
  std::string where;    ///< section, table or figure, and the place in it
  std::string what;     ///< the quantity
  std::string printed;  ///< as printed
  std::string ours;     ///< with two digits more; empty where there is nothing to compute
  Verdict verdict = Verdict::reproduced;
  Erratum erratum = Erratum::none;  ///< that explains it
  std::string reason;               ///< how ours is computed, or why it differs
};

/// True for the verdicts about numbers that can be computed: these decide whether the study holds.
inline bool decides(Verdict verdict) {
  return verdict == Verdict::reproduced || verdict == Verdict::misprint || verdict == Verdict::not_reproduced;
}

/// True when no number that can be computed differs without an erratum that names why.
bool studyHolds(const std::vector<NumberRow>& rows);

int countOf(const std::vector<NumberRow>& rows, Verdict verdict);

/// A number as a text prints it: 1/3 is {"1/3"}, 3.04 has two decimals. Throws Error for anything else.
struct PrintedNumber {
  double value = 0.0;
  double tolerance = 0.0;  ///< half of the last printed digit; 0 for a fraction
  int decimals = 0;
};
PrintedNumber parsePrinted(std::string_view text);

/// True when `ours` rounds to the printed number.
bool agrees(std::string_view printed, double ours);

/// The row of a number that can be computed. One that does not agree is a misprint when the list of misprints
/// (number_row.cpp) has this printed number at this place, and not reproduced otherwise.
NumberRow judged(std::string where, std::string what, const std::string& printed, double ours, std::string reason);

}  // namespace palpate::study

namespace palpate {

template <>
struct WordsOf<study::Verdict> {
  using V = study::Verdict;
  static constexpr std::array kAll = {Word{"reproduced", V::reproduced}, Word{"misprint", V::misprint},
                                      Word{"NOT REPRODUCED", V::not_reproduced}, Word{"inconsistent", V::inconsistent},
                                      Word{"not computable", V::not_computable}};
};

}  // namespace palpate
