// What the lines and patches of the overlays mean: a plate of signs in their colours, each with its words.
#pragma once

#include <string_view>
#include <vector>

#include "palpate/view/lines.h"
#include "palpate/view/look.h"
#include "palpate/view/overlays/plates.h"

namespace palpate::view {

struct KeyEntry {
  enum class Sign : std::uint8_t { line, cross, arrow, patch };
  Sign sign = Sign::line;
  Paint paint{};
  std::string words;
};

/// A row for everything that the look draws over the skin, in the order of the overlays, and one for dents that are
/// shaded more strongly than light would.
std::vector<KeyEntry> overlayKey(const Look& look);

/// Where the plate may lie, points: rows go down, then to the right; those that find no room are left out.
struct KeyPlace {
  Vec2f corner = Vec2f::Zero();
  Vec2f room = Vec2f::Zero();
};

/// Draws it and returns what it covers; nothing for no entries.
LabelBox drawOverlayKey(Drawing& page, const std::vector<KeyEntry>& entries, const KeyPlace& place,
                        const LabelInks& inks);

}  // namespace palpate::view
