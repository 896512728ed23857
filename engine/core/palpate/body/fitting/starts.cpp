// A patch shows by its normals where behind is, a closed body by its main axes at least its orientation; along the
// spine every third vertebra or so is tried.
#include "palpate/body/fitting/alignment.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>

#include "palpate/base/elementary.h"

namespace palpate::body {

namespace {

constexpr double kFacesOneWay = 0.25;  // length of the mean normal from which a scan is a patch
constexpr int kTurnsOfPatch = 12;
constexpr std::array<double, 6> kMiddleY = {130, 40, -60, -160, -260, -360};  // mm of a man of 1750 mm
constexpr double kSkinOverSpineZ = 60;                                        // at the middle of a patch of the back
constexpr double kSamePlaceMm = 25;
constexpr std::size_t kPromising = 30;  // after a first pull

Vec3 meanVector(const std::vector<Vec3>& vectors) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& v : vectors) sum += v;
  return sum / static_cast<double>(std::max<std::size_t>(vectors.size(), 1));
}

/// Columns right, up, back.
Mat3 frameOf(const Vec3& up, const Vec3& back) {
  Mat3 frame;
  frame.col(2) = back.normalized();
  frame.col(1) = (up - up.dot(frame.col(2)) * frame.col(2)).normalized();
  frame.col(0) = Vec3(frame.col(1)).cross(Vec3(frame.col(2)));
  return frame;
}

std::vector<Mat3> turnsOfPatch(const Vec3& back) {
  const Vec3 across = std::abs(back.x()) < 0.7 ? Vec3::UnitX() : Vec3::UnitY();
  const Mat3 first = frameOf(across, back);
  std::vector<Mat3> turns;
  for (int i = 0; i < kTurnsOfPatch; ++i) {
    const double angle = 2 * std::numbers::pi * i / kTurnsOfPatch;
    turns.push_back(frameOf(elementary::cos(angle) * first.col(1) + elementary::sin(angle) * first.col(0), back));
  }
  return turns;
}

/// All ways to lay three axes on three axes.
std::vector<Mat3> turnsOfBody(const ScanSamples& scan, const Vec3& middle) {
  Mat3 spread = Mat3::Zero();
  for (const Vec3& p : scan.points) spread += (p - middle) * (p - middle).transpose();
  const Mat3 axes = Eigen::SelfAdjointEigenSolver<Mat3>(spread).eigenvectors();
  std::vector<Mat3> turns;
  for (int up = 0; up < 3; ++up) {
    for (int other = 1; other < 3; ++other) {
      for (const double up_sign : {1.0, -1.0}) {
        for (const double back_sign : {1.0, -1.0}) {
          turns.push_back(frameOf(up_sign * axes.col(up), back_sign * axes.col((up + other) % 3)));
        }
      }
    }
  }
  return turns;
}

std::vector<BodyPlacement> starts(const ScanSamples& scan) {
  const Vec3 middle = meanVector(scan.points);
  const Vec3 back = meanVector(scan.normals);
  const bool patch = back.norm() > kFacesOneWay;
  std::vector<BodyPlacement> all;
  for (const Mat3& turn : patch ? turnsOfPatch(back.normalized()) : turnsOfBody(scan, middle)) {
    for (const double y : kMiddleY) {
      BodyPlacement start;
      start.shape.asymmetry = 0;
      start.shape.stature_mm = kMeanStatureMm;
      start.rotation = turn;
      start.translation = middle - start.scale() * (turn * Vec3(0, y, patch ? kSkinOverSpineZ : 0));
      all.push_back(start);
    }
  }
  return all;
}

}  // namespace

std::vector<Alignment> roughPlacements(const TemplateBody& body, const ScanSamples& scan, std::size_t most,
                                       const Progress& progress) {
  const std::vector<BodyPlacement> all = starts(scan);
  const auto best_first = [](std::vector<Alignment> found) {
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.misfit < b.misfit; });
    return found;
  };
  const auto first =
      best_first(alignPoses(body, scan, all, {.rounds = 5, .first_reach_mm = 150, .last_reach_mm = 70}, progress));
  std::vector<BodyPlacement> promising;
  for (std::size_t i = 0; i < std::min(first.size(), kPromising); ++i) promising.push_back(first[i].placement);
  const auto found =
      best_first(alignPoses(body, scan, promising, {.rounds = 8, .first_reach_mm = 80, .last_reach_mm = 40}, progress));
  std::vector<Alignment> distinct;
  for (const Alignment& one : found) {
    const bool known = std::any_of(distinct.begin(), distinct.end(), [&](const Alignment& other) {
      return apart(body, one.placement, other.placement) < kSamePlaceMm;
    });
    if (!known && distinct.size() < most) distinct.push_back(one);
  }
  return distinct;
}

BodyPlacement placementByPlaces(const TemplateBody& body, std::span<const KnownPlace> known) {
  std::vector<Vec3> from;
  std::vector<Vec3> to;
  for (const KnownPlace& place : known) {
    from.push_back(body.landmarks()[place.landmark].position);
    to.push_back(place.position);
  }
  const Vec3 from_middle = meanVector(from);
  const Vec3 to_middle = meanVector(to);
  Mat3 product = Mat3::Zero();
  double square = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    product += (to[i] - to_middle) * (from[i] - from_middle).transpose();
    square += (from[i] - from_middle).squaredNorm();
  }
  const Eigen::JacobiSVD<Mat3> svd(product, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 keep = Mat3::Identity();
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0) keep(2, 2) = -1;
  BodyPlacement placement;
  placement.shape.asymmetry = 0;
  placement.rotation = svd.matrixU() * keep * svd.matrixV().transpose();
  const double scale = (keep * svd.singularValues()).sum() / std::max(square, 1e-9);
  placement.shape.stature_mm *= std::clamp(scale, 0.4, 1.4);
  placement.translation = to_middle - placement.scale() * (placement.rotation * from_middle);
  return placement;
}

double apart(const TemplateBody& body, const BodyPlacement& a, const BodyPlacement& b) {
  const std::vector<Vec3> in_a = body.shaped(a.shape).landmarks;
  const std::vector<Vec3> in_b = body.shaped(b.shape).landmarks;
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < in_a.size(); ++i) {
    if (body.landmarks()[i].normal.z() < 0.5) continue;
    sum += (a.toScan(in_a[i]) - b.toScan(in_b[i])).norm();
    ++count;
  }
  return sum / static_cast<double>(std::max<std::size_t>(count, 1));
}

}  // namespace palpate::body
