// What scene files and commands call the ways to find the leaves that the detecting box meets. The only place that
// knows: everybody else looks words and traversals up here.
#pragma once

#include <array>
#include <optional>

#include "palpate/partition/literal_traversal.h"

namespace palpate::partition {

struct TraversalWord {
  const char* word;
  std::optional<LiteralTraversal> literal;  ///< none: findLeaves, which misses nothing
};

inline constexpr std::array<TraversalWord, 5> kTraversalWords = {{
    {"tight", std::nullopt},
    {"else-if", LiteralTraversal::ElseIf},
    {"half-space", LiteralTraversal::HalfSpace},
    {"cell-box", LiteralTraversal::CellBox},
    {"sphere-corners", LiteralTraversal::SphereCorners},
}};

}  // namespace palpate::partition
