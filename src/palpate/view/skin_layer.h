// The skin on the graphics card: static arrays once, and of the deformation only what changed.
#pragma once

#include <span>

#include "palpate/deform/surface.h"
#include "palpate/scene/world.h"
#include "palpate/view/blanching.h"
#include "palpate/view/finger_pose.h"
#include "palpate/view/look.h"
#include "palpate/view/viewpoint.h"

namespace palpate::view {

/// What touches the skin's colour.
struct SkinTouch {
  std::span<const FingerPose> fingers;
  std::span<const PressMark> marks;
};

class SkinLayer {
 public:
  /// The world must outlive the layer.
  explicit SkinLayer(const scene::World& world);

  /// Uploads the ranges that the last apply changed; the number of vertices.
  Index update(const deform::DeformedSurface& surface);
  void updateAll(const deform::DeformedSurface& surface);

  /// The field of the colourings `stiffness` and `ellipses`, a vertex each.
  void setField(Colouring colouring, std::span<const float> values);

  /// Draws over what is there, depth-tested; transparent where the look says so.
  void draw(const Look& look, const Viewpoint& viewpoint, const SkinTouch& touch);

  /// Binds the skin's vertices with the edges of its triangles, for a program that draws lines; then drawEdges.
  void bindEdges();
  void drawEdges() const;

 private:
  void upload(const deform::DeformedSurface& surface, deform::VertexRange range);
  void showField(Colouring colouring);
  const Program& paint(const Look& look, const Viewpoint& viewpoint, const SkinTouch& touch);
  const Program& paintSkin(const Look& look, const Viewpoint& viewpoint, const SkinTouch& touch);
  const Program& paintField(const Look& look);
  void drawDepth(const Viewpoint& viewpoint) const;
  void drawTriangles() const;

  Program gouraud_, skin_, field_, depth_;
  GlVertexArray vertex_array_, edge_array_;
  GlBuffer deformed_;  // x.. y.. z.. nx.. ny.. nz.. strain..: as the deformation keeps them
  GlBuffer rest_, tint_, field_values_, triangles_, edges_;
  GlTexture colour_map_;
  const scene::World& world_;
  std::vector<float> stiffness_;
  std::vector<float> half_major_;  // made when first shown
  Colouring shown_field_ = Colouring::plain;
  Index vertices_ = 0;
  Index indices_ = 0;
  Index edge_indices_ = 0;  // made when first shown
  bool closed_ = false;
  Eigen::AlignedBox3f box_;  // at rest
};

}  // namespace palpate::view
