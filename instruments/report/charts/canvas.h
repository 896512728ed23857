// A sheet to draw on, in CSS pixels from the top left corner: the thin layer over cairo that all drawing goes through.
//
// The same calls draw a PNG or an SVG. Every text is remembered with its box, so that labels can avoid each other.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "report/charts/figure.h"

namespace palpate::figures {

struct Rect {
  double left = 0.0;
  double top = 0.0;
  double right = 0.0;
  double bottom = 0.0;

  double width() const { return right - left; }
  double height() const { return bottom - top; }
};

struct Pen {
  Colour colour = kInk;
  double width_px = 1.0;
  Stroke stroke = Stroke::solid;
};

/// The point of its box by which a text is placed.
enum class Align { start, middle, end };

struct TextStyle {
  double size_px = 12.0;
  bool bold = false;
  Colour colour = kInk;
  Align across = Align::start;  ///< left, centre or right of the text is at the place
  Align down = Align::middle;   ///< top, middle or bottom
  bool upwards = false;         ///< turned by 90 degrees to the left: axis labels
  bool halo = false;            ///< white around the letters: texts on lines and colours
};

class Canvas {
 public:
  static Canvas png(double width_px, double height_px, double scale);
  static Canvas svg(double width_px, double height_px);
  ~Canvas();
  Canvas(Canvas&&) noexcept;
  Canvas& operator=(Canvas&&) noexcept;

  void path(std::span<const Vec2> points, bool closed, const std::optional<Pen>& pen,
            const std::optional<Colour>& fill = std::nullopt);
  void line(const Vec2& from, const Vec2& to, const Pen& pen);
  void rectangle(const Rect& rect, const std::optional<Pen>& pen, const std::optional<Colour>& fill);
  void disc(const Vec2& centre, double radius, const std::optional<Pen>& pen, const std::optional<Colour>& fill);
  /// Pixels row by row from the top, premultiplied 0xAARRGGBB.
  void image(const Rect& place, int columns, int rows, const std::vector<std::uint32_t>& pixels);

  void text(const Vec2& at, const std::string& text, const TextStyle& style);
  /// The box that the text would fill.
  Rect textBox(const Vec2& at, const std::string& text, const TextStyle& style) const;
  const std::vector<DrawnText>& texts() const;

  /// Clips drawing between the two calls to the rectangle.
  void beginClip(const Rect& rect);
  void endClip();
  /// Drawing between the two calls becomes one picture even in an SVG: for surfaces of thousands of triangles.
  void beginPicture(const Rect& rect);
  void endPicture();

  /// The file's bytes; the canvas is used up.
  std::string finish();

 private:
  struct Impl;
  explicit Canvas(std::unique_ptr<Impl> sheet);
  std::unique_ptr<Impl> impl_;
};

/// A marker of a series or a place.
void drawMarker(Canvas& canvas, const Vec2& at, Marker marker, const Colour& colour, double size_px = 4.0);

/// Premultiplied 0xAARRGGBB.
std::uint32_t toPremultipliedArgb(const Colour& colour);

/// Finishing touches on the SVG that cairo writes, which draws letters as outlines and numbers its elements by a
/// counter of the process. Adds the drawn texts as the picture's description, so that it can be searched and read
/// aloud, and counts the elements from 1, so that equal drawings give equal files.
std::string tidiedSvg(const std::string& svg, const std::vector<DrawnText>& texts);

}  // namespace palpate::figures
