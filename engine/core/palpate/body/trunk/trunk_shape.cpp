// Own. Amounts of fat and muscle are our choice by eye against photographs of builds, so that the waist gains 2 cm a
// unit of body mass index (1.8 in a survey of 3,600 adults: Hajian-Tilaki and Heidari, "The link between BMI and waist
// circumference in northern Iranian adults").
#include "palpate/body/trunk/trunk_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "palpate/base/elementary.h"
#include "palpate/base/error.h"

namespace palpate::body {

namespace {

std::string plain(double number) { return std::to_string(number).substr(0, std::to_string(number).find('.') + 2); }

/// A smooth hill over a place of the fitted body: 1 at its middle, 1/e at its half widths.
struct Hill {
  Vec3 middle;  // mm; x of the right side, both sides have it
  Vec3 width;   // mm
  double height;
};

double hillsAt(std::span<const Hill> hills, const Vec3& place) {
  double sum = 0;
  const auto add = [&](const Hill& hill, double side) {
    const Vec3 offset(side * place.x() - hill.middle.x(), place.y() - hill.middle.y(), place.z() - hill.middle.z());
    const double square = offset.cwiseQuotient(hill.width).squaredNorm();
    if (square < 16) sum += hill.height * elementary::exp(-square);
  };
  for (const Hill& hill : hills) {
    add(hill, 1);
    if (hill.middle.x() > 0) add(hill, -1);
  }
  return sum;
}

// Fat, mm a unit of body mass index. Everywhere, and more at:
constexpr double kFatEverywhere = 0.9;
const std::array<Hill, 9> kFat = {{
    {{0, -225, -110}, {115, 110, 80}, 3.6},  // belly
    {{60, -120, -95}, {70, 80, 60}, 0.7},    // upper belly
    {{140, -200, -10}, {60, 105, 85}, 3.2},  // flanks
    {{75, 65, -85}, {55, 45, 55}, 1.3},      // breast
    {{150, -60, -10}, {50, 70, 75}, 1.0},    // side of the chest
    {{75, -390, 110}, {65, 70, 60}, 1.8},    // buttocks
    {{70, -200, 85}, {75, 80, 50}, 1.5},     // loin
    {{150, -430, 10}, {60, 100, 95}, 1.9},   // hips
    {{0, 215, 0}, {80, 40, 80}, 0.3},        // neck
}};

// Muscle, mm from wasted to fitted and from fitted to athletic.
const std::array<Hill, 9> kMuscle = {{
    {{38, -110, 90}, {24, 110, 40}, 3.5},   // erector spinae
    {{60, 140, 60}, {50, 45, 50}, 4.0},     // trapezius
    {{125, 10, 60}, {45, 80, 60}, 5.0},     // latissimus
    {{85, 60, 105}, {45, 50, 40}, 2.0},     // infraspinatus
    {{75, 75, -90}, {60, 45, 50}, 6.5},     // pectoralis
    {{225, 90, 10}, {55, 60, 70}, 6.0},     // deltoid and arm
    {{40, -120, -100}, {35, 90, 40}, 2.0},  // rectus abdominis
    {{75, -390, 110}, {65, 65, 60}, 5.0},   // gluteus maximus
    {{110, -490, -20}, {70, 60, 90}, 5.0},  // thigh
}};

// Deep places where two stretches of skin face each other grow less, or they would meet: armpits, groin, cleft, crotch.
const std::array<Hill, 4> kFolds = {{
    {{175, 22, 10}, {32, 34, 60}, 0.9},
    {{0, -470, -10}, {34, 60, 90}, 0.95},
    {{0, -400, 105}, {20, 90, 55}, 1.0},
    {{75, -400, -95}, {40, 45, 40}, 0.5},
}};

constexpr double kMinCoverMm = 5.0;  // mm of tissue that remain in any lean body
constexpr double kSpareShare = 0.6;  // at most this share of the tissue between it and the skin goes

// Heights of the axis that a bend knows, mm: below the thighs' stumps to above the neck's.
constexpr double kBentLow = -700;
constexpr double kBentHigh = 400;

}  // namespace

void check(const TrunkShape& shape) {
  for (const auto& [name, words, member, low, high, unit] : kShapeNumbers) {
    if (shape.*member >= low && shape.*member <= high) continue;
    throw Error(std::string(words) + " " + plain(shape.*member) + unit + " is out of range: " + plain(low) + " to " +
                plain(high));
  }
}

double softTissueGrowth(const TrunkShape& shape, const Vec3& place) {
  const double more_mass = shape.body_mass_index - kFittedMassIndex;
  const double more_muscle = shape.muscle - 1;
  if (more_mass == 0 && more_muscle == 0) return 0;
  const double fat = more_mass * (kFatEverywhere + hillsAt(kFat, place));
  const double muscle = more_muscle * hillsAt(kMuscle, place);
  const double open = 1 - std::min(hillsAt(kFolds, place), 1.0);
  return (fat + muscle) * open;
}

double keptOffBone(double growth, double depth_mm) {
  if (growth >= 0) return growth;
  const double most = kSpareShare * std::max(depth_mm - kMinCoverMm, 0.0);
  // Towards `most` without a kink: thin skin over a rib follows it, between ribs it sinks.
  return most > 0 ? -most * elementary::tanh(-growth / most) : 0.0;
}

BodyWarp::Bend::Bend(double axis_z, double fixed_y, std::vector<Window> windows, bool upright)
    : axis_z_(axis_z), windows_(std::move(windows)) {
  const auto index = [](double y) { return static_cast<std::size_t>(std::lround(y - kBentLow)); };
  const auto build = [&] {
    axis_.assign(index(kBentHigh) + 1, Vec2(fixed_y, axis_z));
    const auto middle = [&](double y) { return Vec2(elementary::cos(angleAt(y)), -elementary::sin(angleAt(y))); };
    for (std::size_t i = index(fixed_y); i + 1 < axis_.size(); ++i) {
      axis_[i + 1] = axis_[i] + middle(kBentLow + static_cast<double>(i) + 0.5);
    }
    for (std::size_t i = index(fixed_y); i > 0; --i)
      axis_[i - 1] = axis_[i] - middle(kBentLow + static_cast<double>(i) - 0.5);
  };
  angle_offset_ = -angleAt(fixed_y);
  build();
  if (!upright) return;
  // The neck stays above the sacrum: the whole body leans back by what the bend leans it forward.
  constexpr double kNeckY = 190;
  const Vec2 neck = axis_[index(kNeckY)] - axis_[index(fixed_y)];
  angle_offset_ -= elementary::atan2(-neck.y(), neck.x());
  build();
}

double BodyWarp::Bend::angleAt(double y) const {
  double angle = angle_offset_;
  for (const Window& window : windows_) {
    const double t = std::clamp((y - window.low) / (window.high - window.low), 0.0, 1.0);
    angle += window.angle * (t - elementary::sin(2 * std::numbers::pi * t) / (2 * std::numbers::pi));
  }
  return angle;
}

Vec3 BodyWarp::Bend::operator()(const Vec3& point) const {
  const double place = std::clamp(point.y() - kBentLow, 0.0, static_cast<double>(axis_.size()) - 1.001);
  const auto below = static_cast<std::size_t>(place);
  const double share = place - static_cast<double>(below);
  const Vec2 axis = (1 - share) * axis_[below] + share * axis_[below + 1];
  const double angle = angleAt(point.y());
  const double out = point.z() - axis_z_;
  return {point.x(), axis.x() + out * elementary::sin(angle), axis.y() + out * elementary::cos(angle)};
}

namespace {

constexpr double kSpineAxisZ = 20;  // mm, about the middle of the vertebral bodies and arches
constexpr double kSacrumY = -300;   // stays where it is
constexpr double kSitStraighter =
    18;  // degrees that sitting reduces the lordosis; our choice within the published 15-30
constexpr double kHipFlexionDeg = 62;  // the thighs' stumps
constexpr double kHipAxisZ = -92;      // mm, just inside the groin, which folds; the buttock stretches
constexpr double kHipHighY = -345;
constexpr double kHipLowY = -500;

double lordosisChange(const TrunkShape& shape) {
  return shape.lordosis_deg - kFittedLordosisDeg - (shape.posture == Posture::sitting ? kSitStraighter : 0);
}

}  // namespace

BodyWarp::BodyWarp(const TrunkShape& shape)
    : asymmetry_{.amount = shape.asymmetry},
      girth_(shape.girth),
      spine_(kSpineAxisZ, kSacrumY,
             {{-110, 190, kRadPerDeg * (shape.kyphosis_deg - kFittedKyphosisDeg)},
              {-290, -100, -kRadPerDeg * lordosisChange(shape)}},
             true),
      hips_(kHipAxisZ, kHipHighY,
            {{kHipLowY, kHipHighY, shape.posture == Posture::sitting ? kRadPerDeg * kHipFlexionDeg : 0}}, false) {}

Vec3 BodyWarp::operator()(const Vec3& point) const {
  const Vec3 bent = hips_(spine_(warp(asymmetry_, point).position));
  return {girth_ * bent.x(), bent.y(), girth_ * bent.z()};
}

namespace {
constexpr double kPressedFlatMm = 9;  // how deep the table goes into the unpressed body
constexpr double kPressEdgeMm = 5;    // how softly the flat part begins
}  // namespace

double tablePlane(double lowest_z) { return lowest_z + kPressedFlatMm; }

Vec3 flattened(const Vec3& point, double plane_z) {
  const double over = (point.z() - plane_z) / kPressEdgeMm;
  if (over > 30) return point;
  return {point.x(), point.y(), plane_z + kPressEdgeMm * elementary::log1p(elementary::exp(over))};
}

}  // namespace palpate::body
