// Lines and patches over the skin: wide, with soft edges, thin and dashed where the skin hides them.
//
// Every line becomes a quad on the screen in the geometry shader, so that any vertex buffer can be drawn as lines: the
// overlays' own, and the edges of the skin straight from the deformed vertices. Costs no texture and no multisampling.
#pragma once

#include "palpate/view/layers/gl_objects.h"
#include "palpate/view/layers/viewpoint.h"
#include "palpate/view/lines.h"

namespace palpate::view {

/// Lines on the skin are drawn this share of their distance nearer to the eye: 1 mm at arm's length.
inline constexpr float kNearerShare = 0.0015f;

enum class PatchDepth : std::uint8_t {
  laid_on,       ///< hidden by things before them, hiding nothing
  seen_through,  ///< drawn over everything
  solid,         ///< as bodies: they hide each other and later draws
};

class LineLayer {
 public:
  LineLayer();
  /// Draw skin and bones first: it needs their depth.
  void draw(const Lines& lines, const Viewpoint& viewpoint, double pixels_per_point);
  void draw(const Patches& patches, const Viewpoint& viewpoint, PatchDepth depth = PatchDepth::laid_on);

  /// Draws the edges in the bound vertex array (positions at locations 0 to 2) that `draw` issues, in one colour,
  /// without the hidden ones.
  template <class Draw>
  void drawEdges(const Viewpoint& viewpoint, double width_px, Paint paint, const Draw& draw) {
    beginEdges(viewpoint, width_px, paint);
    draw();
    end();
  }

 private:
  /// A PaintedPoint on the graphics card.
  struct UploadedPoint {
    Vec3f place;
    Paint paint;
  };
  void upload(std::span<const PaintedPoint> points, const Viewpoint& viewpoint);
  void begin(const Program& program, const Viewpoint& viewpoint);
  void beginEdges(const Viewpoint& viewpoint, double width_px, Paint paint);
  static void end();

  Program lines_, edges_, patches_;
  GlVertexArray vertex_array_;
  GlBuffer points_;
  std::vector<UploadedPoint> uploaded_;  // for the current draw
};

}  // namespace palpate::view
