// Draws whole pictures of one world: the scene for one eye or two, labels over it, packed for the screen. The window
// and the offscreen pictures (picture.h) both draw through here, so they show the same pixels.
//
//   each eye: Renderer::draw ─► labels ─► the host's drawing over it (panels)      then: StereoComposer
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "palpate/view/offscreen.h"
#include "palpate/view/renderer.h"
#include "palpate/view/stereo.h"

namespace palpate::view {

/// The user's choices about a picture.
struct PictureSettings {
  Camera camera;
  Look look;
  StereoSettings stereo;
  LabelSettings labels;
};

/// The destination of a picture.
struct Canvas {
  GlId framebuffer = 0;  ///< 0 = the window's
  int width = 0;         ///< pixels
  int height = 0;
  double pixels_per_point = 1.0;  ///< size of letters and thin lines: the screen's content scale, the supersampling
  int supersampling = 1;          ///< pixels per pixel of the final picture, along each side
  bool quad_buffer = false;       ///< the framebuffer has a left and a right one
  /// Widths of the host's drawing at the left, top, right and below, points: labels stay out of it.
  std::array<float, 4> covered = {};
  /// The body's share of the picture's pixels along each side: stretched where it is below 1, under labels and panels
  /// at full resolution. With one eye only.
  double body_share = 1.0;
};

/// Results of a drawn picture for the user.
struct Painted {
  Eyes eyes;  ///< the middle one is the eye to pick with
  StereoMode mode = StereoMode::mono;
  std::vector<std::string> notes;  ///< a mode that is not available, parallax that tires the eyes
};

/// Needs a current context; belongs to its thread.
class Painter {
 public:
  explicit Painter(std::shared_ptr<const scene::World> world);
  ~Painter();

  /// Like Renderer::setWorld.
  void setWorld(std::shared_ptr<const scene::World> world);

  Renderer& renderer();

  /// Draws with the eye's target bound, `width` x `height` pixels; its page is `seen_width` x `seen_height` (a squeezed
  /// picture has fewer pixels). Called once for each eye.
  using DrawOver = std::function<void(const EyePicture& picture)>;

  /// `surface` must have gone to the renderer (Renderer::update); the labels read it here.
  Painted paint(const Frame& frame, const deform::DeformedSurface& surface, const PictureSettings& settings,
                const Canvas& canvas, const DrawOver& draw_over = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate::view
