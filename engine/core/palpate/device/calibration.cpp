// Both clouds about their middles -> covariance -> its singular vectors are the rotation, without mirroring; the scale
// is the remainder, the origin follows. Cold path. Based on: Umeyama 1991 (device_frame.h).
#include "palpate/device/calibration.h"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "palpate/base/error.h"
#include "palpate/device/device_frame.h"

namespace palpate::device {

namespace {

constexpr double kMinApartMm = 20.0;     // between the two that are farthest apart
constexpr double kMinWidthShare = 0.15;  // the triangle's width over its longest side
constexpr double kMinScale = 0.05;
constexpr double kMaxScale = 20.0;

/// The longest way between two of the places, and how far any is from that line.
struct Spread {
  double length = 0.0;
  double width = 0.0;
};

Spread measureSpread(std::span<const Vec3> places) {
  Spread spread;
  Vec3 from = Vec3::Zero();
  Vec3 along = Vec3::UnitX();
  for (const Vec3& a : places) {
    for (const Vec3& b : places) {
      if ((b - a).norm() <= spread.length) continue;
      spread.length = (b - a).norm();
      from = a;
      along = (b - a).normalized();
    }
  }
  for (const Vec3& place : places) {
    const Vec3 away = place - from;
    spread.width = std::max(spread.width, (away - away.dot(along) * along).norm());
  }
  return spread;
}

void requireSpread(std::span<const Vec3> places, const char* whose) {
  const auto is_number = [](const Vec3& place) { return place.allFinite(); };
  if (!std::all_of(places.begin(), places.end(), is_number)) {
    throw Error(fmt::format("calibration: the points of the {} must be finite", whose));
  }
  const Spread spread = measureSpread(places);
  if (spread.length < kMinApartMm) {
    throw Error(fmt::format(
        "calibration: the points of the {} are within {:.1f} mm of each other; choose points at least {:.0f} mm apart",
        whose, spread.length, kMinApartMm));
  }
  if (spread.width < kMinWidthShare * spread.length) {
    throw Error(
        fmt::format("calibration: the points of the {} are nearly on a line ({:.1f} mm wide, {:.1f} mm long); choose "
                    "the corners of a triangle",
                    whose, spread.width, spread.length));
  }
}

Vec3 centroid(std::span<const Vec3> places) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& place : places) sum += place;
  return sum / static_cast<double>(places.size());
}

}  // namespace

Calibration calibrationOf(std::span<const Vec3> of_device, std::span<const Vec3> of_body) {
  if (of_device.size() != of_body.size() || of_device.size() < kCalibrationPlaces) {
    throw Error(fmt::format(
        "calibration: {} device points and {} body points; expected the same number of both, at least three",
        of_device.size(), of_body.size()));
  }
  requireSpread(of_device, "device");
  requireSpread(of_body, "body");
  const Vec3 device_middle = centroid(of_device);
  const Vec3 body_middle = centroid(of_body);
  Mat3 covariance = Mat3::Zero();
  double device_square = 0.0;
  for (std::size_t i = 0; i < of_device.size(); ++i) {
    covariance += (of_body[i] - body_middle) * (of_device[i] - device_middle).transpose();
    device_square += (of_device[i] - device_middle).squaredNorm();
  }
  const Eigen::JacobiSVD<Mat3> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  // Three places are in a plane, so the third axis is free: it must not mirror the hand.
  Vec3 sign = Vec3::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) sign.z() = -1.0;
  Calibration calibration;
  DeviceFrame& frame = calibration.frame;
  frame.axes = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  frame.mm = svd.singularValues().dot(sign) / device_square;
  if (!(frame.mm >= kMinScale && frame.mm <= kMaxScale)) {
    throw Error(fmt::format("calibration: the scale from device to body is {:.3g}; expected {} to {}", frame.mm,
                            kMinScale, kMaxScale));
  }
  frame.origin_mm = body_middle - frame.mm * (frame.axes * device_middle);
  double square = 0.0;
  for (std::size_t i = 0; i < of_device.size(); ++i) {
    square += (frame.placeInBody(of_device[i]) - of_body[i]).squaredNorm();
  }
  calibration.residual_mm = std::sqrt(square / static_cast<double>(of_device.size()));
  return calibration;
}

}  // namespace palpate::device
