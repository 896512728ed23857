// The fingers as balls.
#pragma once

#include <span>

#include "palpate/view/finger_pose.h"
#include "palpate/view/viewpoint.h"

namespace palpate::view {

class FingerLayer {
 public:
  FingerLayer();
  void drawBalls(std::span<const FingerPose> fingers, const Viewpoint& viewpoint) const;

 private:
  Program program_;
  GlVertexArray ball_array_;
  GlBuffer ball_, ball_triangles_;
  Index ball_indices_ = 0;
};

}  // namespace palpate::view
