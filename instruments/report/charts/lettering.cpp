// A label tries ten spots round its place, the nearer ones first; if none is free it stays at the first.
#include "report/charts/lettering.h"

#include <array>

namespace palpate::figures {

std::string withUnit(const std::string& label, const std::string& unit) {
  return unit.empty() ? label : label + " (" + unit + ")";
}

bool isFree(const Canvas& canvas, const Rect& box, const Rect& bounds) {
  constexpr double kApartPx = 1.0;
  if (box.left < bounds.left || box.right > bounds.right || box.top < bounds.top || box.bottom > bounds.bottom) {
    return false;
  }
  for (const DrawnText& other : canvas.texts()) {
    if (box.left < other.right + kApartPx && other.left < box.right + kApartPx && box.top < other.bottom + kApartPx &&
        other.top < box.bottom + kApartPx) {
      return false;
    }
  }
  return true;
}

void drawBeside(Canvas& canvas, const Vec2& at, const std::string& text, const Colour& colour, const Rect& bounds) {
  struct Spot {
    Vec2 offset;
    Align across;
    Align down;
  };
  const std::array spots{
      Spot{{7.0, 0.0}, Align::start, Align::middle},   Spot{{-7.0, 0.0}, Align::end, Align::middle},
      Spot{{0.0, -6.0}, Align::middle, Align::end},    Spot{{0.0, 6.0}, Align::middle, Align::start},
      Spot{{7.0, -10.0}, Align::start, Align::middle}, Spot{{7.0, 10.0}, Align::start, Align::middle},
      Spot{{-7.0, -10.0}, Align::end, Align::middle},  Spot{{-7.0, 10.0}, Align::end, Align::middle},
      Spot{{9.0, -24.0}, Align::start, Align::middle}, Spot{{9.0, 24.0}, Align::start, Align::middle},
  };
  const auto style_at = [&](const Spot& spot) {
    return TextStyle{.size_px = 11.0, .colour = colour, .across = spot.across, .down = spot.down, .halo = true};
  };
  const Spot* chosen = spots.data();
  for (const Spot& spot : spots) {
    if (!isFree(canvas, canvas.textBox(at + spot.offset, text, style_at(spot)), bounds)) continue;
    chosen = &spot;
    break;
  }
  canvas.text(at + chosen->offset, text, style_at(*chosen));
}

}  // namespace palpate::figures
