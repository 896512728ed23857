// Where a scan that nobody explained may stand: rough placements of the template body, best first.
//
// alignment.h -> here -> body_fit.h.
#pragma once

#include <vector>

#include "palpate/base/progress.h"
#include "palpate/body/fitting/alignment.h"

namespace palpate::body {

/// Placements that differ from each other by more than a vertebra or so, at most `most`, each pulled together with the
/// average build. Tries all ways round; under two seconds.
std::vector<Alignment> roughPlacements(const TemplateBody& body, const ScanSamples& scan, std::size_t most,
                                       const Progress& progress = {});

/// The placement that brings the landmarks of the average build nearest to where they were shown. At least three that
/// lie on no line. Based on: Umeyama, "Least-squares estimation of transformation parameters between two point
/// patterns", 1991.
BodyPlacement placementByPlaces(const TemplateBody& body, std::span<const KnownPlace> known);

/// How far apart two placements put the body, mm: the mean over the dorsal landmarks.
double apart(const TemplateBody& body, const BodyPlacement& a, const BodyPlacement& b);

}  // namespace palpate::body
