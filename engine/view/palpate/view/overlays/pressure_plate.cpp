// The plate of a pad: taxels as squares, seen from outside with the head above, a bar from 0 to a round number, the
// greatest value. Laid out again for each picture.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "palpate/base/language.h"
#include "palpate/view/layers/drawing.h"
#include "palpate/view/overlays/legend.h"
#include "palpate/view/overlays/pressure_pad.h"

namespace palpate::view {

namespace {

constexpr float kPlatePad = 8.0f;
constexpr float kPadStripe = 3.0f;  ///< in the finger's colour, at the left edge
constexpr float kHeatBar = 9.0f;
constexpr float kBarNumbers = 30.0f;
constexpr float kPadWords = 18.0f;            ///< a line of text above, and one below
constexpr std::size_t kMaxNumbersAcross = 4;  ///< along a side: smaller taxels have no room for theirs

struct PadPlate {
  Vec2f corner;  ///< upper left
  float side;    ///< side of the square of taxels
  Vec2f size() const {
    return {kPadStripe + side + kHeatBar + kBarNumbers + 3.0f * kPlatePad, side + 2.0f * kPadWords + kPlatePad};
  }
  Vec2f square() const { return corner + Vec2f(kPadStripe + kPlatePad, kPadWords + 0.5f * kPlatePad); }
};

float plateSide(const Drawing& page) { return std::round(std::clamp(0.16f * page.size().y(), 64.0f, 112.0f)); }

/// Dark letters on the light end of the colours.
Ink numberInk(double share) {
  constexpr double kLight = 0.62;
  return share > kLight ? Ink{{20, 20, 24}} : Ink{{245, 245, 245}};
}

void drawTaxels(Drawing& page, const PadReading& reading, double top_kpa, const PadPlate& plate,
                const LabelInks& inks) {
  const std::size_t n = reading.pad.taxels;
  const float cell = plate.side / static_cast<float>(n);
  const float half_line = 0.5f * page.measure("0", TextSize::small).y();
  for (std::size_t i = 0; i < reading.kpa.size(); ++i) {
    const std::size_t row = i / n;
    const Vec2f corner = plate.square() + cell * Vec2f(static_cast<float>(i % n), static_cast<float>(row));
    const double share = reading.kpa[i] / top_kpa;
    page.box(corner, corner + Vec2f::Constant(cell), Ink{heatColour(share)});
    if (n > kMaxNumbersAcross || reading.kpa[i] < 0.5) continue;
    page.text(corner + Vec2f(0.5f * cell, 0.5f * cell - half_line), fmt::format("{:.0f}", reading.kpa[i]),
              numberInk(share), Align::centre, TextSize::small);
  }
  for (std::size_t i = 0; i <= n && n <= 8; ++i) {
    const float at = static_cast<float>(i) * cell;
    page.line(plate.square() + Vec2f(at, 0.0f), plate.square() + Vec2f(at, plate.side), inks.grid);
    page.line(plate.square() + Vec2f(0.0f, at), plate.square() + Vec2f(plate.side, at), inks.grid);
  }
}

void drawHeatBar(Drawing& page, double top_kpa, const PadPlate& plate, const LabelInks& inks) {
  const Vec2f corner = plate.square() + Vec2f(plate.side + kPlatePad, 0.0f);
  constexpr int kSteps = 48;
  const float step = plate.side / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const Vec2f from = corner + Vec2f(0.0f, static_cast<float>(i) * step);
    page.box(from, from + Vec2f(kHeatBar, step), Ink{heatColour(1.0 - (i + 0.5) / kSteps)});
  }
  const float half_line = 0.5f * page.measure("0", TextSize::small).y();
  const auto marks = roundMarks(0.0, top_kpa, 4);
  const double apart = marks.size() > 1 ? marks[1] - marks[0] : top_kpa;
  for (const double mark : marks) {
    const float y = corner.y() + static_cast<float>(1.0 - mark / top_kpa) * plate.side;
    page.line({corner.x() + kHeatBar, y}, {corner.x() + kHeatBar + 3.0f, y}, inks.letter);
    page.text({corner.x() + kHeatBar + 6.0f, y - half_line}, markText(mark, apart), inks.letter, Align::left,
              TextSize::small);
  }
}

void drawPad(Drawing& page, const PadReading& reading, double top_kpa, const PadPlate& plate, const LabelInks& inks) {
  const Vec2f opposite = plate.corner + plate.size();
  page.box(plate.corner, opposite, inks.plate, 4.0f);
  page.box(plate.corner, plate.corner + Vec2f(kPadStripe, plate.size().y()), Ink{encodedColour(reading.colour)});
  const float left = plate.square().x();
  page.text({left, plate.corner.y() + 4.0f}, tr("pressure, kPa"), inks.letter, Align::left, TextSize::small);
  drawTaxels(page, reading, top_kpa, plate, inks);
  drawHeatBar(page, top_kpa, plate, inks);
  const std::string words =
      reading.touches ? trf("greatest {:.1f} kPa", reading.greatest_kpa) : std::string(tr("no contact"));
  page.text({left, plate.square().y() + plate.side + 4.0f}, words, inks.letter, Align::left, TextSize::small);
}

}  // namespace

std::vector<LabelBox> drawPads(Drawing& page, std::span<const PadReading> readings, const Vec2f& corner, float width,
                               const LabelInks& inks) {
  std::vector<LabelBox> covered;
  const double top_kpa = padScaleTop(readings);
  PadPlate plate{.corner = corner, .side = plateSide(page)};
  const Vec2f size = plate.size();
  // The first finger is at the left, as it is on the body.
  const auto room = static_cast<std::size_t>(std::max(0.0f, std::floor((width + kPlatePad) / (size.x() + kPlatePad))));
  const std::size_t count = std::min(readings.size(), room);
  for (std::size_t i = 0; i < count; ++i) {
    const auto from_right = static_cast<float>(count - i);
    plate.corner = corner - Vec2f(from_right * (size.x() + kPlatePad) - kPlatePad, size.y());
    drawPad(page, readings[i], top_kpa, plate, inks);
    covered.push_back({plate.corner, plate.corner + size});
  }
  return covered;
}

}  // namespace palpate::view
