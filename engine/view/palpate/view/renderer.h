// The one renderer: a world, its deformed skin and the fingers on it become a picture in the current framebuffer.
//
//   World ─► Renderer (static buffers once)        DeformedSurface ─► update (changed ranges only)
//   Frame, Look, Frustum ─► draw ─► framebuffer ─► window │ image │ one eye of a stereo pair
//
// Needs a current OpenGL 3.3 context (offscreen.h, window.h) and belongs to the thread that has it. The cost of a frame
// on this side is in proportion to what changed: only the ranges that a deformation wrote are uploaded.
#pragma once

#include <memory>
#include <span>

#include "palpate/deform/surface.h"
#include "palpate/scene/world.h"
#include "palpate/view/camera.h"
#include "palpate/view/finger_pose.h"
#include "palpate/view/lines.h"
#include "palpate/view/look.h"

namespace palpate::hdb {
struct Partition;
}

namespace palpate::view {

/// The variable part of each picture.
struct Frame {
  std::span<const FingerMark> fingers;
  double time_s = 0.0;
  double lift_mm = 0.0;               ///< how far the breath has moved the body (World.breath)
  std::span<const Lines> marks = {};  ///< the caller's, drawn as overlays are (lines.h)
  double pixels_per_point = 1.0;      ///< widens lines: the screen's content scale, times the supersampling
};

class Renderer {
 public:
  /// Shows the skin at rest. Throws Error for a texture that cannot be shown, naming the scene file.
  explicit Renderer(std::shared_ptr<const scene::World> world);
  ~Renderer();

  /// Shows another world, at rest; programs and hands stay, and everything of a body that both share. Forgets setField
  /// and setPartition. Throws Error as the constructor does, and then still shows the world before.
  void setWorld(std::shared_ptr<const scene::World> world);

  /// Uploads the result of the last Deformer::apply. Returns the number of vertices uploaded.
  Index update(const deform::DeformedSurface& surface);
  /// Uploads everything: after a surface that this renderer has not followed from rest.
  void updateAll(const deform::DeformedSurface& surface);

  /// Replaces the world's own field of a colouring: one value per vertex.
  void setField(Colouring colouring, std::span<const float> values);
  /// The partition for overlays; null restores the world's own, which is built when first shown.
  void setPartition(std::shared_ptr<const hdb::Partition> partition, const Vec3& box_edges_mm);

  /// Draws into the bound framebuffer's viewport of `width` x `height` pixels: background, bones, skin, fingers,
  /// overlays. Text and legends are drawn by labels.h. `lit_as`: the picture whose light it has, if not its own.
  void draw(const Frame& frame, const Look& look, const Frustum& frustum, int width, int height,
            const Frustum* lit_as = nullptr);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate::view
