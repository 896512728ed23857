// Drawing as programs did it in 2008, for comparison: the fixed pipeline of OpenGL 2.1, corner by corner between
// glBegin and glEnd, and the feedback buffer through which haptic libraries read the drawn triangles. The renderer of
// this folder does none of it (renderer.h).
//
// Based on: Segal and Akeley, "The OpenGL Graphics System", version 2.1, section 5.3 (feedback).
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "palpate/base/vec.h"
#include "palpate/view/image.h"

namespace palpate::view {

class ImmediateDrawing {
 public:
  /// Calls corner() three times for each triangle.
  using Draw = std::function<void()>;

  /// A picture of this size that shows the whole box from the side of +z. Makes an offscreen context of its own current
  /// on the calling thread, to which the object belongs. Throws Error when this machine's OpenGL has no such pipeline.
  ImmediateDrawing(const Eigen::AlignedBox3d& model, int width, int height);
  ~ImmediateDrawing();

  /// One corner of a triangle; only while drawing.
  static void corner(const Vec3& normal, const Vec3& position);

  /// Draws up to `triangles` triangles into memory instead of the picture. Returns the number of triangles; some may be
  /// missing or in pieces where they leave the box.
  std::size_t capture(std::size_t triangles, const Draw& draw);

  /// Draws the picture, lit and smooth, and waits for it.
  void paint(const Draw& draw);

  Image read() const;
  /// The renderer's name, "llvmpipe-22".
  const std::string& renderer() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate::view
