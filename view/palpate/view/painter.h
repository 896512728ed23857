// Draws whole pictures of one world: the scene for one eye or two, labels over it, packed for the screen. The window
// and the offscreen pictures (picture.h) both draw through here, so they show the same pixels.
//
//   each eye: Renderer::draw ─► labels ─► what the host draws over it (panels)      then: StereoComposer
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

/// Everything the user can choose about a picture.
struct PictureSettings {
  Camera camera;
  Look look;
  StereoSettings stereo;
  LabelSettings labels;
};

/// Where a picture goes.
struct Canvas {
  GlId framebuffer = 0;  ///< 0 = the window's
  int width = 0;         ///< pixels
  int height = 0;
  double pixels_per_point = 1.0;  ///< size of letters and thin lines: the screen's content scale, the supersampling
  int supersampling = 1;          ///< pixels that one pixel of the final picture is made of, along each side
  bool quad_buffer = false;       ///< the framebuffer has a left and a right one
  /// Points at the left, top, right and below that the host draws over: the labels stay out of them.
  std::array<float, 4> covered = {};
  /// Pixels along each side that the body is drawn with, a share of the picture's: stretched where it is below 1, under
  /// labels and panels that have all. By one eye only.
  double body_share = 1.0;
};

/// What the user should know about the picture that was drawn.
struct Painted {
  Eyes eyes;  ///< the middle one is the eye to pick with
  StereoMode mode = StereoMode::mono;
  std::vector<std::string> notes;  ///< a mode that is not offered, parallax that tires the eyes
};

/// Needs a current context; belongs to its thread.
class Painter {
 public:
  explicit Painter(std::shared_ptr<const scene::World> world);
  ~Painter();

  /// As Renderer::setWorld.
  void setWorld(std::shared_ptr<const scene::World> world);

  Renderer& renderer();

  /// Draws with the eye's target bound, `width` x `height` pixels; the page it stands for is `seen_width` x
  /// `seen_height` (a squeezed picture has fewer pixels). Called once for each eye.
  using DrawOver = std::function<void(const EyePicture& picture)>;

  /// `surface` must have been given to the renderer (Renderer::update); the labels read it here.
  Painted paint(const Frame& frame, const deform::DeformedSurface& surface, const PictureSettings& settings,
                const Canvas& canvas, const DrawOver& draw_over = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate::view
