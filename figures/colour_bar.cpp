#include "figures/colour_bar.h"

#include <algorithm>

namespace palpate::figures {

void drawColourBar(Canvas& canvas, const Rect& bar, ColourMap colours, const Range& range,
                   const std::vector<Tick>& ticks, const std::string& label) {
  constexpr int kSteps = 256;
  std::vector<std::uint32_t> pixels;
  pixels.reserve(kSteps);
  for (int i = 0; i < kSteps; ++i) pixels.push_back(pixelOf(mapColour(colours, 1.0 - (i + 0.5) / kSteps)));
  canvas.image(bar, 1, kSteps, pixels);
  canvas.rectangle(bar, Pen{kInk, 0.8}, std::nullopt);
  const AxisMapping place{range, Scale::linear, bar.bottom, bar.top};
  double right = bar.right;
  for (const Tick& tick : ticks) {
    const double y = place(tick.value);
    canvas.line({bar.right, y}, {bar.right + 4.0, y}, {kInk, 0.8});
    const Vec2 at(bar.right + 4.0 + kGap, y);
    canvas.text(at, tick.text, {});
    right = std::max(right, canvas.textBox(at, tick.text, {}).right);
  }
  canvas.text({right + kGap, 0.5 * (bar.top + bar.bottom)}, label,
              {.across = Align::middle, .down = Align::start, .upwards = true});
}

}  // namespace palpate::figures
