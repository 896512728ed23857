// Which of the dissertation's formulae are taken as printed and which as corrected.
//
// The checked errata E1 to E34 (scene/errata.h has their texts) each name a place where the printed text is wrong,
// ambiguous or incomplete. Everything is corrected by default; the literal forms live in files of their own, which ask
// this set which of them are wanted, so that a published result can be reproduced or one erratum studied alone.
#pragma once

#include <bitset>

namespace palpate {

/// Numbered as in the list of errata, from E1.
using Erratum = int;
inline constexpr Erratum kLastErratum = 34;

/// Plain data. Any thread.
class Fidelity {
 public:
  /// True where the printed form is wanted; false for a number that is not an erratum.
  bool literal(Erratum erratum) const { return isErratum(erratum) && literal_[erratum]; }
  /// Numbers that are not an erratum are ignored.
  void setLiteral(Erratum erratum, bool literal = true) {
    if (isErratum(erratum)) literal_[erratum] = literal;
  }
  void setAll(bool literal) {
    for (Erratum e = 1; e <= kLastErratum; ++e) literal_[e] = literal;
  }
  bool anyLiteral() const { return literal_.any(); }

  friend bool operator==(const Fidelity&, const Fidelity&) = default;

 private:
  static constexpr bool isErratum(Erratum e) { return e >= 1 && e <= kLastErratum; }
  std::bitset<kLastErratum + 1> literal_;  // bit 0 is not used
};

inline Fidelity literalFidelity() {
  Fidelity fidelity;
  fidelity.setAll(true);
  return fidelity;
}

}  // namespace palpate
