// The measuring view on the screen: a column of settings and results, and the photographs next to it.
#pragma once

#include <string>
#include <vector>

#include "measure/window/measuring_view.h"
#include "palpate/base/language.h"
#include "palpate/measure/measurement.h"
#include "view/viewer/panels/panels.h"

namespace palpate::viewer {

/// Fills the area, in a Gui frame that has begun.
void measuringWindow(MeasuringView& view, const FreeArea& free, MeasuringRequests& requests);

// Everything of the measuring view but the photographs: their names, tools, settings, findings, accepting.

/// Label of MeasureSettings::partial.
inline constexpr const char* kPartialBox = toTranslate("may leave the dots");

/// In the window that is being drawn.
void measuringColumn(MeasuringView& view, MeasuringRequests& requests);

// A photograph with the findings in it, to be zoomed, shifted, clicked and dragged on.

/// Contents of a panel.
struct PhotoPanel {
  Photo photo = Photo::before;
  const measure::OverlayPanel* overlay = nullptr;  ///< or none yet
  bool faded = false;
  const char* path = "";  ///< "measuring/before"
};
/// In the rest of the window that is being drawn, so wide and high.
void photoPanel(MeasuringView& view, const PhotoPanel& panel, const Vec2& size);

// Measured numbers with their standard deviations, as lines of text.

struct MeasuredNumber {
  std::string label;
  std::string value;
};
/// Empty without a fit.
std::vector<MeasuredNumber> measuredNumbers(const measure::Measurement& measured);

/// A finding's text, with the window's names for the remedy: a box in place of an option of the command.
std::string findingText(const measure::Finding& finding);

/// "71.3 ± 1.2 mm", with `digits` decimals.
std::string withSd(const measure::Estimate& estimate, int digits, const char* unit);

}  // namespace palpate::viewer
