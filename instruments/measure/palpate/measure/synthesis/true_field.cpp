// Based on: Cerruti's solution for a tangential force on an elastic half space, Johnson, "Contact Mechanics", 1985,
// section 3.6 (3.75), spread over a patch; Abramowitz and Stegun, 1964, 9.8.1 to 9.8.4 (the modified Bessel functions).
#include "palpate/measure/synthesis/true_field.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "palpate/base/gaussian.h"

namespace palpate::measure {

namespace {

/// Skin and the tissue under it are almost incompressible.
constexpr double kPoisson = 0.48;
/// A window ends at this many half axes.
constexpr double kWindow = 3.0;
/// Behind the stick becomes before it over about this many half axes.
constexpr double kLopsidedOver = 0.5;

double polynomial(const std::array<double, 9>& factors, double x) {
  double sum = 0.0;
  for (std::size_t i = factors.size(); i-- > 0;) sum = sum * x + factors[i];
  return sum;
}

/// exp(-z) I0(z) and exp(-z) I1(z), z >= 0; to 2e-7.
double scaledBessel0(double z) {
  if (z < 3.75) {
    const double t = z * z / (3.75 * 3.75);
    return std::exp(-z) *
           polynomial({1.0, 3.5156229, 3.0899424, 1.2067492, 0.2659732, 0.0360768, 0.0045813, 0.0, 0.0}, t);
  }
  return polynomial({0.39894228, 0.01328592, 0.00225319, -0.00157565, 0.00916281, -0.02057706, 0.02635537, -0.01647633,
                     0.00392377},
                    3.75 / z) /
         std::sqrt(z);
}

double scaledBessel1(double z) {
  if (z < 3.75) {
    const double t = z * z / (3.75 * 3.75);
    return z * std::exp(-z) *
           polynomial({0.5, 0.87890594, 0.51498869, 0.15084934, 0.02658733, 0.00301532, 0.00032411, 0.0, 0.0}, t);
  }
  return polynomial({0.39894228, -0.03988024, -0.00362018, 0.00163801, -0.01031555, 0.02282967, -0.02895312, 0.01787654,
                     -0.00420059},
                    3.75 / z) /
         std::sqrt(z);
}

/// The root of a falling function between two places.
template <class Function>
double crossing(double low, double high, double level, const Function& falling) {
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (falling(middle) > level ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// exp(-rho^2) or (1 + rho^2 / P)^-P is `share` of the peak at this rho^2.
double rhoSquaredAt(double share, double inverse_tail) {
  if (inverse_tail <= 0.0) return -std::log(share);
  return (std::pow(share, -inverse_tail) - 1.0) / inverse_tail;
}

/// Half axes and direction of an ellipse from x' form x = 1.
KeyEllipse ellipseOfForm(const Mat2& form, double level_mm) {
  const Eigen::SelfAdjointEigenSolver<Mat2> axes(form);
  const Vec2 major = axes.eigenvectors().col(0);
  KeyEllipse ellipse;
  ellipse.level_mm = level_mm;
  ellipse.half_major_mm.value = 1.0 / std::sqrt(axes.eigenvalues()[0]);
  ellipse.half_minor_mm.value = 1.0 / std::sqrt(axes.eigenvalues()[1]);
  ellipse.major_over_minor.value = ellipse.half_major_mm.value / ellipse.half_minor_mm.value;
  double direction = std::atan2(major.y(), major.x()) * kDegPerRad;
  if (direction > 90.0) direction -= 180.0;
  if (direction <= -90.0) direction += 180.0;
  ellipse.direction_deg.value = direction;
  return ellipse;
}

/// The conic a x^2 + b x y + c y^2 + d x + e y = 1 through these places in the sense of least squares, about its
/// middle.
Mat2 formThrough(const Eigen::Matrix2Xd& places) {
  const double size = std::sqrt(places.colwise().squaredNorm().mean());
  Eigen::MatrixXd rows(places.cols(), 5);
  for (Eigen::Index i = 0; i < places.cols(); ++i) {
    const Vec2 p = places.col(i) / size;
    rows.row(i) << p.x() * p.x(), p.x() * p.y(), p.y() * p.y(), p.x(), p.y();
  }
  const Eigen::VectorXd conic = rows.colPivHouseholderQr().solve(Eigen::VectorXd::Ones(places.cols()));
  Mat2 form;
  form << conic[0], 0.5 * conic[1], 0.5 * conic[1], conic[2];
  const Vec2 slope(conic[3], conic[4]);
  const double level = 1.0 + 0.25 * slope.dot(form.inverse() * slope);
  return form / (level * size * size);
}

}  // namespace

TrueField::TrueField(const Press& press) : press_(press) {
  const Vec2 drag(std::cos(press.drag_rad), std::sin(press.drag_rad));
  formula_.contact_mm = press.contact_mm;
  formula_.peak_mm = press.peak_mm * drag;
  const double share = press.peak_mm > 2.0 ? 2.0 / press.peak_mm : 0.5;  // half the peak where 2 mm is never reached
  if (press.family == TailFamily::compact || press.family == TailFamily::long_tail) {
    formula_.sideways = press.sideways;
    formula_.inverse_tail = press.family == TailFamily::compact ? 0.0 : 1.0 / press.tail_power;
    const double rho = std::sqrt(rhoSquaredAt(share, formula_.inverse_tail));
    const double mean = 2.0 * std::log(rho / press.half_major_mm) + std::log(press.ratio);
    const double spread = -std::log(press.ratio);  // W is smaller along the major axis
    const double cosine = std::cos(2.0 * press.direction_rad);
    formula_.log_shape = {mean + spread * cosine, spread * std::sin(2.0 * press.direction_rad), mean - spread * cosine};
    return;
  }
  if (press.family == TailFamily::given) return;
  window_mm_ = press.family == TailFamily::windowed_half_space ? kWindow * press.half_major_mm : 0.0;
  // The wider the patch, the more its load must be for the same peak, and the more then moves at the 2 mm contour.
  const auto narrowness_to_level = [&](double narrowness) {
    patch_mm_ = 1.0 / narrowness;
    strength_ = press.peak_mm / ((1.0 - 0.5 * kPoisson) * std::sqrt(0.5 * std::numbers::pi) * narrowness);
    return halfSpaceAt(press.half_major_mm * drag).norm();
  };
  crossing(1.0 / press.half_major_mm, 10.0, share * press.peak_mm, narrowness_to_level);
}

Vec2 TrueField::halfSpaceAt(const Vec2& offset_mm) const {
  const Vec2 drag(std::cos(press_.drag_rad), std::sin(press_.drag_rad));
  const double z = offset_mm.squaredNorm() / (4.0 * patch_mm_ * patch_mm_);
  const double scale = strength_ * std::sqrt(0.5 * std::numbers::pi) / patch_mm_;
  const double angle =
      offset_mm.squaredNorm() > 0.0 ? 2.0 * (std::atan2(offset_mm.y(), offset_mm.x()) - press_.drag_rad) : 0.0;
  const double round = (1.0 - 0.5 * kPoisson) * scaledBessel0(z);
  const double lobes = 0.5 * kPoisson * scaledBessel1(z);
  const Vec2 across(-drag.y(), drag.x());
  const Vec2 moved = scale * ((round + lobes * std::cos(angle)) * drag + lobes * std::sin(angle) * across);
  if (window_mm_ == 0.0) return moved;
  const double rest = 1.0 - offset_mm.squaredNorm() / (window_mm_ * window_mm_);
  return rest > 0.0 ? Vec2(rest * rest * moved) : Vec2::Zero();
}

Vec2 TrueField::displacementAt(const Vec2& place_mm) const {
  if (press_.peak_mm == 0.0) return Vec2::Zero();
  const Vec2 offset = place_mm - press_.contact_mm;
  const bool in_family = press_.family == TailFamily::compact || press_.family == TailFamily::long_tail;
  const auto moved_outside = [&] {
    return press_.family == TailFamily::given ? press_.given(offset) : halfSpaceAt(offset);
  };
  const Vec2 moved = in_family ? measure::displacementAt(formula_, place_mm) : moved_outside();
  if (press_.asymmetry == 0.0) return moved;
  const double ahead = offset.dot(formula_.peak_mm) / press_.peak_mm;
  return (1.0 - 0.5 * press_.asymmetry * std::tanh(ahead / (kLopsidedOver * press_.half_major_mm))) * moved;
}

double TrueField::dentAt(const Vec2& place_mm) const {
  const double rim = 13.0 + 1.4 * press_.dent_mm;
  return press_.dent_mm * halfGaussian((place_mm - press_.contact_mm).norm() / rim);
}

KeyEllipse TrueField::ellipseAt(double level_mm) const {
  KeyEllipse none;
  none.level_mm = level_mm;
  if (press_.peak_mm <= level_mm) return none;
  const bool in_family = press_.family == TailFamily::compact || press_.family == TailFamily::long_tail;
  if (in_family && press_.asymmetry == 0.0 && press_.sideways == 0.0) {
    const double grown = std::sqrt(rhoSquaredAt(level_mm / press_.peak_mm, formula_.inverse_tail) /
                                   rhoSquaredAt(2.0 / press_.peak_mm, formula_.inverse_tail));
    const double half_major = grown * press_.half_major_mm;
    const Eigen::Rotation2Dd turn(press_.direction_rad);
    const Vec2 diagonal(1.0 / (half_major * half_major), press_.ratio * press_.ratio / (half_major * half_major));
    return ellipseOfForm(turn.toRotationMatrix() * diagonal.asDiagonal() * turn.toRotationMatrix().transpose(),
                         level_mm);
  }
  constexpr int kRays = 180;
  Eigen::Matrix2Xd places(2, kRays);
  for (int i = 0; i < kRays; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kRays;
    const Vec2 ray(std::cos(angle), std::sin(angle));
    const double reach = crossing(0.0, 10.0 * press_.half_major_mm, level_mm, [&](double distance) {
      return displacementAt(press_.contact_mm + distance * ray).norm();
    });
    places.col(i) = reach * ray;
  }
  return ellipseOfForm(formThrough(places), level_mm);
}

double TrueField::largestShortening() const {
  if (press_.peak_mm == 0.0) return 0.0;
  constexpr double kStep = 0.5;
  const Vec2 drag = formula_.peak_mm / press_.peak_mm;
  const Vec2 across(-drag.y(), drag.x());
  double largest = 0.0;
  for (double along = 0.0; along < 80.0; along += 2.0) {
    for (double beside = -40.0; beside <= 40.0; beside += 4.0) {
      const Vec2 place = press_.contact_mm + along * drag + beside * across;
      const Vec2 change = displacementAt(place + kStep * drag) - displacementAt(place - kStep * drag);
      largest = std::max(largest, -change.dot(drag) / (2.0 * kStep));
    }
  }
  return largest;
}

}  // namespace palpate::measure
