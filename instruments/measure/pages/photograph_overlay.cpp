// Layout first, because legends and findings are wrapped by measuring; then one drawing for every kind of sheet. Marks
// have a halo: skin, ink and shadow are behind them. Photographs are reduced to the pixels of their panel before they
// are put on the sheet.
#include "measure/pages/photograph_overlay.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "report/charts/canvas.h"
#include "report/charts/lettering.h"

namespace palpate::figures {

namespace {

constexpr double kMargin = 12.0;
constexpr double kBetweenPanels = 10.0;
constexpr double kPanelUnit = 400.0;  // marks and lines are given for a panel so wide
constexpr double kSample = 22.0;      // length of a line in a legend
constexpr TextStyle kWords{.size_px = 11.5, .down = Align::start};
constexpr TextStyle kVerdict{.size_px = 13.5, .bold = true, .down = Align::start};
constexpr double kRow = 16.0;
/// Pictures are faded this much towards white under arrows and ellipses.
constexpr double kFaded = 0.45;

Colour colourOf(const measure::OverlayColour& colour) {
  return {static_cast<double>(colour.red), static_cast<double>(colour.green), static_cast<double>(colour.blue),
          static_cast<double>(colour.opacity)};
}

std::vector<std::string> wrapped(const Canvas& canvas, const std::string& text, const TextStyle& style, double width) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::string longer = lines.empty() ? word : lines.back() + " " + word;
    const bool fits = !lines.empty() && canvas.textBox({0.0, 0.0}, longer, style).width() <= width;
    if (fits) {
      lines.back() = longer;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

/// From pixels of the picture to the sheet.
struct PanelFrame {
  Rect place;
  Vec2 origin_px = Vec2::Zero();
  double sheet_per_px = 1.0;

  Vec2 at(const Vec2& picture_px) const {
    return Vec2(place.left, place.top) + sheet_per_px * (picture_px - origin_px);
  }
  double unit() const { return place.width() / kPanelUnit; }
};

/// Visible part of the pictures' plane.
struct Extent {
  Vec2 corner_px = Vec2::Zero();
  Vec2 size_px = {400.0, 500.0};
};

/// The picture, or room around all that is marked.
Extent pageExtent(const OverlayPage& page) {
  const measure::Photograph* picture = page.before != nullptr ? page.before : page.after;
  // Pixels are counted from the centre of the first.
  if (picture != nullptr) return {{-0.5, -0.5}, {picture->width_px, picture->height_px}};
  Eigen::AlignedBox2d box;
  for (const measure::OverlayPanel& panel : page.overlay.panels) {
    for (const auto& mark : panel.marks) box.extend(mark.place_px);
    for (const auto& line : panel.lines) {
      for (const Vec2& place : line.places_px) box.extend(place);
    }
  }
  if (box.isEmpty()) return {};
  const Vec2 rim = Vec2::Constant(0.08 * std::max(1.0, box.sizes().maxCoeff()));
  Extent extent{box.min() - rim, box.sizes() + 2.0 * rim};
  // Neither a strip nor a pole, which would leave no room for letters.
  extent.size_px.y() = std::clamp(extent.size_px.y(), 0.5 * extent.size_px.x(), 2.0 * extent.size_px.x());
  return extent;
}

struct Layout {
  double height = 0.0;
  std::vector<PanelFrame> panels;
  double legend_top = 0.0;
  double verdict_top = 0.0;
  std::vector<std::string> verdict;
  std::vector<std::string> findings;
};

Layout computeLayout(const OverlayPage& page) {
  const Canvas measure = Canvas::png(1.0, 1.0, 1.0);
  const auto count = static_cast<double>(std::max<std::size_t>(1, page.overlay.panels.size()));
  const double width = (page.width_px - 2.0 * kMargin - (count - 1.0) * kBetweenPanels) / count;
  const Extent extent = pageExtent(page);
  const double sheet_per_px = width / extent.size_px.x();
  const double top = kMargin + kTitleSize + kGap;
  Layout layout;
  std::size_t most_entries = 0;
  for (const measure::OverlayPanel& panel : page.overlay.panels) {
    const double left = kMargin + static_cast<double>(layout.panels.size()) * (width + kBetweenPanels);
    const Rect place{left, top, left + width, top + sheet_per_px * extent.size_px.y()};
    layout.panels.push_back({place, extent.corner_px, sheet_per_px});
    most_entries = std::max(most_entries, panel.legend.size());
  }
  layout.legend_top = top + sheet_per_px * extent.size_px.y() + kGap;
  layout.verdict_top = layout.legend_top + static_cast<double>(most_entries) * kRow + kGap;
  const double room = page.width_px - 2.0 * kMargin;
  layout.verdict = wrapped(measure, page.overlay.verdict, kVerdict, room);
  for (const std::string& finding : page.overlay.findings) {
    if (finding == page.overlay.verdict) continue;
    const auto lines = wrapped(measure, finding, kWords, room);
    layout.findings.insert(layout.findings.end(), lines.begin(), lines.end());
  }
  layout.height = layout.verdict_top + static_cast<double>(layout.verdict.size()) * 1.4 * kVerdict.size_px +
                  static_cast<double>(layout.findings.size()) * kRow + kMargin;
  return layout;
}

void drawPhotograph(Canvas& canvas, const measure::Photograph& picture, const Rect& place, double fading,
                    double scale) {
  const auto wanted = static_cast<int>(std::lround(place.width() * scale));
  const measure::Photograph shown = measure::reducedTo(picture, wanted);
  std::vector<std::uint32_t> pixels;
  pixels.reserve(shown.rgb.size() / 3);
  const auto faded = [fading](std::uint8_t byte) {
    return static_cast<std::uint32_t>(std::lround(byte + fading * (255.0 - byte)));
  };
  for (std::size_t i = 0; i + 2 < shown.rgb.size(); i += 3) {
    pixels.push_back(0xff000000U | faded(shown.rgb[i]) << 16 | faded(shown.rgb[i + 1]) << 8 | faded(shown.rgb[i + 2]));
  }
  canvas.image(place, shown.width_px, shown.height_px, pixels);
}

void drawPicture(Canvas& canvas, const OverlayPage& page, const measure::OverlayPanel& panel, const Rect& place,
                 double scale) {
  const measure::Photograph* picture = panel.picture == measure::PanelPicture::after ? page.after : page.before;
  if (picture == nullptr) {
    canvas.rectangle(place, std::nullopt, Colour{0.80, 0.78, 0.76});
    return;
  }
  drawPhotograph(canvas, *picture, place, panel.picture == measure::PanelPicture::before_faded ? kFaded : 0.0, scale);
}

void drawLine(Canvas& canvas, const measure::OverlayLine& line, const PanelFrame& frame) {
  std::vector<Vec2> places;
  for (const Vec2& place : line.places_px) places.push_back(frame.at(place));
  const Colour colour = colourOf(line.colour);
  if (line.filled) canvas.path(places, true, std::nullopt, withAlpha(colour, 0.25 * colour.alpha));
  const double width = static_cast<double>(line.width) * frame.unit();
  if (width <= 0.0) return;
  // A thin line may lie on a thick one, and shall not cut it.
  const bool is_thin = line.width < 1.1f;
  if (!is_thin) canvas.path(places, line.closed, Pen{withAlpha(kPaper, 0.55), width + 1.4 * frame.unit()});
  canvas.path(places, line.closed, Pen{colour, width, line.dashed ? Stroke::dashed : Stroke::solid});
}

/// `radius` on the sheet.
void drawForm(Canvas& canvas, const Vec2& at, measure::MarkForm form, double radius, const Pen& pen) {
  const auto line = [&](double x, double y) { canvas.line(at - radius * Vec2(x, y), at + radius * Vec2(x, y), pen); };
  constexpr double kDiagonal = 0.72;
  switch (form) {
    case measure::MarkForm::ring:
      return canvas.disc(at, radius, pen, std::nullopt);
    case measure::MarkForm::dot:
      return canvas.disc(at, radius, std::nullopt, pen.colour);
    case measure::MarkForm::square:
      return canvas.rectangle({at.x() - radius, at.y() - radius, at.x() + radius, at.y() + radius}, pen, std::nullopt);
    case measure::MarkForm::star:
      line(1.0, 0.0);
      line(0.0, 1.0);
      [[fallthrough]];
    case measure::MarkForm::cross:
      line(kDiagonal, kDiagonal);
      line(kDiagonal, -kDiagonal);
  }
}

void drawMark(Canvas& canvas, const Vec2& at, measure::MarkForm form, const Colour& colour, double radius,
              double unit) {
  const bool is_light = colour.red + colour.green + colour.blue > 1.6;
  const Colour halo = is_light ? withAlpha(kInk, 0.8) : withAlpha(kPaper, 0.8);
  if (form != measure::MarkForm::dot) drawForm(canvas, at, form, radius, {halo, 3.0 * unit});
  drawForm(canvas, at, form, radius, {colour, 1.5 * unit});
}

void drawArrow(Canvas& canvas, const measure::OverlayArrow& arrow, const PanelFrame& frame) {
  const Vec2 from = frame.at(arrow.from_px);
  const Vec2 to = frame.at(arrow.to_px);
  const double length = (to - from).norm();
  const double head = std::min(5.0 * frame.unit(), 0.45 * length);
  if (!(length > 0.8 * frame.unit())) return;
  const Vec2 along = (to - from) / length;
  const Vec2 across(-along.y(), along.x());
  const Vec2 neck = to - head * along;
  const Colour colour = colourOf(arrow.colour);
  canvas.line(from, neck, {withAlpha(kPaper, 0.6), 2.6 * frame.unit()});
  canvas.line(from, neck, {colour, 1.3 * frame.unit()});
  const std::vector<Vec2> corners = {to, neck + 0.42 * head * across, neck - 0.42 * head * across};
  canvas.path(corners, true, std::nullopt, colour);
}

void drawScaleBar(Canvas& canvas, const measure::OverlayPanel& panel, const PanelFrame& frame) {
  const double length = panel.scale_bar_px * frame.sheet_per_px;
  if (!(length > 4.0 && length < 0.9 * frame.place.width())) return;
  const Vec2 from(frame.place.left + 14.0, frame.place.bottom - 14.0);
  canvas.line(from, from + Vec2(length, 0.0), {withAlpha(kPaper, 0.8), 7.0});
  canvas.line(from, from + Vec2(length, 0.0), {kInk, 3.5});
  TextStyle style = kWords;
  style.down = Align::end;
  style.halo = true;
  canvas.text(from + Vec2(0.0, -5.0), "50 mm", style);
}

void drawPanelLegend(Canvas& canvas, const measure::OverlayPanel& panel, const Vec2& corner) {
  for (std::size_t i = 0; i < panel.legend.size(); ++i) {
    const measure::LegendEntry& entry = panel.legend[i];
    const Vec2 at = corner + Vec2(0.0, (static_cast<double>(i) + 0.5) * kRow);
    const Colour colour = colourOf(entry.colour);
    if (entry.is_line) {
      canvas.line(at, at + Vec2(kSample, 0.0), {colour, 2.0, entry.dashed ? Stroke::dashed : Stroke::solid});
    } else {
      drawMark(canvas, at + Vec2(0.5 * kSample, 0.0), entry.form, colour, 4.5, 1.0);
    }
    TextStyle style = kWords;
    style.down = Align::middle;
    canvas.text(at + Vec2(kSample + kGap, 0.0), entry.words, style);
  }
}

void drawPanel(Canvas& canvas, const OverlayPage& page, const measure::OverlayPanel& panel, const PanelFrame& frame,
               double scale) {
  const Rect& place = frame.place;
  canvas.text({0.5 * (place.left + place.right), kMargin}, panel.title, kPanelTitle);
  canvas.beginClip(place);
  drawPicture(canvas, page, panel, place, scale);
  for (const auto& line : panel.lines) drawLine(canvas, line, frame);
  for (const auto& arrow : panel.arrows) drawArrow(canvas, arrow, frame);
  for (const auto& mark : panel.marks) {
    const double radius = static_cast<double>(mark.radius) * frame.unit();
    drawMark(canvas, frame.at(mark.place_px), mark.form, colourOf(mark.colour), radius, frame.unit());
  }
  drawScaleBar(canvas, panel, frame);
  canvas.endClip();
  canvas.rectangle(place, Pen{kGrid, 1.0}, std::nullopt);
}

void drawVerdict(Canvas& canvas, const OverlayPage& page, const Layout& layout) {
  TextStyle verdict = kVerdict;
  verdict.colour = page.overlay.accepted ? Colour{0.0, 0.42, 0.22} : Colour{0.72, 0.10, 0.05};
  double top = layout.verdict_top;
  for (const std::string& line : layout.verdict) {
    canvas.text({kMargin, top}, line, verdict);
    top += 1.4 * kVerdict.size_px;
  }
  for (const std::string& line : layout.findings) {
    canvas.text({kMargin, top}, line, kWords);
    top += kRow;
  }
}

void draw(Canvas& canvas, const OverlayPage& page, const Layout& layout, double scale) {
  for (std::size_t i = 0; i < page.overlay.panels.size(); ++i) {
    drawPanel(canvas, page, page.overlay.panels[i], layout.panels[i], scale);
    drawPanelLegend(canvas, page.overlay.panels[i], {layout.panels[i].place.left, layout.legend_top});
  }
  drawVerdict(canvas, page, layout);
}

}  // namespace

std::string overlayPng(const OverlayPage& page, double scale) {
  const Layout layout = computeLayout(page);
  Canvas canvas = Canvas::png(page.width_px, layout.height, scale);
  draw(canvas, page, layout, scale);
  return canvas.finish();
}

std::string overlaySvg(const OverlayPage& page) {
  const Layout layout = computeLayout(page);
  Canvas canvas = Canvas::svg(page.width_px, layout.height);
  draw(canvas, page, layout, 2.0);
  return canvas.finish();
}

std::vector<DrawnText> collectDrawnTexts(const OverlayPage& page) {
  const Layout layout = computeLayout(page);
  Canvas canvas = Canvas::png(page.width_px, layout.height, 1.0);
  draw(canvas, page, layout, 1.0);
  return canvas.texts();
}

void writeOverlay(const OverlayPage& page, const std::filesystem::path& file, double scale) {
  const std::string extension = file.extension().string();
  if (extension != ".png" && extension != ".svg")
    throw Error::inFile(file.string(), "an overlay's name must end in .png or .svg");
  writeFile(file, extension == ".svg" ? overlaySvg(page) : overlayPng(page, scale));
}

}  // namespace palpate::figures
