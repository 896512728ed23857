// The skin in a picture: its buffers, its programs and the user's picture on it.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "palpate/deform/surface.h"
#include "palpate/scene/world.h"
#include "palpate/view/layers/gl_objects.h"
#include "palpate/view/layers/skin_chunks.h"
#include "palpate/view/layers/skin_paint.h"
#include "palpate/view/layers/skin_picture.h"
#include "palpate/view/layers/viewpoint.h"
#include "palpate/view/look.h"

namespace palpate::view {

// One world's skin on the graphics card: static arrays once, later only the deformation's changes.

class SkinBuffers {
 public:
  /// The world must outlive the buffers.
  explicit SkinBuffers(const scene::World& world);

  /// Switches to a world with the same body: only its maps are new.
  void updateMaps(const scene::World& world);

  /// Uploads the ranges that the last apply changed; returns the number of vertices.
  Index update(const deform::DeformedSurface& surface);
  void updateAll(const deform::DeformedSurface& surface);

  /// The field of the colourings `stiffness` and `ellipses`, one value per vertex.
  void setField(Colouring colouring, std::span<const float> values);
  /// Whether there is a field to colour by: plain has none, and not every body has scalars.
  bool hasField(const Look& look) const;
  /// Makes the look's field visible to the programs; strain always is.
  void showField(const Look& look);
  /// Whether the body's file has a colour for each vertex.
  bool hasColours() const { return has_colours_; }

  /// Binds vertices and triangles as fine as this viewpoint needs them; returns those that may be visible. Valid until
  /// the next call.
  const SplitRuns& bind(const Viewpoint& viewpoint, std::span<const Influence> influences, bool cull = true);

  /// Binds the skin's vertices with the edges of its triangles, for a program that draws lines; then drawEdges.
  void bindEdges();
  void drawEdges() const;

  /// The share of the breath's lift per vertex (BreathField::share); empty for a body that does not breathe.
  std::vector<float> breathShares() const;

  /// The box at rest.
  const Eigen::AlignedBox3f& box() const { return box_; }

 private:
  /// A set of triangles over the drawn vertices.
  struct Density {
    SkinChunks chunks;
    GlVertexArray vertex_array;
    GlBuffer triangles;
    Density(std::span<const Vec3f> places, std::span<const Triangle> kept) : chunks(places, kept) {}
  };
  std::unique_ptr<Density> uploaded(std::span<const Vec3f> places, std::span<const Triangle> triangles) const;
  void uploadBreath();
  void makeCoarse(const std::vector<Vec3f>& places);
  Density& densityFor(const Viewpoint& viewpoint);
  /// Offset of an array of the deformation in its buffer, bytes.
  std::size_t arrayOffset(int array) const { return std::size_t{drawn_.count()} * sizeof(float) * array; }
  void upload(const deform::DeformedSurface& surface, deform::VertexRange range);
  void uploadCopies(std::span<const float> values, int array, deform::VertexRange copies);

  const scene::World* world_;
  DrawnVertices drawn_;
  std::unique_ptr<Density> whole_;
  std::unique_ptr<Density> coarse_;  // for a skin of very many triangles that is seen small
  GlVertexArray edge_array_;
  GlBuffer deformed_;  // x.. y.. z.. nx.. ny.. nz.. strain..: as the deformation keeps them, each with its copies
  GlBuffer rest_, rest_normals_, tint_, field_values_, texture_places_, colours_, breath_, edges_;
  bool has_colours_ = false;
  std::vector<float> stiffness_;
  std::vector<float> half_major_;  // made when first shown, empty before
  std::vector<float> copies_;      // values on their way
  Colouring shown_field_ = Colouring::plain;
  std::string shown_scalar_;  // for Colouring::scalar
  Index edge_indices_ = 0;    // made when first shown
  Eigen::AlignedBox3f box_;
};

class SkinLayer {
 public:
  /// Shows another world; programs stay. The world must outlive the layer or the next call. Throws Error for a texture
  /// that cannot be shown, and then still shows the world before.
  void setWorld(const scene::World& world);
  /// The same for a world with the same body.
  void updateMaps(const scene::World& world) { buffers_->updateMaps(world); }
  /// The buffers of the world that is shown.
  SkinBuffers& buffers() { return *buffers_; }

  /// Draws over the picture, depth-tested; transparent where the look says so.
  void draw(const Look& look, const Viewpoint& viewpoint, const SkinTouch& touch);

 private:
  SkinNeeds shaderNeeds(const Look& look, const Viewpoint& viewpoint) const;
  void drawColours(const Look& look, const Viewpoint& viewpoint, const SkinTouch& touch, const SplitRuns& runs);

  SkinPaint paint_;
  SkinPicture picture_;
  std::optional<SkinBuffers> buffers_;
  bool closed_ = false;
};

}  // namespace palpate::view
