// Iteratively reweighted Gauss-Newton on point-to-plane distances, Tukey's weights, Gaussian priors. Neighbouring
// samples err alike: a scan counts as one independent sample per patch of kAlikeMm. Based on: Chen and
// Medioni, "Object modelling by registration of multiple range images", 1992.
#include "palpate/body/fitting/alignment.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "palpate/base/elementary.h"
#include "palpate/body/rotation.h"
#include "palpate/mesh/nearest.h"

namespace palpate::body {

namespace {

using Numbers = Eigen::Matrix<double, kPlacementNumbers, 1>;
using Normal = Eigen::Matrix<double, kPlacementNumbers, kPlacementNumbers>;

constexpr int kPoseNumbers = 7;  // turning, place, stature
constexpr int kBuildNumbers = kPlacementNumbers - kPoseNumbers;

constexpr double kAlikeMm = 35;      // over this length the misfit of a build keeps its sign
constexpr double kMinSigmaMm = 0.8;  // no scan and no template is better
constexpr double kKnownSigmaMm = 3;  // a finger's idea of a landmark
constexpr double kFacing = 0.5;      // cosine: scan and template look the same way
constexpr double kMisfitMm = 15;     // counts as no match

/// A number of the build: where TrunkShape has it, what people have, what it may be.
struct BuildNumber {
  double TrunkShape::*member;
  double mean, deviation;
  double low, high;
  double step;  // for the derivative
};
// Adults; our reading of the ranges that trunk.h names.
constexpr std::array<BuildNumber, kBuildNumbers> kBuild = {{
    {&TrunkShape::girth, 1.0, 0.09, 0.8, 1.3, 0.01},
    {&TrunkShape::body_mass_index, 24, 5, 16, 45, 0.5},
    {&TrunkShape::muscle, 1, 0.5, 0, 2, 0.1},
    {&TrunkShape::kyphosis_deg, kFittedKyphosisDeg, 10, 15, 65, 1},
    {&TrunkShape::lordosis_deg, kFittedLordosisDeg, 10, 0, 50, 1},
    {&TrunkShape::asymmetry, 0.7, 0.6, 0, 3, 0.1},
}};
constexpr double kStatureDeviation = 0.09;  // logarithmic; points reveal children and giants
constexpr double kMinStatureMm = 700;
constexpr double kMaxStatureMm = 2300;

/// The template at a build, with its derivatives by the numbers of the build.
struct Differentiated {
  TemplateBody::Shaped shaped;
  std::array<TemplateBody::Shaped, kBuildNumbers> ahead;  // a step on in one number
};

Differentiated differentiated(const TemplateBody& body, const TrunkShape& shape, bool build_is_free) {
  Differentiated result{body.shaped(shape), {}};
  for (std::size_t i = 0; build_is_free && i < kBuild.size(); ++i) {
    TrunkShape ahead = shape;
    ahead.*kBuild[i].member += kBuild[i].step;
    if (ahead.*kBuild[i].member > kBuild[i].high) ahead.*kBuild[i].member -= 2 * kBuild[i].step;
    result.ahead[i] = body.shaped(ahead);
  }
  return result;
}

double differenceStep(const TrunkShape& shape, const BuildNumber& number) {
  return shape.*number.member + number.step > number.high ? -number.step : number.step;
}

/// Derivative of a body point's place in the scan's frame by the placement's numbers: three rows.
Eigen::Matrix<double, 3, kPlacementNumbers> placementJacobian(const BodyPlacement& at, const Vec3& point,
                                                              const std::array<Vec3, kBuildNumbers>& by_build) {
  const double scale = at.scale();
  Eigen::Matrix<double, 3, kPlacementNumbers> motion;
  const Vec3 turned = scale * (at.rotation * point);
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 about = at.rotation.col(axis);
    motion.col(axis) = about.cross(turned);
    motion.col(3 + axis) = Vec3::Unit(axis);
  }
  motion.col(6) = turned;  // by the logarithm of the stature
  for (int i = 0; i < kBuildNumbers; ++i) {
    motion.col(kPoseNumbers + i) = scale * (at.rotation * by_build[static_cast<std::size_t>(i)]);
  }
  return motion;
}

/// A sample of the scan and the place of the template that it meets.
struct Match {
  Vec3 point;   // on the template, body frame
  Vec3 normal;  // normal of the template, scan's frame
  double off;   // mm that the scan is outside of it
  std::array<Vec3, kBuildNumbers> by_build;
};

class Round {
 public:
  Round(const TemplateBody& body, const TrunkShape& shape, bool build_is_free)
      : body_(body),
        shape_(shape),
        template_(differentiated(body, shape, build_is_free)),
        mesh_{template_.shaped.skin, body.triangles()},
        normals_(mesh::vertexNormals(mesh_)),
        nearest_(mesh_),
        build_is_free_(build_is_free) {}

  /// Empty where the sample meets nothing, or a stump, within reach.
  bool match(const BodyPlacement& at, const Vec3& point, const Vec3& normal, double reach_mm, Match& found) const {
    const Vec3 place = at.toBody(point);
    const auto hit = nearest_.find(place, reach_mm / at.scale());
    if (hit.triangle == kNoIndex || body_.isStump()[hit.triangle]) return false;
    const Triangle& t = body_.triangles()[hit.triangle];
    const std::array<double, 3> share = barycentricWeights(t, hit.point);
    Vec3 facing = share[0] * normals_[t[0]] + share[1] * normals_[t[1]] + share[2] * normals_[t[2]];
    facing.normalize();
    const Vec3 here = at.rotation.transpose() * normal;
    if (facing.dot(here) < kFacing) return false;
    found.point = hit.point;
    found.normal = at.rotation * facing;
    found.off = at.scale() * facing.dot(place - hit.point);
    for (std::size_t i = 0; i < kBuild.size(); ++i) found.by_build[i] = motionBy(i, t, share);
    return true;
  }
  std::array<Vec3, kBuildNumbers> landmarkByBuild(std::size_t landmark) const {
    std::array<Vec3, kBuildNumbers> result;
    for (std::size_t i = 0; i < kBuild.size(); ++i) {
      result[i] = build_is_free_
                      ? Vec3((template_.ahead[i].landmarks[landmark] - template_.shaped.landmarks[landmark]) /
                             differenceStep(shape_, kBuild[i]))
                      : Vec3(Vec3::Zero());
    }
    return result;
  }
  const TemplateBody::Shaped& shaped() const { return template_.shaped; }

 private:
  std::array<double, 3> barycentricWeights(const Triangle& t, const Vec3& point) const {
    const Vec3& a = mesh_.positions[t[0]];
    const Vec3& b = mesh_.positions[t[1]];
    const Vec3& c = mesh_.positions[t[2]];
    const Vec3 whole = mesh::areaVector2(a, b, c);
    const double square = whole.squaredNorm();
    if (!(square > 0)) return {1, 0, 0};
    const double u = mesh::areaVector2(point, b, c).dot(whole) / square;
    const double v = mesh::areaVector2(a, point, c).dot(whole) / square;
    return {u, v, 1 - u - v};
  }
  Vec3 motionBy(std::size_t number, const Triangle& t, const std::array<double, 3>& share) const {
    if (!build_is_free_) return Vec3::Zero();
    Vec3 motion = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      motion += share[k] * (template_.ahead[number].skin[t[k]] - template_.shaped.skin[t[k]]);
    }
    return motion / differenceStep(shape_, kBuild[number]);
  }

  const TemplateBody& body_;
  TrunkShape shape_;
  Differentiated template_;
  mesh::TriangleMesh mesh_;
  std::vector<Vec3> normals_;
  mesh::NearestTriangle nearest_;
  bool build_is_free_;
};

double tukey(double off, double limit) {
  const double t = off / limit;
  return std::abs(t) < 1 ? (1 - t * t) * (1 - t * t) : 0.0;
}

void addPriors(const BodyPlacement& at, bool build_is_free, Normal& normal, Numbers& right) {
  const auto add = [&](int number, double value, double mean, double deviation) {
    normal(number, number) += 1 / (deviation * deviation);
    right[number] += (mean - value) / (deviation * deviation);
  };
  add(6, elementary::log(at.shape.stature_mm), elementary::log(kMeanStatureMm), kStatureDeviation);
  for (std::size_t i = 0; i < kBuild.size(); ++i) {
    const int number = kPoseNumbers + static_cast<int>(i);
    const double stiff = build_is_free ? 1.0 : 1e-6;
    add(number, at.shape.*kBuild[i].member, build_is_free ? kBuild[i].mean : at.shape.*kBuild[i].member,
        stiff * kBuild[i].deviation);
  }
}

BodyPlacement moved(BodyPlacement at, const Numbers& by) {
  Vec3 turn = at.rotation * by.head<3>();
  const double most = 0.5;
  if (turn.norm() > most) turn *= most / turn.norm();
  if (turn.norm() > 0) at.rotation = rotationAbout(turn.normalized(), turn.norm()) * at.rotation;
  at.rotation = Eigen::Quaterniond(at.rotation).normalized().toRotationMatrix();
  at.translation += by.segment<3>(3);
  at.shape.stature_mm =
      std::clamp(at.shape.stature_mm * elementary::exp(std::clamp(by[6], -0.2, 0.2)), kMinStatureMm, kMaxStatureMm);
  for (std::size_t i = 0; i < kBuild.size(); ++i) {
    double& value = at.shape.*kBuild[i].member;
    value = std::clamp(value + by[kPoseNumbers + static_cast<int>(i)], kBuild[i].low, kBuild[i].high);
  }
  return at;
}

/// One round's equations and what they were made of.
struct Equations {
  Normal normal = Normal::Zero();
  Numbers right = Numbers::Zero();
  double rms_mm = 0, matched = 0, misfit = 0;
};

Equations buildEquations(const Round& round, const BodyPlacement& at, const ScanSamples& scan,
                         std::span<const KnownPlace> known, double reach_mm, double sigma_mm, bool build_is_free) {
  Equations e;
  const auto count = static_cast<double>(scan.points.size());
  const double independent = std::clamp(scan.area_mm2 / (kAlikeMm * kAlikeMm), 10.0, count);
  const double worth = independent / count / (sigma_mm * sigma_mm);
  double weights = 0;
  double squares = 0;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    Match match;
    if (!round.match(at, scan.points[i], scan.normals[i], reach_mm, match)) {
      e.misfit += 1;
      continue;
    }
    e.misfit += std::min(match.off * match.off / (kMisfitMm * kMisfitMm), 1.0);
    const double weight = tukey(match.off, reach_mm);
    const Numbers row = placementJacobian(at, match.point, match.by_build).transpose() * match.normal;
    e.normal += worth * weight * row * row.transpose();
    e.right += worth * weight * match.off * row;
    weights += weight;
    squares += weight * match.off * match.off;
    e.matched += 1;
  }
  e.rms_mm = weights > 0 ? std::sqrt(squares / weights) : reach_mm;
  e.matched /= count;
  e.misfit /= count;
  for (const KnownPlace& place : known) {
    const Vec3& point = round.shaped().landmarks[place.landmark];
    const auto motion = placementJacobian(at, point, round.landmarkByBuild(place.landmark));
    const double known_worth = 1 / (kKnownSigmaMm * kKnownSigmaMm);
    e.normal += known_worth * motion.transpose() * motion;
    e.right += known_worth * motion.transpose() * (place.position - at.toScan(point));
  }
  addPriors(at, build_is_free, e.normal, e.right);
  return e;
}

/// Share of the template that the scan covers: its places tried against the samples.
double templateCovered(const TemplateBody& body, const BodyPlacement& at, const ScanSamples& scan) {
  constexpr double kCellMm = 30;
  const auto cell = [](const Vec3& p) -> std::array<long, 3> {
    return {std::lround(p.x() / kCellMm), std::lround(p.y() / kCellMm), std::lround(p.z() / kCellMm)};
  };
  std::vector<std::array<long, 3>> cells;
  for (const Vec3& p : scan.points) cells.push_back(cell(at.toBody(p)));
  std::sort(cells.begin(), cells.end());
  const auto near = [&](const Vec3& p) {
    const auto middle = cell(p);
    for (long k = 0; k < 27; ++k) {
      const std::array<long, 3> other = {middle[0] + k / 9 - 1, middle[1] + k / 3 % 3 - 1, middle[2] + k % 3 - 1};
      if (std::binary_search(cells.begin(), cells.end(), other)) return true;
    }
    return false;
  };
  const std::vector<Vec3> skin = body.shaped(at.shape).skin;
  std::size_t tried = 0;
  std::size_t met = 0;
  for (std::size_t t = 0; t < body.triangles().size(); t += 4) {
    if (body.isStump()[t]) continue;
    ++tried;
    met += near(skin[body.triangles()[t][0]]) ? 1 : 0;
  }
  return static_cast<double>(met) / static_cast<double>(std::max<std::size_t>(tried, 1));
}

}  // namespace

ScanSamples sampleScan(const mesh::TriangleMesh& scan, std::size_t count) {
  ScanSamples samples;
  const std::vector<Vec3> normals = mesh::vertexNormals(scan);
  std::vector<double> up_to;
  for (const Triangle& t : scan.triangles) {
    samples.area_mm2 += 0.5 * mesh::areaVector2(scan, t).norm();
    up_to.push_back(samples.area_mm2);
  }
  if (!(samples.area_mm2 > 0)) return samples;
  for (std::size_t i = 0; i < count; ++i) {
    const double target = (static_cast<double>(i) + 0.5) / static_cast<double>(count) * samples.area_mm2;
    const auto at = static_cast<std::size_t>(std::upper_bound(up_to.begin(), up_to.end(), target) - up_to.begin());
    const Triangle& t = scan.triangles[std::min(at, scan.triangles.size() - 1)];
    // A low-discrepancy pair, folded into the triangle.
    double u = std::fmod(0.5 + static_cast<double>(i) * 0.7548776662466927, 1.0);
    double v = std::fmod(0.5 + static_cast<double>(i) * 0.5698402909980532, 1.0);
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const Vec3 normal = u * normals[t[0]] + v * normals[t[1]] + (1 - u - v) * normals[t[2]];
    if (!(normal.norm() > 0)) continue;
    samples.points.emplace_back(u * scan.positions[t[0]] + v * scan.positions[t[1]] +
                                (1 - u - v) * scan.positions[t[2]]);
    samples.normals.emplace_back(normal.normalized());
  }
  return samples;
}

namespace {

/// `build`: fixed for all rounds; empty: every round makes its own, and the build is free.
Alignment aligned(const TemplateBody& body, const ScanSamples& scan, std::span<const KnownPlace> known,
                  const BodyPlacement& start, const AlignSettings& settings, const Round* build) {
  Alignment result;
  result.placement = start;
  double sigma = 5;
  for (int i = 0; i <= settings.rounds; ++i) {
    const double share = std::min(1.0, 1.4 * i / std::max(settings.rounds, 1));
    const double reach =
        settings.first_reach_mm * elementary::pow(settings.last_reach_mm / settings.first_reach_mm, share);
    std::optional<Round> own;
    if (build == nullptr) own.emplace(body, result.placement.shape, true);
    const Round& round = own ? *own : *build;
    Equations e = buildEquations(round, result.placement, scan, known, reach, sigma, build == nullptr);
    result.rms_mm = e.rms_mm;
    result.matched = e.matched;
    result.misfit = e.misfit;
    sigma = std::clamp(e.rms_mm, kMinSigmaMm, 6.0);
    for (int k = 0; k < kPlacementNumbers; ++k) e.normal(k, k) *= 1 + 1e-4;
    const Eigen::LDLT<Normal> solver(e.normal);
    if (i == settings.rounds) {
      result.covariance = solver.solve(Normal::Identity());
      break;
    }
    const Numbers step = solver.solve(e.right);
    if (!step.allFinite()) break;
    result.placement = moved(result.placement, step);
  }
  return result;
}

}  // namespace

Alignment align(const TemplateBody& body, const ScanSamples& scan, std::span<const KnownPlace> known,
                const BodyPlacement& start, const AlignSettings& settings) {
  Alignment result = aligned(body, scan, known, start, settings, nullptr);
  result.of_template = templateCovered(body, result.placement, scan);
  return result;
}

std::vector<Alignment> alignPoses(const TemplateBody& body, const ScanSamples& scan,
                                  std::span<const BodyPlacement> starts, const AlignSettings& settings,
                                  const Progress& progress) {
  std::vector<Alignment> found;
  if (starts.empty()) return found;
  const Round build(body, starts.front().shape, false);
  for (const BodyPlacement& start : starts) {
    report(progress, "trying all ways round", static_cast<double>(found.size()) / static_cast<double>(starts.size()));
    found.push_back(aligned(body, scan, {}, start, settings, &build));
  }
  return found;
}

std::vector<Move> skinMoves(const TemplateBody& body, const BodyPlacement& at, const ScanSamples& scan) {
  const Round round(body, at.shape, false);
  std::vector<Move> moves;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    Match match;
    if (!round.match(at, scan.points[i], scan.normals[i], kMisfitMm, match)) continue;
    moves.push_back({at.toScan(match.point), match.off * match.normal});
  }
  return moves;
}

std::vector<double> landmarkDeviations(const TemplateBody& body, const Alignment& alignment) {
  const Round round(body, alignment.placement.shape, true);
  std::vector<double> deviations;
  for (std::size_t i = 0; i < body.landmarks().size(); ++i) {
    const auto motion = placementJacobian(alignment.placement, round.shaped().landmarks[i], round.landmarkByBuild(i));
    const Mat3 spread = motion * alignment.covariance * motion.transpose();
    deviations.push_back(std::sqrt(std::max(spread.trace(), 0.0)));
  }
  return deviations;
}

}  // namespace palpate::body
