// Finds spine and bones of a scanned person: the built-in trunk pulled onto the scan, by landmarks that the user
// showed, or by the scan's shape alone - and how sure that is.
//
// alignment.h -> here -> fitted_body.h (bones, landmarks), a file kept next to a scene.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/body/fitting/residual_warp.h"
#include "palpate/body/fitting/template_body.h"

namespace palpate::body {

/// A landmark shown on a scan: "T6", "left PSIS", ... as places.h reads them.
struct NamedPoint {
  std::string name;
  Vec3 position;  ///< mm, in the scan's frame
};

struct BodyFit {
  BodyPlacement placement;
  std::vector<Move> skin_moves;    ///< from the template's skin to the scan's, mm, the scan's frame
  std::vector<NamedPoint> points;  ///< points used; their names as spoken
  double rms_mm = 0;               ///< between template and scan, before those moves
  double matched = 0;              ///< share of the scan that the template explains
  /// Expected error of each landmark of the trunk (skeletonLandmarks), mm.
  std::vector<double> expected_mm;
  double spine_expected_mm = 0;  ///< the largest of them among T1 to L4 where the scan shows them
  double certainty = 0;          ///< 0 to 1: that no such landmark is off by more than kOffMm
  std::string doubt;             ///< why it should not be used, and what would help; empty: it may be used
};

/// Off by half a vertebra is on the wrong one.
inline constexpr double kOffMm = 12;
/// This many place the body by themselves; with fewer its shape does, and they choose among the candidates.
inline constexpr std::size_t kFewestNamedPoints = 4;

/// `scan`: mended (mesh::repair), millimetres, at any place and in any orientation. Uses its shape where there are
/// fewer than kFewestNamedPoints. Throws Error for names that are unknown or repeated, for points that are off the
/// scan, four or more on a line, or that contradict each other or the shape.
BodyFit fitBody(const TemplateBody& body, const mesh::TriangleMesh& scan, std::span<const NamedPoint> points,
                const Progress& progress = {});

/// "sure", "fairly sure", "doubtful" for a certainty.
std::string certaintyWord(double certainty);

// A fit as text, to be kept next to a scene: NAME.fit.json.

/// Longer files are not fits.
inline constexpr std::size_t kLongestFitFile = 1 << 20;

/// All numbers exactly, so that a fit read back gives the same body.
std::string fitAsJson(const BodyFit& fit);

/// Any text at all gives a fit or one Error with file and place.
BodyFit fitFromJson(std::string_view text, std::string_view file);

}  // namespace palpate::body
