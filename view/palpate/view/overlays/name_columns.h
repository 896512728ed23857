// Plates of names left and right of the body, each level with its place as far as its neighbours allow.
//
// Pure: points of a page in, plates out; no GL, no letters. The same tags give the same plates.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "palpate/view/overlays/plates.h"

namespace palpate::view {

struct NameTag {
  Vec2f dot = Vec2f::Zero();   ///< the place on the page
  Vec2f size = Vec2f::Zero();  ///< of its plate
  int rank = 0;                ///< those of the highest rank go first where there is no room
  bool in_middle = false;      ///< of the spine: while it is upright, all of these go to one side
};

struct NamePlate {
  std::size_t tag = 0;
  LabelBox box;
  Vec2f line_from = Vec2f::Zero();  ///< at the plate's edge; the line ends at the dot
};

/// What the columns keep within and out of.
struct NameGround {
  LabelBox page;
  float body_left = 0.0f;  ///< silhouette: columns stand outside it where the page has room, else over the skin
  float body_right = 0.0f;
  std::span<const LabelBox> taken = {};
};

/// No plate lies on another one, on what is taken or on a dot of a plate; tags that find no room have none.
std::vector<NamePlate> nameColumns(std::span<const NameTag> tags, const NameGround& ground);

}  // namespace palpate::view
