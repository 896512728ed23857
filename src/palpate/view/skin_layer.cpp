#include "palpate/view/skin_layer.h"

#include <algorithm>
#include <array>

#include "palpate/view/skin_tint.h"

namespace palpate::view {

namespace {

/// Locations in kSkinAttributes.
constexpr GLuint kStrain = 6;
constexpr GLuint kRest = 7;
constexpr GLuint kTint = 8;
constexpr GLuint kValue = 9;
constexpr int kDeformedArrays = 7;
/// Skins of so many triangles have a coarser set (skin_chunks.h), drawn where its cells are smaller than these pixels.
constexpr std::size_t kManyTriangles = 200000;
constexpr float kCoarseCellMm = 2.0f;
constexpr float kCoarseCellPixels = 3.0f;
/// Pores fade out below (skin_shader.h): where all of the body is farther away they are not computed at all.
constexpr float kFewestPixelsPerMm = 1.7f;

std::span<const float> streamOf(const deform::DeformedSurface& surface, int array) {
  if (array < 3) return surface.position(array);
  return array < 6 ? surface.normal(array - 3) : surface.strain();
}

void pointAt(GLuint location, GLuint buffer, GLint size, GLenum type, std::size_t offset) {
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  glEnableVertexAttribArray(location);
  glVertexAttribPointer(location, size, type, type == GL_UNSIGNED_BYTE ? GL_TRUE : GL_FALSE, 0,
                        reinterpret_cast<const void*>(offset));
}

void drawRuns(std::span<const IndexRun> runs) {
  std::vector<GLsizei> counts;
  std::vector<const void*> offsets;
  for (const IndexRun& run : runs) {
    counts.push_back(static_cast<GLsizei>(run.count));
    offsets.push_back(reinterpret_cast<const void*>(run.first * sizeof(Index)));
  }
  glMultiDrawElements(GL_TRIANGLES, counts.data(), GL_UNSIGNED_INT, offsets.data(), static_cast<GLsizei>(runs.size()));
}

/// Depth alone, so that afterwards only the nearest skin of each pixel is blended: exact, whatever the order.
void drawDepth(const SplitRuns& runs) {
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  drawRuns(runs.touched);
  drawRuns(runs.plain);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

std::vector<float> halfMajors(const scene::World& world) {
  std::vector<float> values;
  values.reserve(world.skin.positions.size());
  for (const Vec3& p : world.skin.positions) {
    values.push_back(static_cast<float>(world.ellipses.at(p.x(), p.y()).half_major_mm));
  }
  return values;
}

/// Both ends of each edge once.
std::vector<Index> edgesOf(const deform::Skin& skin) {
  std::vector<Index> ends;
  for (Index v = 0; v < skin.vertices; ++v) {
    for (const Index other : skin.neighbours[v]) {
      if (other > v) ends.insert(ends.end(), {v, other});
    }
  }
  return ends;
}

std::vector<Vec3f> restPlaces(const deform::Skin& skin) {
  std::vector<Vec3f> places(skin.vertices);
  for (Index v = 0; v < skin.vertices; ++v) places[v] = skin.restPosition(v);
  return places;
}

}  // namespace

SkinLayer::SkinLayer(const scene::World& world)
    : world_(world),
      stiffness_(world.stiffness_n_per_mm.begin(), world.stiffness_n_per_mm.end()),
      vertices_(world.deformable.vertices),
      closed_(world.closed),
      box_(mesh::boundingBox(world.skin).cast<float>()) {
  const std::size_t array_bytes = std::size_t{vertices_} * sizeof(float);
  fillBuffer<Vec3f>(GL_ARRAY_BUFFER, rest_.get(), restPlaces(world.deformable));
  fillBuffer<TintBytes>(GL_ARRAY_BUFFER, tint_.get(), skinTints(world));
  fillBuffer<float>(GL_ARRAY_BUFFER, field_values_.get(), stiffness_);
  glBindBuffer(GL_ARRAY_BUFFER, deformed_.get());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(kDeformedArrays * array_bytes), nullptr, GL_STREAM_DRAW);
  whole_ = std::make_unique<Density>(world.deformable, world.deformable.triangles);
  upload(*whole_, world.deformable.triangles);
  if (world.deformable.triangles.size() < kManyTriangles) return;
  // The outline stays as it is: it is what the eye sees first.
  const std::vector<Triangle> fewer = coarserTriangles(world.deformable, world.surface.vertex_on_border, kCoarseCellMm);
  coarse_ = std::make_unique<Density>(world.deformable, fewer);
  upload(*coarse_, fewer);
}

void SkinLayer::upload(Density& density, std::span<const Triangle> triangles) const {
  const std::size_t array_bytes = std::size_t{vertices_} * sizeof(float);
  glBindVertexArray(density.vertex_array.get());
  fillBuffer<Triangle>(GL_ELEMENT_ARRAY_BUFFER, density.triangles.get(), triangles);
  for (GLuint i = 0; i < kDeformedArrays; ++i) pointAt(i, deformed_.get(), 1, GL_FLOAT, i * array_bytes);
  pointAt(kRest, rest_.get(), 3, GL_FLOAT, 0);
  pointAt(kTint, tint_.get(), 4, GL_UNSIGNED_BYTE, 0);
  pointAt(kValue, field_values_.get(), 1, GL_FLOAT, 0);
  glBindVertexArray(0);
}

SkinLayer::Density& SkinLayer::densityFor(const Viewpoint& viewpoint) {
  const bool small = viewpoint.pixelsPerMm(box_) * kCoarseCellMm < kCoarseCellPixels;
  return coarse_ && small ? *coarse_ : *whole_;
}

void SkinLayer::upload(const deform::DeformedSurface& surface, deform::VertexRange range) {
  const std::size_t bytes = (range.end - range.first) * sizeof(float);
  for (int i = 0; i < kDeformedArrays; ++i) {
    const std::size_t first = std::size_t{vertices_} * i + range.first;
    glBufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(first * sizeof(float)), static_cast<GLsizeiptr>(bytes),
                    streamOf(surface, i).data() + range.first);
  }
}

Index SkinLayer::update(const deform::DeformedSurface& surface) {
  glBindBuffer(GL_ARRAY_BUFFER, deformed_.get());
  Index uploaded = 0;
  for (const deform::VertexRange& range : surface.changed()) {
    upload(surface, range);
    uploaded += range.end - range.first;
  }
  return uploaded;
}

void SkinLayer::updateAll(const deform::DeformedSurface& surface) {
  glBindBuffer(GL_ARRAY_BUFFER, deformed_.get());
  upload(surface, {0, vertices_});
}

void SkinLayer::setField(Colouring colouring, std::span<const float> values) {
  (colouring == Colouring::stiffness ? stiffness_ : half_major_).assign(values.begin(), values.end());
  if (shown_field_ == colouring) shown_field_ = Colouring::plain;
}

/// Uploads a field when another one is shown.
void SkinLayer::showField(Colouring colouring) {
  if (colouring == Colouring::strain || shown_field_ == colouring) return;  // strain comes with the deformation
  shown_field_ = colouring;
  if (colouring == Colouring::ellipses && half_major_.empty()) half_major_ = halfMajors(world_);
  fillBuffer<float>(GL_ARRAY_BUFFER, field_values_.get(), colouring == Colouring::stiffness ? stiffness_ : half_major_);
}

void SkinLayer::drawColours(const Look& look, const Viewpoint& viewpoint, const SkinTouch& touch,
                            const SplitRuns& runs) {
  if (look.colouring != Colouring::plain) {
    showField(look.colouring);
    paint_.useField(look, viewpoint);
  } else if (look.shading == Shading::gouraud) {
    paint_.useGouraud(look, viewpoint);
  } else {
    const bool pores = look.detail && viewpoint.pixelsPerMm(box_) > kFewestPixelsPerMm;
    if (!runs.touched.empty()) paint_.useTouchedSkin(look, viewpoint, pores, touch);
    drawRuns(runs.touched);
    paint_.useSkin(look, viewpoint, pores);
  }
  drawRuns(runs.plain);
}

void SkinLayer::draw(const Look& look, const Viewpoint& viewpoint, const SkinTouch& touch) {
  if (!(look.skin_opacity > 0.0)) return;
  const bool transparent = look.skin_opacity < 1.0;
  Density& density = densityFor(viewpoint);
  glBindVertexArray(density.vertex_array.get());
  glEnable(GL_DEPTH_TEST);
  // A closed skin hides its inside; an open sheet may be looked at from within.
  (closed_ ? glEnable : glDisable)(GL_CULL_FACE);
  const bool lit = look.colouring == Colouring::plain && look.shading == Shading::skin;
  const auto influences = lit ? influencesOf(touch, viewpoint.lights) : std::vector<Influence>();
  const SplitRuns& runs = density.chunks.split(viewpoint.clip, influences);
  if (transparent) {
    paint_.useDepth(viewpoint);
    drawDepth(runs);
  }
  glDepthFunc(transparent ? GL_EQUAL : GL_LESS);
  (transparent ? glEnable : glDisable)(GL_BLEND);
  blendOver();
  drawColours(look, viewpoint, touch, runs);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glDepthFunc(GL_LESS);
}

void SkinLayer::bindEdges() {
  glBindVertexArray(edge_array_.get());
  if (edge_indices_ != 0) return;
  const std::vector<Index> ends = edgesOf(world_.deformable);
  edge_indices_ = static_cast<Index>(ends.size());
  fillBuffer<Index>(GL_ELEMENT_ARRAY_BUFFER, edges_.get(), ends);
  for (GLuint axis = 0; axis < 3; ++axis) {
    pointAt(axis, deformed_.get(), 1, GL_FLOAT, axis * std::size_t{vertices_} * sizeof(float));
  }
}

void SkinLayer::drawEdges() const {
  glDrawElements(GL_LINES, static_cast<GLsizei>(edge_indices_), GL_UNSIGNED_INT, nullptr);
}

}  // namespace palpate::view
