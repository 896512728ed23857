// The checked errata of the dissertation, E1 to E34: what is printed, what this engine does instead, and whether the
// printed form can be switched on.
//
// The list is what docs/reference/dissertation.md explains at length and `palpate study errata` measures. The set of
// errata taken literally is a Fidelity (base/fidelity.h); scene files and commands name it with the words read here.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/fidelity.h"

namespace palpate::scene {

enum class Severity : std::uint8_t {
  wrong,      ///< the printed formula cannot be right
  ambiguous,  ///< several readings; a decision was needed
  cosmetic,   ///< misprints and loose words
};

enum class LiteralForm : std::uint8_t {
  switchable,  ///< fidelity.E<n> = "literal" brings the printed form back
  setting,     ///< both readings are settings of their own, named in ErratumText::choice
  none,        ///< no printed form that could be computed, or nothing to compute
};

/// The form that the engine uses unless the scene chooses one.
enum class ByDefault : std::uint8_t {
  corrected,   ///< what the erratum says instead of the text
  as_printed,  ///< the text's form, though the erratum doubts it
  own_choice,  ///< a value of this engine, where the text gives none or one that does not fit what is known of tissue
};

/// How a formula is taken: what `fidelity` says of all errata or of one.
enum class Reading : std::uint8_t { corrected, literal };

struct ErratumText {
  Erratum erratum = Erratum::none;
  Severity severity = Severity::cosmetic;
  LiteralForm form = LiteralForm::none;
  ByDefault by_default = ByDefault::corrected;
  std::string_view printed;  ///< what the text says or leaves open
  std::string_view ours;     ///< what the engine does
  std::string_view choice;   ///< switchable: what the switch acts on. setting: its name. none: why it has no switch
};

/// All of them, in order: errata()[0] is E1.
std::span<const ErratumText> errata();

/// Those that stand so by default, in order.
std::vector<Erratum> errataByDefault(ByDefault by_default);

/// "E14"
std::string nameOf(Erratum erratum);

/// The one of "E14" or "e14"; Erratum::none for another text.
Erratum erratumNamed(std::string_view name);

/// "corrected", "literal", or a list such as "E14,E29" of errata to take literally. Throws Error for anything else,
/// and for an erratum without a literal form, saying why.
Fidelity parseFidelity(std::string_view words);

/// Throws Error if the erratum cannot be switched.
void requireSwitchable(Erratum erratum);

/// The words parseFidelity reads back.
std::string wordsOf(const Fidelity& fidelity);

}  // namespace palpate::scene
