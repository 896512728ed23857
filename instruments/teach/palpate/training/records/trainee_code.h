// The code that a trainee types to sign in, and its pseudonym: any station derives the same from the same code, so no
// list has to be carried from one to the other. The code gives away the pseudonym; names stay outside.
//
//   "7Q2MK-9DXP4" ─ derivePseudonym ─► UUID version 8: 122 bits of HMAC-SHA-256 of class and code with the class's
//   secret;
//                                  of a class without a secret, SHA-256
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "palpate/training/records/rows.h"

namespace palpate::training {

/// Nine random letters and digits of Crockford's alphabet (45 bits) and one that checks them.
std::string makeTraineeCode(std::uint64_t random_bits);
/// The code as written on a card, whatever was typed (lower case, O for 0, blanks); nothing: a typing error, or no
/// code.
std::optional<std::string> codeTyped(std::string_view typed);
/// `key`: the class's secret (64 hex digits), without which a card does not reveal its pseudonym; empty: none.
Uuid derivePseudonym(std::string_view class_id, std::string_view code, std::string_view key = {});

/// UUID version 8 that any computer makes of the same text.
Uuid uuidOfText(std::string_view text);

/// UUID version 7. `random` may be anything that does not repeat.
Uuid makeUuidV7(std::int64_t unix_ms, const std::array<std::uint64_t, 2>& random);

/// 128 bits of the system's own randomness. Throws Error.
std::array<std::uint64_t, 2> systemRandom();
std::int64_t utcMs();

}  // namespace palpate::training
