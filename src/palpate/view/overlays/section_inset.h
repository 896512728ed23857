// The cut through a contact as a small chart: the skin at rest and deformed, both axes in mm (Fig 4.7).
#pragma once

#include <span>

#include "palpate/view/layers/drawing.h"
#include "palpate/view/overlays/section.h"

namespace palpate::view {

struct SectionChart {
  Vec2f corner = Vec2f::Zero();  ///< upper left
  Vec2f size = {240.0f, 120.0f};
};

/// How far the chart reaches to either side of the contact, mm.
inline constexpr double kSectionHalfWidthMm = 40.0;

/// Heights are drawn larger than widths: the numbers at the axes tell by how much. Nothing for an empty curve.
void drawSection(Drawing& page, std::span<const SectionPoint> curve, const SectionChart& chart);

}  // namespace palpate::view
