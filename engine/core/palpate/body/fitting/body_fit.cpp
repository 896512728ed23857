// Own method. The addition to an alignment's own spread, and the limit from which it is called doubtful, were measured
// on builds bent and bulged beyond what the trunk's own numbers can do (docs/explanation/bodies.md).
#include "palpate/body/fitting/body_fit.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>

#include "palpate/base/elementary.h"
#include "palpate/base/error.h"
#include "palpate/body/fitting/alignment.h"
#include "palpate/body/places.h"
#include "palpate/mesh/nearest.h"

namespace palpate::body {

namespace {

constexpr std::size_t kSamples = 1200;
constexpr std::size_t kFewSamples = 220;  // to try all ways round
constexpr std::size_t kMovesKept = 400;
constexpr std::size_t kPlacementsTried = 5;
constexpr double kWorstRmsMm = 5;    // every back is nearer to the template at its best build
constexpr double kExplained = 0.85;  // share of a patch; or of the template, where the scan shows more than a trunk
constexpr double kCovered = 0.8;
constexpr double kSureEnough = 0.8;
constexpr double kOffScanMm = 25;      // a point shown is farther from the scan than a finger is thick
constexpr double kContradictsMm = 25;  // two levels off
// Further error of a landmark: it grows with the misfit that the template leaves, for as much is hidden along the skin.
constexpr double kOwnErrorMm = 1;
constexpr double kHiddenShare = 2.7;
constexpr double kWorstOfAll = 1.3;    // the worst landmark against the expected one
constexpr double kPointReachMm = 110;  // range over which a named point overrides its neighbours
constexpr double kAnotherPlaceMm = 15;

// ---- points

std::vector<KnownPlace> knownPlaces(const TemplateBody& body, std::vector<NamedPoint>& points) {
  std::vector<KnownPlace> known;
  for (NamedPoint& point : points) {
    const NamedPlace place = placeNamed(body.landmarks(), point.name);
    const auto& all = body.landmarks();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const auto& l) { return spokenName(l.name) == place.name; });
    if (found == all.end())
      throw Error("'" + point.name + "': expected the name of a landmark, not of a place at a distance from one");
    point.name = place.name;
    const auto index = static_cast<std::size_t>(found - all.begin());
    if (std::any_of(known.begin(), known.end(), [&](const KnownPlace& k) { return k.landmark == index; })) {
      throw Error("'" + point.name + "' is given twice");
    }
    known.push_back({index, point.position});
  }
  return known;
}

void requireSpread(std::span<const NamedPoint> points) {
  Vec3 middle = Vec3::Zero();
  for (const NamedPoint& p : points) middle += p.position / static_cast<double>(points.size());
  Mat3 spread = Mat3::Zero();
  for (const NamedPoint& p : points)
    spread += (p.position - middle) * (p.position - middle).transpose() / static_cast<double>(points.size());
  constexpr double kBesideMm = 15;  // a spine bends by less
  const double across = std::sqrt(Eigen::SelfAdjointEigenSolver<Mat3>(spread).eigenvalues()[1]);
  if (across < kBesideMm)
    throw Error("the named points are on one line; name one off the line, such as a PSIS or a scapula's angle");
}

void requireOnScan(const mesh::TriangleMesh& scan, std::span<const NamedPoint> points) {
  if (points.empty()) return;
  const mesh::NearestTriangle nearest(scan);
  for (const NamedPoint& point : points) {
    const double off = nearest.find(point.position).distance;
    if (off > kOffScanMm) {
      throw Error(fmt::format("'{}' is {:.0f} mm off the scan; check that its unit and axes are those of the file",
                              point.name, off));
    }
  }
}

std::vector<double> landmarkErrors(const TemplateBody& body, const BodyPlacement& at,
                                   std::span<const KnownPlace> known) {
  const std::vector<Vec3> landmarks = body.shaped(at.shape).landmarks;
  std::vector<double> misses;
  for (const KnownPlace& place : known)
    misses.push_back((at.toScan(landmarks[place.landmark]) - place.position).norm());
  return misses;
}

Alignment alignByPlaces(const TemplateBody& body, const ScanSamples& samples, std::span<const KnownPlace> known) {
  return align(body, samples, known, placementByPlaces(body, known), {.rounds = 20});
}

/// Names the point without which the others agree.
[[noreturn]] void failContradiction(const TemplateBody& body, const ScanSamples& samples,
                                    std::span<const KnownPlace> known, std::span<const NamedPoint> points) {
  double least = kContradictsMm / 2;
  std::optional<std::size_t> guilty;
  double off = 0;
  for (std::size_t i = 0; known.size() > kFewestNamedPoints && i < known.size(); ++i) {
    std::vector<KnownPlace> others(known.begin(), known.end());
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const Alignment without = alignByPlaces(body, samples, others);
    const std::vector<double> misses = landmarkErrors(body, without.placement, others);
    const double worst = *std::max_element(misses.begin(), misses.end());
    if (worst >= least) continue;
    least = worst;
    guilty = i;
    off = landmarkErrors(body, without.placement, known)[i];
  }
  if (guilty) {
    throw Error(fmt::format("'{}' is {:.0f} mm from where the other points place it; check its name and coordinates",
                            points[*guilty].name, off));
  }
  std::string names;
  for (const NamedPoint& point : points) names += (names.empty() ? "" : ", ") + point.name;
  throw Error("the named points contradict each other (" + names +
              "); check the unit, and that left and right are as seen from behind");
}

// ---- how sure

bool isOfSpine(const SkinLandmark& landmark) {
  constexpr double kHighestY = 180;  // T1 to L4 of the average build
  constexpr double kLowestY = -235;
  return landmark.name.starts_with("spinous_") && landmark.position.y() < kHighestY && landmark.position.y() > kLowestY;
}

double expectedError(double deviation_mm, double rms_mm, double to_point_mm) {
  const double near = elementary::exp(-to_point_mm * to_point_mm / (2 * kPointReachMm * kPointReachMm));
  return elementary::hypot(deviation_mm, kOwnErrorMm + kHiddenShare * rms_mm * std::sqrt(1 - near * near));
}

double toNearest(std::span<const KnownPlace> known, const Vec3& place) {
  double least = 1e9;
  for (const KnownPlace& k : known) least = std::min(least, (k.position - place).norm());
  return least;
}

/// A landmark each: whether the samples of the scan come near it.
std::vector<bool> shownBy(const TemplateBody& body, const BodyPlacement& at, const ScanSamples& samples) {
  constexpr double kNearMm = 25;
  const std::vector<Vec3> landmarks = body.shaped(at.shape).landmarks;
  std::vector<bool> shown;
  for (const Vec3& place : landmarks) {
    const Vec3 here = at.toScan(place);
    shown.push_back(std::any_of(samples.points.begin(), samples.points.end(),
                                [&](const Vec3& p) { return (p - here).squaredNorm() < kNearMm * kNearMm; }));
  }
  return shown;
}

/// Probability of the second best placement, against the best.
double secondBestProbability(const Alignment& best, const std::optional<Alignment>& other, double area_mm2) {
  if (!other) return 0;
  constexpr double kAlikeMm = 35;
  constexpr double kMisfitMm = 15;
  const double sigma = std::max(best.rms_mm, 3.0);
  const double independent = area_mm2 / (kAlikeMm * kAlikeMm);
  const double worse = independent / 2 * (other->misfit - best.misfit) * kMisfitMm * kMisfitMm / (sigma * sigma);
  return 1 / (1 + elementary::exp(std::min(worse, 50.0)));
}

std::string pointsHint(bool by_points) { return by_points ? "" : "; name four points or more (--at T6=X,Y,Z)"; }

void judge(const Alignment& best, bool by_points, BodyFit& fit) {
  const bool explained = best.matched >= kExplained || best.of_template >= kCovered;
  const bool partly = by_points && best.matched >= kExplained / 2;
  if (!explained && !partly) {
    fit.doubt = fmt::format("only {:.0f} % of the scan looks like a trunk", 100 * best.matched);
  } else if (best.rms_mm > kWorstRmsMm) {
    fit.doubt = fmt::format("the scan stays {:.1f} mm (RMS) from any trunk", best.rms_mm);
  } else if (fit.certainty < kSureEnough) {
    fit.doubt = fmt::format(
        "the shape does not determine the position along the back: about {:.0f} mm uncertain, {:.0f} % confidence",
        fit.spine_expected_mm, 100 * fit.certainty);
  }
  if (!fit.doubt.empty()) {
    fit.doubt += pointsHint(by_points);
    fit.certainty = std::min(fit.certainty, 0.5);
  }
}

BodyFit makeBodyFit(const TemplateBody& body, const ScanSamples& samples, const Alignment& best,
                    const std::optional<Alignment>& other, std::span<const KnownPlace> known) {
  BodyFit fit;
  fit.placement = best.placement;
  fit.rms_mm = best.rms_mm;
  fit.matched = best.matched;
  const std::vector<double> deviations = landmarkDeviations(body, best);
  const std::vector<Vec3> landmarks = body.shaped(best.placement.shape).landmarks;
  const std::vector<bool> shown = shownBy(body, best.placement, samples);
  for (std::size_t i = 0; i < deviations.size(); ++i) {
    fit.expected_mm.push_back(
        expectedError(deviations[i], best.rms_mm, toNearest(known, best.placement.toScan(landmarks[i]))));
    if (shown[i] && isOfSpine(body.landmarks()[i]))
      fit.spine_expected_mm = std::max(fit.spine_expected_mm, fit.expected_mm[i]);
  }
  if (fit.spine_expected_mm == 0) fit.spine_expected_mm = kOffMm;  // a scan without any spine
  fit.certainty = elementary::erf(kOffMm / (kWorstOfAll * fit.spine_expected_mm * std::numbers::sqrt2)) *
                  (1 - secondBestProbability(best, other, samples.area_mm2));
  judge(best, known.size() >= kFewestNamedPoints, fit);
  return fit;
}

// ---- by shape

struct BestTwo {
  Alignment best;
  std::optional<Alignment> other;
};

/// Its misfit made worse by the named points that it misses.
Alignment judgedByFew(const TemplateBody& body, Alignment found, std::span<const KnownPlace> known) {
  constexpr double kWorthOfPoints = 0.1;  // separates levels; a point that no such shape can have is not believed
  for (const double miss : landmarkErrors(body, found.placement, known)) {
    const double share = std::min(miss / kContradictsMm, 1.0);
    found.misfit += kWorthOfPoints / static_cast<double>(known.size()) * share * share;
  }
  return found;
}

/// The placement moved along so that the points are met in the mean.
BodyPlacement movedToPoints(const TemplateBody& body, BodyPlacement at, std::span<const KnownPlace> known) {
  const std::vector<Vec3> landmarks = body.shaped(at.shape).landmarks;
  Vec3 sum = Vec3::Zero();
  for (const KnownPlace& place : known) sum += place.position - at.toScan(landmarks[place.landmark]);
  at.translation += sum / static_cast<double>(known.size());
  return at;
}

/// `known`: too few to place the body by them; they choose among the places that the shape allows.
BestTwo bestPlacements(const TemplateBody& body, const mesh::TriangleMesh& scan, const ScanSamples& samples,
                       std::span<const KnownPlace> known, const Progress& progress) {
  std::vector<Alignment> found;
  const auto rough = roughPlacements(body, sampleScan(scan, kFewSamples), kPlacementsTried, progress);
  const auto try_from = [&](const BodyPlacement& start, std::span<const KnownPlace> by) {
    found.push_back(judgedByFew(body, align(body, samples, by, start), known));
  };
  for (std::size_t i = 0; i < rough.size(); ++i) {
    report(progress, "fitting the build", static_cast<double>(i) / static_cast<double>(rough.size()));
    const BodyPlacement& start = rough[i].placement;
    try_from(start, known);
    if (known.empty()) continue;
    try_from(movedToPoints(body, start, known), known);
    if (i == 0) try_from(start, {});  // the shape's own answer
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.misfit < b.misfit; });
  if (found.empty()) throw Error("the scan has no usable surface");
  BestTwo result{found.front(), std::nullopt};
  for (const Alignment& one : found) {
    if (!result.other && apart(body, one.placement, result.best.placement) > kAnotherPlaceMm) result.other = one;
  }
  return result;
}

BodyFit fitByShape(const TemplateBody& body, const mesh::TriangleMesh& scan, const ScanSamples& samples,
                   std::span<const KnownPlace> known, std::span<const NamedPoint> named, const Progress& progress) {
  const BestTwo placements = bestPlacements(body, scan, samples, known, progress);
  const std::vector<double> misses = landmarkErrors(body, placements.best.placement, known);
  const auto worst = std::max_element(misses.begin(), misses.end());
  if (worst != misses.end() && *worst > kContradictsMm) {
    throw Error(fmt::format("'{}' differs from the shape of the scan by {:.0f} mm; name at least {} points",
                            named[static_cast<std::size_t>(worst - misses.begin())].name, *worst, kFewestNamedPoints));
  }
  return makeBodyFit(body, samples, placements.best, placements.other, known);
}

BodyFit fitByPoints(const TemplateBody& body, const ScanSamples& samples, std::span<const KnownPlace> known,
                    std::span<const NamedPoint> named, const Progress& progress) {
  requireSpread(named);
  report(progress, "fitting the build", 0.0);
  const Alignment best = alignByPlaces(body, samples, known);
  const std::vector<double> misses = landmarkErrors(body, best.placement, known);
  if (*std::max_element(misses.begin(), misses.end()) > kContradictsMm) failContradiction(body, samples, known, named);
  return makeBodyFit(body, samples, best, std::nullopt, known);
}

}  // namespace

BodyFit fitBody(const TemplateBody& body, const mesh::TriangleMesh& scan, std::span<const NamedPoint> points,
                const Progress& progress) {
  const ScanSamples samples = sampleScan(scan, kSamples);
  if (samples.points.empty()) throw Error("the scan has no usable surface");
  std::vector<NamedPoint> named(points.begin(), points.end());
  const std::vector<KnownPlace> known = knownPlaces(body, named);
  requireOnScan(scan, named);
  BodyFit fit = known.size() < kFewestNamedPoints ? fitByShape(body, scan, samples, known, named, progress)
                                                  : fitByPoints(body, samples, known, named, progress);
  fit.points = std::move(named);
  fit.skin_moves = skinMoves(body, fit.placement, sampleScan(scan, kMovesKept));
  return fit;
}

std::string certaintyWord(double certainty) {
  if (certainty >= 0.95) return "sure";
  return certainty >= kSureEnough ? "fairly sure" : "doubtful";
}

}  // namespace palpate::body
