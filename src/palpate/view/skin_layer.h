// The skin on the graphics card: static arrays once, and of the deformation only what changed.
#pragma once

#include <memory>
#include <span>

#include "palpate/deform/surface.h"
#include "palpate/scene/world.h"
#include "palpate/view/skin_chunks.h"
#include "palpate/view/skin_paint.h"

namespace palpate::view {

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
  void drawColours(const Look& look, const Viewpoint& viewpoint, const SkinTouch& touch, const SplitRuns& runs);

  SkinPaint paint_;
  /// A set of triangles over the skin's vertices.
  struct Density {
    SkinChunks chunks;
    GlVertexArray vertex_array;
    GlBuffer triangles;
    Density(const deform::Skin& skin, std::span<const Triangle> kept) : chunks(skin, kept) {}
  };
  void upload(Density& density, std::span<const Triangle> triangles) const;
  Density& densityFor(const Viewpoint& viewpoint);

  std::unique_ptr<Density> whole_;
  std::unique_ptr<Density> coarse_;  // for a skin of very many triangles that is seen small
  GlVertexArray edge_array_;
  GlBuffer deformed_;  // x.. y.. z.. nx.. ny.. nz.. strain..: as the deformation keeps them
  GlBuffer rest_, tint_, field_values_, edges_;
  const scene::World& world_;
  std::vector<float> stiffness_;
  std::vector<float> half_major_;  // made when first shown
  Colouring shown_field_ = Colouring::plain;
  Index vertices_ = 0;
  Index edge_indices_ = 0;  // made when first shown
  bool closed_ = false;
  Eigen::AlignedBox3f box_;  // at rest
};

}  // namespace palpate::view
