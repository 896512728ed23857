// Based on: Ji, dissertation 2008, section 5.1 (contour of 2 mm, longest chord, extent across it); Halir and Flusser,
// "Numerically stable direct least squares fitting of ellipses", 1998 (through OpenCV).
#include "palpate/measure/field_report.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "palpate/measure/thin_plate.h"

namespace palpate::measure {

namespace {

constexpr int kContourRays = 180;
constexpr double kRayStepMm = 3.0;
constexpr double kFarthestMm = 400.0;
constexpr double kMinOfContour = 0.5;  // share of the rays that must meet the contour
constexpr double kDiffersSd = 2.0;

struct Traced {
  std::vector<Vec2> contour;
  double inside_share = 0.0;
};

/// Outwards from the contact to the first place where the motion falls below the level, while there are dots.
Traced trace(const ThinPlate& motion, const SkinChart& chart, const Vec2& contact, double level_mm) {
  Traced traced;
  for (int i = 0; i < kContourRays; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kContourRays;
    const Vec2 ray(std::cos(angle), std::sin(angle));
    double last = motion.at(contact).norm();
    for (double r = kRayStepMm; r < kFarthestMm; r += kRayStepMm) {
      const Vec2 place = contact + r * ray;
      if (!chart.covers(place)) break;
      const double now = motion.at(place).norm();
      if (now <= level_mm && last > level_mm) {
        traced.contour.emplace_back(contact + (r - kRayStepMm * (level_mm - now) / (last - now)) * ray);
        break;
      }
      last = now;
    }
  }
  traced.inside_share = static_cast<double>(traced.contour.size()) / kContourRays;
  return traced;
}

void measureChord(ContourReading& reading) {
  Vec2 chord = Vec2::Zero();
  for (const Vec2& a : reading.contour_2_mm) {
    for (const Vec2& b : reading.contour_2_mm) {
      if ((b - a).squaredNorm() > chord.squaredNorm()) chord = b - a;
    }
  }
  const Vec2 across = Vec2(-chord.y(), chord.x()).normalized();
  double low = 0.0;
  double high = 0.0;
  for (const Vec2& place : reading.contour_2_mm) {
    const double at = (place - reading.contour_2_mm.front()).dot(across);
    low = std::min(low, at);
    high = std::max(high, at);
  }
  reading.half_chord_mm = 0.5 * chord.norm();
  reading.half_across_mm = 0.5 * (high - low);
  const double angle = std::remainder(std::atan2(chord.y(), chord.x()), std::numbers::pi) * kDegPerRad;
  reading.chord_deg = angle <= -90.0 ? angle + 180.0 : angle;
}

std::optional<maps::Ellipse> directEllipse(const std::vector<Vec2>& contour) {
  if (contour.size() < 8) return {};
  std::vector<cv::Point2f> points;
  for (const Vec2& place : contour) points.emplace_back(static_cast<float>(place.x()), static_cast<float>(place.y()));
  const cv::RotatedRect box = cv::fitEllipseDirect(points);
  const double along = 0.5 * static_cast<double>(box.size.width);
  const double across = 0.5 * static_cast<double>(box.size.height);
  if (!(along > 0.0) || !(across > 0.0) || !std::isfinite(along * across)) return {};
  return maps::canonicalEllipse(along, across, static_cast<double>(box.angle) * kRadPerDeg);
}

bool isFar(double read, const Estimate& fitted) { return std::abs(read - fitted.value) > kDiffersSd * fitted.sd; }

bool differs(const ContourReading& reading, const KeyEllipse& key) {
  if (!reading.ellipse) return false;
  const maps::Ellipse& e = *reading.ellipse;
  const double turn = std::abs(std::remainder(e.direction_rad * kDegPerRad - key.direction_deg.value, 180.0));
  return isFar(e.half_major_mm, key.half_major_mm) || isFar(e.half_major_mm * e.aspect, key.half_minor_mm) ||
         turn > kDiffersSd * key.direction_deg.sd;
}

}  // namespace

std::optional<ContourReading> readContour(std::span<const MeasuredDot> dots, const SkinChart& chart,
                                          const FieldFit& fit, double spacing_mm) {
  std::vector<Vec2> places;
  std::vector<Vec2> motions;
  for (const MeasuredDot& dot : dots) {
    if (!dot.after_px) continue;
    places.push_back(dot.skin_mm);
    motions.emplace_back(dot.moved_mm - dot.drift_mm);
  }
  const ThinPlate motion(places, motions, spacing_mm, 0.0);
  const Vec2 contact(fit.contact_x_mm.value, fit.contact_y_mm.value);
  const Traced two = trace(motion, chart, contact, 2.0);
  if (two.inside_share < kMinOfContour) return {};
  ContourReading reading;
  reading.contour_2_mm = two.contour;
  reading.inside_share = two.inside_share;
  reading.contour_4_mm = trace(motion, chart, contact, 4.0).contour;
  measureChord(reading);
  reading.ellipse = directEllipse(two.contour);
  reading.differs = differs(reading, fit.at_2_mm);
  return reading;
}

}  // namespace palpate::measure
