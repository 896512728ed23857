// One number of the dissertation and ours, how near the two are, and a remark.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/fidelity.h"
#include "palpate/base/words.h"

namespace palpate::study {

/// Source of our number.
enum class Source : std::uint8_t {
  engine,   ///< the engine's own code: a formula, a tree, a map
  printed,  ///< other numbers of the text alone (a reciprocal, a ratio, a mean): whether the text agrees with itself
};

enum class Verdict : std::uint8_t {
  from_engine,     ///< reproduced by the engine: ours lies within the row's tolerance
  arithmetic,      ///< follows from other printed numbers, within the row's tolerance
  misprint,        ///< ours is not the printed number but the one that an erratum names in its place
  not_reproduced,  ///< ours differs and nothing explains it: the study fails
  inconsistent,    ///< a statement that the text's own numbers contradict
  not_computable,  ///< needs the author's computer, scan or subjects
};

struct NumberRow {
  std::string where;    ///< section, table or figure, and the place in it
  std::string what;     ///< the quantity
  std::string printed;  ///< as printed
  std::string ours;     ///< with two digits more; empty where there is nothing to compute
  Verdict verdict = Verdict::from_engine;
  Erratum erratum = Erratum::none;  ///< erratum that explains it
  std::string reason;               ///< our calculation, or why it differs
  std::string tolerance;            ///< limit of the difference; empty where there is nothing to compute
  std::optional<double> off_percent = std::nullopt;  ///< ours over the printed number, where both are one number
};

/// True for the verdicts about numbers that can be computed: these decide whether the study holds.
inline bool decides(Verdict verdict) { return verdict != Verdict::inconsistent && verdict != Verdict::not_computable; }

/// Verdict of a row that agrees.
inline Verdict reproducedFrom(Source source) {
  return source == Source::engine ? Verdict::from_engine : Verdict::arithmetic;
}

/// True when no number that can be computed differs without an erratum that names why.
bool studyHolds(const std::vector<NumberRow>& rows);

int countRows(const std::vector<NumberRow>& rows, Verdict verdict);

/// A number as a text prints it: 1/3 is {"1/3"}, 3.04 has two decimals. Throws Error for anything else.
struct PrintedNumber {
  double value = 0.0;
  double tolerance = 0.0;  ///< half of the last printed digit; 0 for a fraction
  int decimals = 0;
};
PrintedNumber parsePrinted(std::string_view text);

/// True when `ours` rounds to the printed number.
bool agrees(std::string_view printed, double ours);

/// 100 (ours / printed - 1); nothing for a printed 0.
std::optional<double> offPercent(double printed, double ours);

/// The row of a number that can be computed; its tolerance is half of the last printed digit. One that does not agree
/// is a misprint when the list of misprints (number_row.cpp) has this printed number at this place and ours rounds to
/// the number that the list has instead; it is not reproduced otherwise.
NumberRow judged(std::string where, std::string what, const std::string& printed, double ours, std::string reason,
                 Source source = Source::engine);

}  // namespace palpate::study

namespace palpate {

template <>
struct WordsOf<study::Verdict> {
  using V = study::Verdict;
  static constexpr std::array kAll = {
      Word{"from our engine", V::from_engine}, Word{"arithmetic of printed numbers", V::arithmetic},
      Word{"misprint", V::misprint},           Word{"NOT REPRODUCED", V::not_reproduced},
      Word{"inconsistent", V::inconsistent},   Word{"not computable", V::not_computable}};
};

}  // namespace palpate
