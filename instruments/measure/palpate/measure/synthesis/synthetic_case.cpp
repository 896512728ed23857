#include "palpate/measure/synthesis/synthetic_case.h"

#include <cmath>
#include <numbers>

#include "palpate/base/random.h"
#include "palpate/measure/synthesis/true_field.h"

namespace palpate::measure {

namespace {

constexpr double kPi = std::numbers::pi;
/// Skin before the stick is never pushed together by more than this share.
constexpr double kMaxShortening = 0.7;
constexpr double kBackWidth = 350.0;
constexpr double kBackLength = 400.0;

int between(Random& random, int least, int most) {
  return least + static_cast<int>(random.below(static_cast<std::uint64_t>(most - least) + 1));
}

/// A separate stream for each part, so that drawing more for one does not change the others.
Random makeRandomStream(std::uint64_t seed, std::uint64_t part) {
  Random mixed(seed ^ (part * 0xd1342543de82ef95ull));
  return Random(mixed.bits());
}

BackShape drawBack(Random random) {
  BackShape back;
  back.flank_mm = random.uniform(22.0, 42.0);
  back.flank_power = random.uniform(2.1, 2.6);
  back.sway_mm = random.uniform(3.0, 12.0);
  back.blade_mm = random.uniform(6.0, 15.0);
  back.blade_apart_mm = random.uniform(68.0, 85.0);
  back.furrow_mm = random.uniform(3.0, 8.0);
  back.furrow_width_mm = random.uniform(11.0, 18.0);
  return back;
}

SkinLook drawSkin(Random random) {
  SkinLook skin;
  skin.colour = between(random, 0, 3);
  skin.moles = between(random, 5, 30);
  skin.hairs = between(random, 0, 150);
  skin.seed = random.bits();
  return skin;
}

DotMarks drawMarks(Random random) {
  DotMarks marks;
  const double hue = random.uniform();
  marks.ink = hue < 0.73 ? InkColour::red : hue < 0.87 ? InkColour::blue : InkColour::green;
  marks.opacity = random.uniform(0.75, 0.95);
  marks.radius_mm = random.uniform(3.0, 5.0);
  marks.jitter_mm = random.uniform(0.2, 0.8);
  marks.columns = between(random, 9, 11);
  marks.rows = between(random, 11, 13);
  // Somewhere on the back, but never over its rim.
  const Vec2 room = {0.5 * (kBackWidth - 24.0 - 30.0 * (marks.columns - 1)),
                     0.5 * (kBackLength - 24.0 - 30.0 * (marks.rows - 1))};
  const Vec2 middle = {random.uniform(-1.0, 1.0) * room.x(), random.uniform(-1.0, 1.0) * room.y()};
  marks.corner_mm = middle - 15.0 * Vec2(marks.columns - 1, marks.rows - 1);
  marks.seed = random.bits();
  return marks;
}

Press drawPress(Random random, const std::optional<TailFamily>& requested) {
  Press press;
  const bool compact = random.uniform() < 0.5;
  press.family = requested.value_or(compact ? TailFamily::compact : TailFamily::long_tail);
  press.contact_mm = {random.uniform(-30.0, 30.0), random.uniform(-40.0, 40.0)};
  press.half_major_mm = random.uniform(50.0, 130.0);
  press.ratio = random.uniform(1.0, 1.8);
  press.direction_rad = random.uniform(-0.5 * kPi, 0.5 * kPi);
  do {
    press.peak_mm = random.uniform(8.0, 25.0);
    press.drag_rad = random.uniform(-kPi, kPi);
    press.tail_power = random.uniform(0.56, 0.91);
  } while (TrueField(press).largestShortening() > kMaxShortening);
  press.dent_mm = random.uniform(3.0, 12.0);
  press.stick_length_mm = random.uniform(85.0, 140.0);
  press.stick_turn_rad = random.uniform(-0.4, 0.4);
  press.arm_turn_rad = random.uniform(-0.5, 0.5);
  return press;
}

CameraPose drawCamera(Random random) {
  CameraPose camera;
  camera.distance_mm = random.uniform(900.0, 1800.0);
  camera.tilt_rad = random.uniform(0.0, 25.0) * kRadPerDeg;
  camera.tilt_azimuth_rad = random.uniform(-kPi, kPi);
  camera.roll_rad = random.uniform(-15.0, 15.0) * kRadPerDeg;
  camera.distortion = random.uniform(-0.02, 0.02);
  camera.aim_mm = {random.uniform(-8.0, 8.0), random.uniform(-8.0, 8.0)};
  return camera;
}

PictureLook drawLook(Random random) {
  PictureLook look;
  const double around = random.uniform(-kPi, kPi);
  const double oblique = random.uniform(20.0, 50.0) * kRadPerDeg;
  look.light = {std::sin(oblique) * std::cos(around), std::sin(oblique) * std::sin(around), std::cos(oblique)};
  look.ambient = random.uniform(0.4, 0.6);
  look.sheen = random.uniform(0.0, 0.12);
  look.vignette = random.uniform(0.0, 0.3);
  look.balance = {random.uniform(0.9, 1.1), 1.0, random.uniform(0.9, 1.1)};
  look.exposure = random.uniform(0.85, 1.15);
  look.blur_px = random.uniform(0.5, 1.5);
  look.noise = random.uniform(1.0, 4.0);
  look.jpeg_quality = between(random, 75, 95);
  look.seed = random.bits();
  return look;
}

}  // namespace

BodyMotion drawMotion(std::uint64_t seed, double drift_mm) {
  Random random(seed);
  const double size = drift_mm / 1.5;
  BodyMotion motion;
  motion.shift_mm = size * Vec3(1.5, 1.5, 2.0).cwiseProduct(random.normal3());
  motion.turn_rad = size * 0.3 * kRadPerDeg * random.normal3();
  motion.scale = size * 0.0015 * random.normal();
  return motion;
}

SyntheticCase drawCase(std::uint64_t seed, const CaseRequests& requests) {
  SyntheticCase drawn;
  drawn.seed = seed;
  // 3 to 4, upright, in steps of the blocks that JPEG is made of.
  const double unit = std::sqrt(requests.megapixels * 1e6 / 12.0) / 8.0;
  drawn.width_px = 8 * static_cast<int>(std::lround(3.0 * unit));
  drawn.height_px = 8 * static_cast<int>(std::lround(4.0 * unit));
  drawn.back = drawBack(makeRandomStream(seed, 1));
  drawn.skin = drawSkin(makeRandomStream(seed, 2));
  drawn.marks = drawMarks(makeRandomStream(seed, 3));
  drawn.press = drawPress(makeRandomStream(seed, 4), requests.family);
  drawn.camera = drawCamera(makeRandomStream(seed, 5));
  drawn.motion = drawMotion(makeRandomStream(seed, 6).bits(), requests.drift_mm);
  drawn.null_motion = drawMotion(makeRandomStream(seed, 7).bits(), requests.drift_mm);
  drawn.look = drawLook(makeRandomStream(seed, 8));
  return drawn;
}

}  // namespace palpate::measure
