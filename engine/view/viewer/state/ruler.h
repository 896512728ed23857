// Measuring between two places of the skin at rest: straight through, and along the skin. Pure.
#pragma once

#include <string>
#include <vector>

#include "palpate/base/skin_place.h"
#include "palpate/contact/surface.h"
#include "palpate/view/lines.h"

namespace palpate::viewer {

struct Ruler {
  bool active = false;               ///< the left button sets its ends
  std::vector<SkinPlace> ends = {};  ///< none, one or two
  std::vector<SkinPlace> path = {};  ///< over the skin from one end to the other
  Vec2 label = Vec2::Zero();         ///< place of its text, points; in this frame
};

/// A click: sets the first end, the second, or a new first one.
void measureAt(const SkinPlace& place, const contact::Surface& surface, Ruler& ruler);

double straightMm(const Ruler& ruler);
/// Along places of the skin nearest to the straight line: on a back within a per cent of the shortest way.
double alongSkinMm(const Ruler& ruler);

/// Its result for two ends; empty before.
std::string formatRuler(const Ruler& ruler);
/// The line over the skin and its ends.
std::vector<view::Lines> rulerLines(const Ruler& ruler);

}  // namespace palpate::viewer
