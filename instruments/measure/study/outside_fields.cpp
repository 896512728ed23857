// Based on: Johnson, "Contact Mechanics", 1985, sections 3.2 and 3.6 (Boussinesq, Cerruti); the layered drags are those
// of `palpate tissue solve` (elements/drag_solver.h), over the whole plane.
#include "measure/study/outside_fields.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <array>
#include <cmath>
#include <numbers>

#include "palpate/base/error.h"
#include "palpate/base/random.h"

namespace palpate::study {

using measure::Press;
using measure::SyntheticCase;

namespace {

using Motion = std::function<Vec2(const Vec2&)>;

constexpr std::size_t kStacks = 6;  // layered stacks, used by turns
constexpr double kPi = std::numbers::pi;

constexpr std::array kOutsideFamilies = {
    NamedFamily{"layered_mid", OutsideFamily::layered_mid,
                "finite elements: skin of 100 to 220 kPa over fat, muscle, bone"},
    NamedFamily{"layered_stiff", OutsideFamily::layered_stiff,
                "finite elements: skin of 600 to 1300 kPa over the same"},
    NamedFamily{"boussinesq", OutsideFamily::boussinesq,
                "an elastic half space dragged and pressed (Cerruti, Boussinesq)"},
    NamedFamily{"exponential", OutsideFamily::exponential, "exp(-q), an ellipse"},
    NamedFamily{"irregular", OutsideFamily::irregular, "15 to 30 % farther to some sides than to others"}};

tissue::LayerStack drawStack(OutsideFamily family, Random& random) {
  const bool stiff = family == OutsideFamily::layered_stiff;
  const double skin_kpa = stiff ? random.uniform(600.0, 1300.0) : random.uniform(100.0, 220.0);
  tissue::LayerStack stack;
  stack.layers = {{"skin", random.uniform(1.6, 2.4), skin_kpa},
                  {"fat", random.uniform(4.0, 12.0), random.uniform(7.0, 14.0)},
                  {"muscle", random.uniform(20.0, 40.0), random.uniform(20.0, 35.0)}};
  return stack;
}

/// From the frame of the drag, whose x is along it.
Motion turned(double drag_rad, Motion along_x) {
  const Mat2 turn = Eigen::Rotation2Dd(drag_rad).toRotationMatrix();
  return [turn, along_x = std::move(along_x)](const Vec2& offset) -> Vec2 {
    return turn * along_x(turn.transpose() * offset);
  };
}

/// Share of the peak at a place of a half space: a tangential and a normal force at a point, seen at a depth under it
/// that represents the patch which they are spread over.
Motion halfSpace(double depth_mm, double poisson, double pressed_over_dragged) {
  const auto unscaled = [=](const Vec2& p) -> Vec2 {
    const double z = depth_mm;
    const double r = std::sqrt(p.squaredNorm() + z * z);
    const double open = 1.0 - 2.0 * poisson;
    const double along =
        1.0 / r + p.x() * p.x() / (r * r * r) + open * (1.0 / (r + z) - p.x() * p.x() / (r * (r + z) * (r + z)));
    const double cross = p.x() * p.y() / (r * r * r) - open * p.x() * p.y() / (r * (r + z) * (r + z));
    const Vec2 pressed = pressed_over_dragged * (z / (r * r * r) - open / (r * (r + z))) * p;
    return Vec2(along, cross) + pressed;
  };
  const double peak = unscaled(Vec2::Zero()).x();
  return [=](const Vec2& p) -> Vec2 { return unscaled(p) / peak; };
}

/// The depth at which the share along the drag at `half_major_mm` is `share`.
double depthFor(double half_major_mm, double share, double poisson, double pressed) {
  double low = 0.5;
  double high = half_major_mm;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    const double there = halfSpace(middle, poisson, pressed)(Vec2(half_major_mm, 0.0)).norm();
    (there < share ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Coordinates in which the ellipse of the press is the unit circle.
Mat2 toUnit(const Press& press) {
  const Mat2 turn = Eigen::Rotation2Dd(press.direction_rad).toRotationMatrix();
  return Vec2(1.0 / press.half_major_mm, press.ratio / press.half_major_mm).asDiagonal() * turn.transpose();
}

Motion makeExponentialMotion(const Press& press) {
  const Mat2 unit = toUnit(press);
  const Vec2 peak = press.peak_mm * Vec2(std::cos(press.drag_rad), std::sin(press.drag_rad));
  const double rate = std::log(press.peak_mm / 2.0);
  return [=](const Vec2& offset) -> Vec2 { return std::exp(-rate * (unit * offset).norm()) * peak; };
}

Motion makeIrregularMotion(const Press& press, bool long_tail, Random& random) {
  const Mat2 unit = toUnit(press);
  const Vec2 peak = press.peak_mm * Vec2(std::cos(press.drag_rad), std::sin(press.drag_rad));
  const double power = press.tail_power;
  const double level = press.peak_mm / 2.0;
  // q^2 at the unit circle is what leaves 2 mm.
  const double q2 = long_tail ? std::pow(level, 1.0 / power) - 1.0 : std::log(level);
  const double size = random.uniform(0.15, 0.30);
  const double share = random.uniform(0.3, 0.7);  // share of one side against the opposite one
  const double first = random.uniform(-kPi, kPi);
  const double third = random.uniform(-kPi, kPi);
  return [=](const Vec2& offset) -> Vec2 {
    const Vec2 p = unit * offset;
    const double angle = std::atan2(p.y(), p.x());
    const double reach =
        1.0 + size * (share * std::cos(angle - first) + (1.0 - share) * std::cos(3.0 * (angle - third)));
    const double rho2 = q2 * p.squaredNorm() / (reach * reach);
    return (long_tail ? std::pow(1.0 + rho2, -power) : std::exp(-rho2)) * peak;
  };
}

}  // namespace

std::vector<NamedFamily> outsideFamilies() { return {kOutsideFamilies.begin(), kOutsideFamilies.end()}; }

std::string_view nameOf(OutsideFamily family) { return kOutsideFamilies.at(static_cast<std::size_t>(family)).name; }

OutsideFamily parseOutsideFamily(std::string_view name) {
  std::vector<std::string_view> names;
  for (const NamedFamily& family : kOutsideFamilies) {
    if (family.name == name) return family.family;
    names.push_back(family.name);
  }
  throw Error(fmt::format("--family {}: expected one of {}", name, fmt::join(names, ", ")));
}

OutsideFields::OutsideFields(OutsideFamily family, std::uint64_t seed, const Progress& progress) : family_(family) {
  if (family != OutsideFamily::layered_mid && family != OutsideFamily::layered_stiff) return;
  Random random(seed ^ 0x5851f42d4c957f2dull);
  for (std::size_t i = 0; i < kStacks; ++i) {
    report(progress, "Solving layers", static_cast<double>(i) / static_cast<double>(kStacks));
    const tissue::LayerStack stack = drawStack(family, random);
    solved_.push_back(elements::solveDragField(stack, {.patch_radius_mm = random.uniform(5.0, 8.0)}));
  }
}

SyntheticCase OutsideFields::makeCase(std::uint64_t seed, std::size_t i) const {
  SyntheticCase made = measure::drawCase(seed, {.family = measure::TailFamily::long_tail});
  Random random(seed ^ 0xd6e8feb86659fd93ull);
  Press& press = made.press;
  switch (family_) {
    case OutsideFamily::layered_mid:
    case OutsideFamily::layered_stiff: {
      const elements::DragField& field = solved_[i % solved_.size()];
      press.given = turned(press.drag_rad,
                           [field, peak = press.peak_mm](const Vec2& p) -> Vec2 { return peak * field.movedAt(p); });
      break;
    }
    case OutsideFamily::boussinesq: {
      const double poisson = random.uniform(0.40, 0.49);
      const double pressed = random.uniform(0.5, 2.0);
      const double depth = depthFor(press.half_major_mm, 2.0 / press.peak_mm, poisson, pressed);
      press.given = turned(press.drag_rad,
                           [share = halfSpace(depth, poisson, pressed), peak = press.peak_mm](const Vec2& p) -> Vec2 {
                             return peak * share(p);
                           });
      break;
    }
    case OutsideFamily::exponential:
      press.given = makeExponentialMotion(press);
      break;
    case OutsideFamily::irregular:
      press.given = makeIrregularMotion(press, i % 2 == 1, random);
      break;
  }
  press.family = measure::TailFamily::given;
  return made;
}

measure::DotPair exactDots(const measure::SyntheticCase& made, const measure::SyntheticTruth& truth, double noise_mm) {
  Random random(made.seed ^ 0xa0761d6478bd642full);
  measure::DotPair pair;
  const auto seen = [&](const Vec2& place_px) {
    return measure::Dot{place_px + noise_mm * truth.px_per_mm * random.normal2(), 0.0};
  };
  for (const measure::TrueDot& dot : truth.dots) {
    pair.before.push_back(seen(dot.before_px));
    // One that is half hidden has its middle elsewhere; its area would show it.
    if (dot.covered == 0.0) pair.after.push_back(seen(dot.after_px));
  }
  return pair;
}

}  // namespace palpate::study
