// Pulls the template body onto a scan from a rough start: pose, stature and build at once.
//
// template_body.h -> here -> body_fit.h. Each round takes for every sample of the scan the nearest place of the
// template, and solves for the placement that brings them together along the template's normals, with the named points
// and prior knowledge of people. The result is the most likely placement and how sure each of its numbers is.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/body/fitting/residual_warp.h"
#include "palpate/body/fitting/template_body.h"

namespace palpate::body {

/// Places of a scan's surface, evenly by area.
struct ScanSamples {
  std::vector<Vec3> points;
  std::vector<Vec3> normals;
  double area_mm2 = 0;
};
ScanSamples sampleScan(const mesh::TriangleMesh& scan, std::size_t count);

/// A landmark that the user showed on the scan.
struct KnownPlace {
  std::size_t landmark;  ///< index into the template's landmarks
  Vec3 position;         ///< mm
};

/// Mean of adults, mm: the start of a fit, and its pull where a scan shows little.
inline constexpr double kMeanStatureMm = 1715;

/// Three of turning, three of place, stature, girth, body mass index, muscle, kyphosis, lordosis, asymmetry.
inline constexpr int kPlacementNumbers = 13;

struct AlignSettings {
  int rounds = 25;
  double first_reach_mm = 60;  ///< samples farther from the template are ignored; falls to last_reach_mm
  double last_reach_mm = 15;
};

struct Alignment {
  BodyPlacement placement;
  double rms_mm = 0;       ///< over the samples that met the template, along its normals
  double matched = 0;      ///< share of the samples that did
  double misfit = 1;       ///< 0 perfect, 1 nothing fits: to compare placements of one scan
  double of_template = 0;  ///< share of the template's own skin, stumps aside, that the scan covers
  Eigen::Matrix<double, kPlacementNumbers, kPlacementNumbers> covariance =
      Eigen::Matrix<double, kPlacementNumbers, kPlacementNumbers>::Zero();
};

/// From a start within some 60 mm and 30 degrees of where it belongs. Deterministic.
Alignment align(const TemplateBody& body, const ScanSamples& scan, std::span<const KnownPlace> known,
                const BodyPlacement& start, const AlignSettings& settings = {});

/// The same for many starts of one fixed build: pose and stature only.
std::vector<Alignment> alignPoses(const TemplateBody& body, const ScanSamples& scan,
                                  std::span<const BodyPlacement> starts, const AlignSettings& settings,
                                  const Progress& progress = {});

/// One standard deviation (mm) of where each landmark is by the alignment's covariance, a template's landmark each.
std::vector<double> landmarkDeviations(const TemplateBody& body, const Alignment& alignment);

/// From where the template's skin is to where the scan's is, along the template's normals; where they meet at all.
std::vector<Move> skinMoves(const TemplateBody& body, const BodyPlacement& at, const ScanSamples& scan);

// Where a scan without hints may be: rough placements of the template body, best first.

/// Placements that differ from each other by more than a vertebra or so, at most `most`, each pulled together with the
/// average build. Tries all ways round; under two seconds.
std::vector<Alignment> roughPlacements(const TemplateBody& body, const ScanSamples& scan, std::size_t most,
                                       const Progress& progress = {});

/// The placement with the landmarks of the average build nearest to where they were shown. Needs at least three that
/// are not on one line. Based on: Umeyama, "Least-squares estimation of transformation parameters between two point
/// patterns", 1991.
BodyPlacement placementByPlaces(const TemplateBody& body, std::span<const KnownPlace> known);

/// Distance between two placements of the body, mm: the mean over the dorsal landmarks.
double apart(const TemplateBody& body, const BodyPlacement& a, const BodyPlacement& b);

}  // namespace palpate::body
