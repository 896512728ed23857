// The overlay of a measurement painted over its photographs: three panels side by side, what their marks mean below
// them, then the verdict and its reasons.
//
//   Overlay (measure/overlay.h), two photographs ─► PNG, SVG
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "palpate/measure/overlay.h"
#include "palpate/measure/photograph.h"
#include "report/charts/figure.h"

namespace palpate::figures {

struct OverlayPage {
  measure::Overlay overlay;
  /// Null where only dots were given: the panels are blank then.
  const measure::Photograph* before = nullptr;
  const measure::Photograph* after = nullptr;
  double width_px = 1240.0;  ///< CSS pixels, of the whole page
};

std::string overlayPng(const OverlayPage& page, double scale = 1.0);
std::string overlaySvg(const OverlayPage& page);
std::vector<DrawnText> collectDrawnTexts(const OverlayPage& page);

/// Writes PNG or SVG, by the name's extension. Throws Error.
void writeOverlay(const OverlayPage& page, const std::filesystem::path& file, double scale = 1.0);

}  // namespace palpate::figures
