#include "measure/study/corrupted_pairs.h"

#include <cmath>
#include <functional>
#include <utility>

#include "palpate/base/random.h"

namespace palpate::study {

using measure::SyntheticCase;

namespace {

/// A kind and what makes it of a good case.
struct Spoiling {
  CorruptedKind kind;
  std::function<void(SyntheticCase&, Random&)> spoil;
};

double sign(Random& random) { return random.uniform() < 0.5 ? -1.0 : 1.0; }

void centreGrid(measure::DotMarks& marks) {
  marks.corner_mm = -0.5 * marks.spacing_mm * Vec2(marks.columns - 1, marks.rows - 1);
}

const std::vector<Spoiling>& spoilings() {
  static const std::vector<Spoiling> all{
      {{"grid of 5 x 5"},
       [](SyntheticCase& made, Random&) {
         made.marks.columns = made.marks.rows = 5;
         made.marks.missing = 0;
         centreGrid(made.marks);
       }},
      {{"another person"}, [](SyntheticCase&, Random&) {}},  // see corruptedPair
      {{"after turned by 90 degrees"},
       [](SyntheticCase& made, Random& random) { made.camera.later_roll_rad = sign(random) * 90.0 * kRadPerDeg; }},
      {{"camera moved by 20 mm"},
       [](SyntheticCase& made, Random& random) {
         const double angle = random.uniform(0.0, 6.28);
         made.camera.later_shift_mm = 20.0 * Vec2(std::cos(angle), std::sin(angle));
       }},
      {{"body rolled by 4 degrees"},
       [](SyntheticCase& made, Random& random) { made.motion.turn_rad.y() += sign(random) * 4.0 * kRadPerDeg; }},
      {{"body shifted by 4 mm"},
       [](SyntheticCase& made, Random& random) {
         const double angle = random.uniform(0.0, 6.28);
         made.motion.shift_mm += 4.0 * Vec3(std::cos(angle), std::sin(angle), 0.0);
       }},
      {{"too dark"}, [](SyntheticCase& made, Random&) { made.look.exposure *= 0.004; }},
      {{"black and white"}, [](SyntheticCase& made, Random&) { made.look.grey = true; }},
      {{"nothing pressed"}, [](SyntheticCase& made, Random&) { made.press.peak_mm = made.press.dent_mm = 0.0; }},
      {{"contact at the rim of the grid"},
       [](SyntheticCase& made, Random& random) {
         const int outer = random.uniform() < 0.5 ? 0 : made.marks.columns - 1;
         made.press.contact_mm = made.marks.corner_mm +
                                 made.marks.spacing_mm * Vec2(outer, random.uniform(0.3, 0.7) * (made.marks.rows - 1));
       }},
      {{"marks off by 3 mm"}, [](SyntheticCase& made, Random&) { made.marks.jitter_mm = 3.0; }},
      {{"pictures swapped"}, [](SyntheticCase&, Random&) {}},  // see corruptedPair
      {{"half axis of 180 mm", Fate::refused_or_right},
       [](SyntheticCase& made, Random&) { made.press.half_major_mm = 180.0; }},
      {{"40 dots missing", Fate::refused_or_right}, [](SyntheticCase& made, Random&) { made.marks.missing = 40; }},
      {{"15 dots missing, 25 strays", Fate::refused_or_right},
       [](SyntheticCase& made, Random&) {
         made.marks.missing = 15;
         made.marks.strays = 25;
       }},
      {{"blur of 6 px", Fate::refused_or_right}, [](SyntheticCase& made, Random&) { made.look.blur_px = 6.0; }},
      {{"blur of 12 px", Fate::refused_or_right}, [](SyntheticCase& made, Random&) { made.look.blur_px = 12.0; }},
      {{"spacing given as 25 mm", Fate::not_seen}, [](SyntheticCase&, Random&) {}}};  // see corruptedPair
  return all;
}

std::size_t kindNamed(const std::string& name) {
  std::size_t i = 0;
  while (corruptedKinds()[i].name != name) ++i;
  return i;
}

}  // namespace

const std::vector<CorruptedKind>& corruptedKinds() {
  static const std::vector<CorruptedKind> kinds = [] {
    std::vector<CorruptedKind> all;
    for (const Spoiling& spoiling : spoilings()) all.push_back(spoiling.kind);
    return all;
  }();
  return kinds;
}

CorruptedPair corruptedPair(std::size_t kind, std::uint64_t seed, double megapixels) {
  CorruptedPair pair;
  Random random(seed ^ (0x9e3779b97f4a7c15ull * (kind + 1)));
  pair.made = measure::drawCase(random.bits(), {.megapixels = megapixels});
  spoilings()[kind].spoil(pair.made, random);
  measure::SyntheticPair rendered = measure::renderPair(pair.made);
  pair.truth = std::move(rendered.truth);
  pair.before = std::move(rendered.before);
  pair.after = std::move(rendered.after);
  if (kind == kindNamed("another person")) {
    // Same ink and camera: only the back is another's.
    SyntheticCase other = measure::drawCase(random.bits(), {.megapixels = megapixels});
    other.marks.ink = pair.made.marks.ink;
    other.camera = pair.made.camera;
    pair.after = measure::throughJpeg(measure::renderPicture(other, measure::Moment::after), other.look.jpeg_quality);
  } else if (kind == kindNamed("pictures swapped")) {
    std::swap(pair.before, pair.after);
  } else if (kind == kindNamed("spacing given as 25 mm")) {
    pair.settings.spacing_mm = 25.0;
  }
  return pair;
}

}  // namespace palpate::study
