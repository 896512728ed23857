// From two pictures of a dotted back to the key ellipse: the pipeline, and everything that it found.
//
//   before ─ findDots ─ growGrid ─┬─ matchDots ─ fitChart ─ fitField ─┬─ judge ─► Measurement ─► table, JSON, overlay
//   after  ─ findDots ────────────┘              readContour ─────────┘
//
// Units: places in pictures px, places on the skin mm of the chart (skin_chart.h), angles degree.
// Based on: Ji, dissertation 2008, section 5.1 (dots, 2 mm contour, ellipse); docs/explanation/measuring.md says what
// is done otherwise and how well it does.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/measure/dot_grid.h"
#include "palpate/measure/field/skin_field.h"
#include "palpate/measure/photograph.h"

namespace palpate::measure {

/// The edge of the picture towards the head.
enum class HeadTowards : unsigned char { top, left, bottom, right };

struct MeasureSettings {
  double spacing_mm = 30.0;  ///< stencil's spacing; 5 to 100
  double drift_mm = 0.4;     ///< motion of the body between the pictures, sd; 0.01 to 20
  HeadTowards head = HeadTowards::top;
  std::optional<Vec2> contact_px = {};  ///< marked place of the stick in the first picture
  bool partial = false;                 ///< the ellipse may leave the dots: nothing is refused for that
};

/// A dot of the grid and what became of it.
struct MeasuredDot {
  GridSite site;
  Vec2 before_px = Vec2::Zero();
  std::optional<Vec2> after_px = {};  ///< none: hidden
  Vec2 skin_mm = Vec2::Zero();        ///< where it lies on the skin, before
  Vec2 moved_mm = Vec2::Zero();       ///< with the drift of the body
  Vec2 drift_mm = Vec2::Zero();       ///< fitted drift in it
  double residual_mm = 0.0;           ///< between measured and fitted
};

/// The body's own motion between the pictures, a similarity in the picture, as the skin's frame sees it.
struct Drift {
  Estimate right_mm;
  Estimate headwards_mm;
  double scale_percent = 0.0;
  double turn_deg = 0.0;
  double length_mm = 0.0;  ///< length of the shift
  double in_sd = 0.0;      ///< fitted shift, scale and turn over their prior sd
};

/// Weight of a form in the report.
struct FormShare {
  FieldForm form = FieldForm::smooth;
  double share = 1.0;
};

struct FieldFit {
  SkinField field;
  KeyEllipse at_2_mm;
  KeyEllipse at_4_mm;
  Estimate contact_x_mm;
  Estimate contact_y_mm;
  std::vector<FormShare> forms;  ///< those that explain the dots about equally well, likeliest first: that of `field`
  std::optional<Estimate> peak_mm;  ///< none where no dot lies in the core: it would only be extrapolated
  Estimate drag_deg;                ///< direction of the peak against +x, in (-180, 180]
  Estimate inverse_tail;            ///< k = 1/P
  Estimate sideways;                ///< kappa
  Drift drift;
  double residual_rms_mm = 0.0;
  double residual_pattern = 0.0;  ///< similarity of neighbouring dots' residuals: 0 by chance, 1 the same
  /// Rim of the dissertation's half Gaussian with the same peak and 2 mm contour (E20); none for a long tail or a peak
  /// under 2 mm.
  std::optional<double> gaussian_rim_mm = {};
  double inside_share = 0.0;  ///< share of the 2 mm ellipse within the dots
};

/// The dissertation's reading: contour of the interpolated field, its longest chord, the ellipse of the contour.
struct ContourReading {
  std::vector<Vec2> contour_2_mm = {};  ///< on the skin, mm; open where it leaves the dots
  std::vector<Vec2> contour_4_mm = {};
  double inside_share = 0.0;                  ///< share of the 2 mm contour within the dots
  double half_chord_mm = 0.0;                 ///< half the longest chord
  double half_across_mm = 0.0;                ///< half the extent across it
  double chord_deg = 0.0;                     ///< in (-90, 90]
  std::optional<maps::Ellipse> ellipse = {};  ///< direct fit to the contour
  bool differs = false;                       ///< by more than 2 sd from the fitted ellipse
};

enum class Severity : unsigned char { refusal, warning };

/// An objection to the result, with its remedy.
struct Finding {
  Severity severity = Severity::refusal;
  std::string code;  ///< for machines, stable: "few_dots", "moved", "swapped", ...
  std::string text;  ///< one or two sentences
};

/// Where a place of the skin lies in the first picture, and back. Exact at the dots up to the smoothing.
class SkinChart;

struct Measurement {
  MeasureSettings settings;
  int width_px = 0;  ///< width of the pictures; 0 when only dots were given
  int height_px = 0;
  Ink ink;
  DotGrid grid;                   ///< grid of the first picture
  std::vector<Dot> after_dots;    ///< all marks of the second
  std::vector<MeasuredDot> dots;  ///< one a dot of the grid
  std::size_t matched = 0;
  std::shared_ptr<const SkinChart> chart;  ///< null without a grid
  std::optional<FieldFit> fit;             ///< none where it could not be tried
  std::optional<ContourReading> contour;
  std::vector<Finding> findings;
  double seconds = 0.0;  ///< run time

  bool accepted() const;
};

/// Input of `measureDots`: all marks of two pictures.
struct DotPair {
  std::vector<Dot> before;
  std::vector<Dot> after;
};

/// Both pictures in the order they were taken, of the same size. Never throws because of the pictures' contents: these
/// become findings. Throws Error for pictures of different size and for settings out of range.
Measurement measurePair(const Photograph& before, const Photograph& after, const MeasureSettings& settings = {},
                        const Progress& progress = {});
/// The same from marks that were found elsewhere, or corrected by hand.
Measurement measureDots(const DotPair& dots, const MeasureSettings& settings = {}, const Progress& progress = {});

/// Motion of the body between two pictures without a press (`--null`): a fit of a similarity alone. The shift's length
/// in mm; none where no grid was found or matched.
std::optional<double> nullDrift(const Photograph& first, const Photograph& second, const MeasureSettings& settings);

}  // namespace palpate::measure
