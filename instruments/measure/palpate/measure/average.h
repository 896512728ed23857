// Several presses and several people -> one ellipse a point, with how sure it is.
//
//   PressRow rows (press_table.h) ─ averagePresses ─► Averages ─► key points for maps, text, picture
//
// Rows are gathered by point and by the way the skin was pulled (sectors of 45 degrees). Presses of one person are
// averaged first, then people, each of whom counts the same; then the drags of a point. Means are those of the
// logarithms of the ellipses' tensors (E29, E30), or plain as the dissertation prints them. The scatter that is seen
// makes the standard error; with few presses it is drawn towards the scatter of all points, as if that were two more.
//
// One drag says nothing of the tissue's own direction: skin of any tissue gives way along the drag (E34). Two drags 60
// degrees or more apart separate the stretch along the drag from the tissue's ellipse, which is what the table then
// holds.
// Based on: Ji, dissertation 2008, section 5.1; Arsigny and others 2006 (ellipse.h). The rest is own;
// docs/explanation/measuring.md.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "palpate/maps/key_points.h"
#include "palpate/measure/field/skin_field.h"
#include "palpate/measure/press_table.h"

namespace palpate::measure {

struct AverageSettings {
  maps::Averaging averaging = maps::Averaging::tensorial;
  std::optional<double> drag_deg = {};  ///< only presses of this way of pulling
  /// Unmeasured points to fill in as mirror images from the other side of the spine: from, to.
  std::vector<std::pair<std::string, std::string>> mirrors = {};
};

/// The mean of some presses.
struct MeanEllipse {
  maps::Ellipse ellipse;
  // With standard errors; NaN where one press without a stated uncertainty determines nothing.
  Estimate half_major_mm;
  Estimate major_over_minor;
  Estimate direction_deg;          ///< in (-90, 90]; an error of 52 means undetermined
  Mat3 covariance = Mat3::Zero();  ///< covariance of the tensor's logarithm (maps::LogTensor)
  double freedom = 0.0;            ///< degrees of freedom behind it; 0: not known
  std::size_t subjects = 0;
  std::size_t presses = 0;
  double resultant = 1.0;          ///< agreement of the presses' directions: 1 all alike, 0 none preferred
  bool hardly_determined = false;  ///< the direction: its error is above 10 degrees, or the resultant below 0.6
};

struct DragMean {
  std::optional<double> drag_deg = {};  ///< mean of the presses' own; none: not in the rows
  MeanEllipse mean;
};

struct PointMean {
  std::string name;
  Vec2 place_mm = Vec2::Zero();
  std::vector<DragMean> drags;              ///< at least one
  MeanEllipse mean;                         ///< over the drags; the tissue's own where along_drag is known
  std::optional<Estimate> along_drag = {};  ///< ratio by which a drag stretches the ellipse along itself
  std::optional<double> half_major_4_mm = {};
  std::optional<double> peak_mm = {};
  std::optional<double> stiffness_n_per_mm = {};
  std::string mirrored_from = {};  ///< empty: measured

  bool knowsTissue() const { return along_drag.has_value(); }
};

struct Averages {
  AverageSettings settings;
  std::vector<PointMean> points;  ///< in the order in which the rows name them, then the mirrored ones
};

/// Throws Error for no press left by the settings, a mirror of a point that is not there or to one that is.
Averages averagePresses(std::span<const PressRow> presses, const AverageSettings& settings = {});

/// The ellipse's rim, the inner and the outer one of its 95 % band: outlines round (0, 0), mm. Empty where nothing is
/// known of the error.
std::array<std::vector<Vec2>, 2> confidenceBand(const MeanEllipse& mean);

/// Why a pulled direction may not be the tissue's; empty if it is.
std::string dragRemark(const PointMean& point);

/// A row a point as readKeyPoints (maps/key_points.h) takes it; with `by_drag` a row a point and drag, "P1 up".
std::string keyPointTable(const Averages& averages, bool by_drag = false);

/// "up", "left", "up and left"; degrees where no word is near.
std::string dragDirectionName(double drag_deg);
/// Parses a direction as a word or a number.
std::optional<double> dragNamed(std::string_view words);

}  // namespace palpate::measure
