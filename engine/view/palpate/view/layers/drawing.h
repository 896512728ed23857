// Text and flat shapes on top of a picture, in any framebuffer and without a window: labels, legends, curves.
//
//   begin ─► lines, shapes, text (collected) ─► end ─► present (once for each eye)
//
// A page is measured in points; its scale is the number of pixels per point, so that a picture and its supersampled
// twin are laid out alike. Uses Dear ImGui's draw lists and its OpenGL 3 renderer, in a context of its own: panels of
// the host are not disturbed.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "palpate/base/colour_map.h"
#include "palpate/base/vec.h"

namespace palpate::view {

/// sRGB, opacity from 0 to 1.
struct Ink {
  ColourBytes colour = {255, 255, 255};
  double opacity = 1.0;
};

enum class Align : std::uint8_t { left, centre, right };
enum class TextSize : std::uint8_t { small, normal, title };

/// A page in points; x to the right, y down, from the upper left corner.
class Drawing {
 public:
  /// Needs a current context, to whose thread it belongs; throws Error when the renderer of shapes cannot be made.
  Drawing();
  ~Drawing();

  /// Starts a page. A new scale (pixels per point) makes the letters again, which takes some 30 ms.
  void begin(const Vec2f& size, double scale);
  void end();
  /// Draws the page into the bound framebuffer, stretched to its `width` x `height` pixels.
  void present(int width, int height) const;
  /// The same for a page that is a part of a larger one: its upper left corner is at `corner` of `whole` points.
  void present(int width, int height, const Vec2f& corner, const Vec2f& whole) const;

  void line(const Vec2f& from, const Vec2f& to, const Ink& ink, float thickness = 1.0f);
  void curve(std::span<const Vec2f> points, const Ink& ink, float thickness = 1.0f);
  void box(const Vec2f& corner, const Vec2f& opposite, const Ink& ink, float rounding = 0.0f);
  void frame(const Vec2f& corner, const Vec2f& opposite, const Ink& ink, float rounding = 0.0f);
  void triangle(const Vec2f& a, const Vec2f& b, const Vec2f& c, const Ink& ink);
  /// A convex outline, filled; its points go round it either way.
  void convex(std::span<const Vec2f> points, const Ink& ink);
  void disc(const Vec2f& middle, float radius, const Ink& ink);
  void ring(const Vec2f& middle, float radius, const Ink& ink, float thickness = 1.0f);
  /// `place` is the upper left, upper middle or upper right of the line of text.
  void text(const Vec2f& place, std::string_view words, const Ink& ink, Align align = Align::left,
            TextSize size = TextSize::normal);
  Vec2f measure(std::string_view words, TextSize size = TextSize::normal) const;
  const Vec2f& size() const { return size_; }

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  Vec2f size_ = Vec2f::Zero();
};

/// The typeface of all pictures and panels, a TrueType file built into the program: no font file is needed where it
/// runs. DejaVu Sans (https://dejavu-fonts.github.io), free to embed under the Bitstream Vera licence; its changes are
/// in the public domain.
std::span<const unsigned char> embeddedFont();

/// Ranges of characters that the pictures use, as ImGui wants them: pairs of first and last, ended by 0.
const std::uint16_t* fontRanges();

}  // namespace palpate::view
