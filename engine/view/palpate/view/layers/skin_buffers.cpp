// World and DeformedSurface -> vertex buffers. Static arrays are filled once; later uploads are the ranges that the
// last apply wrote, each followed by its copies on seams of the texture.
#include "palpate/view/layers/skin_layer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "palpate/scene/skin_channels.h"
#include "palpate/scene/skin_texture.h"
#include "palpate/scene/world.h"
#include "palpate/view/layers/skin_tint.h"

namespace palpate::view {

namespace {

/// The arrays that follow the deformation have the first locations in kSkinAttributes, these the next.
constexpr int kDeformedArrays = 7;
enum Location : GLuint { kRest = kDeformedArrays, kTint, kValue, kTexturePlace, kColour, kRestNormal, kBreath };
/// Larger skins have a coarser set (skin_chunks.h), drawn where its cells are smaller than these pixels.
constexpr std::size_t kManyTriangles = 200000;
constexpr float kCoarseCellMm = 2.0f;
constexpr float kCoarseCellPixels = 3.0f;

std::span<const float> surfaceArray(const deform::DeformedSurface& surface, int array) {
  if (array < 3) return surface.position(array);
  return array < 6 ? surface.normal(array - 3) : surface.strain();
}

void pointAt(GLuint location, GLuint buffer, GLint size, GLenum type, std::size_t offset, std::size_t stride = 0) {
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  attributeAt(location, size, type, stride, offset);
}

/// Writes into the bound array buffer.
void put(std::size_t offset, std::span<const float> values) {
  glBufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(values.size_bytes()),
                  values.data());
}

DrawnVertices makeDrawnVertices(const scene::World& world) {
  const deform::Skin& skin = *world.deformable;
  if (!world.body->texture) return drawnVertices(skin.vertices, skin.triangles);
  return drawnVertices(skin.vertices, skin.triangles, world.body->texture->corners);
}

std::vector<float> halfMajors(const scene::World& world) {
  std::vector<float> values;
  values.reserve(world.body->skin.positions.size());
  for (const Vec3& p : world.body->skin.positions) {
    values.push_back(static_cast<float>(world.ellipses.at(p.x(), p.y()).half_major_mm));
  }
  return values;
}

/// Padded to four bytes, as graphics cards prefer.
std::vector<std::array<std::uint8_t, 4>> paddedColours(const scene::SkinChannels* channels) {
  std::vector<std::array<std::uint8_t, 4>> padded;
  if (channels == nullptr) return padded;
  padded.reserve(channels->colours.size());
  for (const auto& [red, green, blue] : channels->colours) padded.push_back({red, green, blue, 255});
  return padded;
}

/// Both ends of each edge once.
std::vector<Index> listEdgeEnds(const deform::Skin& skin) {
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

std::vector<Vec3f> restNormals(const deform::Skin& skin) {
  std::vector<Vec3f> normals(skin.vertices);
  for (Index v = 0; v < skin.vertices; ++v) normals[v] = skin.restNormal(v);
  return normals;
}

/// Shares of 32767: finer than an eye sees a normal turn, half the size of floats.
using PackedNormal = std::array<std::int16_t, 4>;

std::vector<PackedNormal> packed(const std::vector<Vec3f>& normals) {
  const auto share = [](float value) {
    return static_cast<std::int16_t>(std::lround(32767.0f * std::clamp(value, -1.0f, 1.0f)));
  };
  std::vector<PackedNormal> shorts;
  shorts.reserve(normals.size());
  for (const Vec3f& n : normals) shorts.push_back({share(n.x()), share(n.y()), share(n.z()), 0});
  return shorts;
}

/// The outline stays: the eye sees it first. At a seam the picture continues elsewhere: no triangle may reach across
/// it.
std::vector<Required> requiredVertices(const scene::World& world, const DrawnVertices& drawn) {
  const std::vector<std::uint8_t> border = drawn.withCopies<std::uint8_t>(world.surface.geometry->vertex_on_border);
  const std::vector<std::uint8_t> seam = drawn.nearSeam();
  std::vector<Required> stays(drawn.count());
  for (Index v = 0; v < drawn.count(); ++v) {
    stays[v] = seam[v] != 0 ? Required::cell : border[v] != 0 ? Required::vertex : Required::no;
  }
  return stays;
}

}  // namespace

SkinBuffers::SkinBuffers(const scene::World& world)
    : world_(&world),
      drawn_(makeDrawnVertices(world)),
      stiffness_(world.surface.stiffness_n_per_mm->begin(), world.surface.stiffness_n_per_mm->end()),
      box_(mesh::boundingBox(world.body->skin).translated(-world.deformable->origin).cast<float>()) {
  const std::vector<Vec3f> places = drawn_.withCopies<Vec3f>(restPlaces(*world.deformable));
  fillBuffer<Vec3f>(GL_ARRAY_BUFFER, rest_.get(), places);
  fillBuffer<PackedNormal>(GL_ARRAY_BUFFER, rest_normals_.get(),
                           drawn_.withCopies<PackedNormal>(packed(restNormals(*world.deformable))));
  fillBuffer<TintBytes>(GL_ARRAY_BUFFER, tint_.get(), drawn_.withCopies<TintBytes>(skinTints(world)));
  fillBuffer<float>(GL_ARRAY_BUFFER, field_values_.get(), drawn_.withCopies<float>(stiffness_));
  fillBuffer<mesh::TexturePlace>(GL_ARRAY_BUFFER, texture_places_.get(), drawn_.places);
  if (const auto colours = paddedColours(world.body->channels.get()); !colours.empty()) {
    has_colours_ = true;
    fillBuffer<std::array<std::uint8_t, 4>>(GL_ARRAY_BUFFER, colours_.get(),
                                            drawn_.withCopies<std::array<std::uint8_t, 4>>(colours));
  }
  uploadBreath();
  glBindBuffer(GL_ARRAY_BUFFER, deformed_.get());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(arrayOffset(kDeformedArrays)), nullptr, GL_STREAM_DRAW);
  whole_ = uploaded(places, drawn_.triangles);
  if (drawn_.triangles.size() >= kManyTriangles) makeCoarse(places);
}

void SkinBuffers::updateMaps(const scene::World& world) {
  world_ = &world;
  stiffness_.assign(world.surface.stiffness_n_per_mm->begin(), world.surface.stiffness_n_per_mm->end());
  half_major_.clear();
  shown_field_ = Colouring::plain;
  uploadBreath();
}

std::vector<float> SkinBuffers::breathShares() const {
  std::vector<float> shares;
  if (!world_->breath) return shares;
  shares.reserve(world_->body->skin.positions.size());
  for (const Vec3& p : world_->body->skin.positions) shares.push_back(static_cast<float>(world_->breath->share(p)));
  return shares;
}

void SkinBuffers::uploadBreath() {
  std::vector<float> shares = breathShares();
  shares.resize(world_->body->skin.positions.size(), 0.0f);
  fillBuffer<float>(GL_ARRAY_BUFFER, breath_.get(), drawn_.withCopies<float>(shares));
}

std::unique_ptr<SkinBuffers::Density> SkinBuffers::uploaded(std::span<const Vec3f> places,
                                                            std::span<const Triangle> triangles) const {
  auto density = std::make_unique<Density>(places, triangles);
  glBindVertexArray(density->vertex_array.get());
  fillBuffer<Triangle>(GL_ELEMENT_ARRAY_BUFFER, density->triangles.get(), triangles);
  for (int i = 0; i < kDeformedArrays; ++i) {
    pointAt(static_cast<GLuint>(i), deformed_.get(), 1, GL_FLOAT, arrayOffset(i));
  }
  pointAt(kRest, rest_.get(), 3, GL_FLOAT, 0);
  pointAt(kTint, tint_.get(), 4, GL_UNSIGNED_BYTE, 0);
  pointAt(kRestNormal, rest_normals_.get(), 3, GL_SHORT, 0, sizeof(PackedNormal));
  pointAt(kValue, field_values_.get(), 1, GL_FLOAT, 0);
  pointAt(kBreath, breath_.get(), 1, GL_FLOAT, 0);
  if (!drawn_.places.empty()) pointAt(kTexturePlace, texture_places_.get(), 2, GL_FLOAT, 0);
  if (has_colours_) pointAt(kColour, colours_.get(), 4, GL_UNSIGNED_BYTE, 0);
  glBindVertexArray(0);
  return density;
}

void SkinBuffers::makeCoarse(const std::vector<Vec3f>& places) {
  const std::vector<Vec3f> normals = drawn_.withCopies<Vec3f>(restNormals(*world_->deformable));
  const DrawnShape whole{places, normals, drawn_.triangles};
  coarse_ = uploaded(places, coarserTriangles(whole, requiredVertices(*world_, drawn_), kCoarseCellMm));
}

SkinBuffers::Density& SkinBuffers::densityFor(const Viewpoint& viewpoint) {
  const bool small = viewpoint.pixelsPerMm(box_) * kCoarseCellMm < kCoarseCellPixels;
  return coarse_ && small ? *coarse_ : *whole_;
}

const SplitRuns& SkinBuffers::bind(const Viewpoint& viewpoint, std::span<const Influence> influences, bool cull) {
  Density& density = densityFor(viewpoint);
  glBindVertexArray(density.vertex_array.get());
  return density.chunks.split(viewpoint.clip, influences, cull);
}

void SkinBuffers::upload(const deform::DeformedSurface& surface, deform::VertexRange range) {
  const deform::VertexRange copies = drawn_.copiesIn(range);
  for (int i = 0; i < kDeformedArrays; ++i) {
    const std::span<const float> values = surfaceArray(surface, i);
    put(arrayOffset(i) + range.first * sizeof(float), values.subspan(range.first, range.end - range.first));
    if (copies.first != copies.end) uploadCopies(values, i, copies);
  }
}

void SkinBuffers::uploadCopies(std::span<const float> values, int array, deform::VertexRange copies) {
  copies_.clear();
  for (Index copy = copies.first; copy < copies.end; ++copy) copies_.push_back(values[drawn_.copied[copy]]);
  put(arrayOffset(array) + (std::size_t{drawn_.of_skin} + copies.first) * sizeof(float), copies_);
}

Index SkinBuffers::update(const deform::DeformedSurface& surface) {
  glBindBuffer(GL_ARRAY_BUFFER, deformed_.get());
  Index uploaded = 0;
  for (const deform::VertexRange& range : surface.changed()) {
    upload(surface, range);
    uploaded += range.end - range.first;
  }
  return uploaded;
}

void SkinBuffers::updateAll(const deform::DeformedSurface& surface) {
  glBindBuffer(GL_ARRAY_BUFFER, deformed_.get());
  upload(surface, {0, drawn_.of_skin});
}

void SkinBuffers::setField(Colouring colouring, std::span<const float> values) {
  (colouring == Colouring::stiffness ? stiffness_ : half_major_).assign(values.begin(), values.end());
  if (shown_field_ == colouring) shown_field_ = Colouring::plain;
}

bool SkinBuffers::hasField(const Look& look) const {
  if (look.colouring == Colouring::scalar)
    return scene::scalarNamed(world_->body->channels.get(), look.scalar) != nullptr;
  return look.colouring != Colouring::plain;
}

void SkinBuffers::showField(const Look& look) {
  const Colouring colouring = look.colouring;
  if (colouring == Colouring::strain) return;  // it comes with the deformation
  const bool other_scalar = colouring == Colouring::scalar && shown_scalar_ != look.scalar;
  if (shown_field_ == colouring && !other_scalar) return;
  shown_field_ = colouring;
  shown_scalar_ = look.scalar;
  if (colouring == Colouring::scalar) {
    const std::vector<float>& given = scene::scalarNamed(world_->body->channels.get(), look.scalar)->values;
    return fillBuffer<float>(GL_ARRAY_BUFFER, field_values_.get(), drawn_.withCopies<float>(given));
  }
  if (colouring == Colouring::ellipses && half_major_.empty()) half_major_ = halfMajors(*world_);
  const std::vector<float>& values = colouring == Colouring::stiffness ? stiffness_ : half_major_;
  fillBuffer<float>(GL_ARRAY_BUFFER, field_values_.get(), drawn_.withCopies<float>(values));
}

void SkinBuffers::bindEdges() {
  glBindVertexArray(edge_array_.get());
  if (edge_indices_ != 0) return;
  const std::vector<Index> ends = listEdgeEnds(*world_->deformable);
  edge_indices_ = static_cast<Index>(ends.size());
  fillBuffer<Index>(GL_ELEMENT_ARRAY_BUFFER, edges_.get(), ends);
  for (int axis = 0; axis < 3; ++axis) {
    pointAt(static_cast<GLuint>(axis), deformed_.get(), 1, GL_FLOAT, arrayOffset(axis));
  }
  pointAt(kBreath, breath_.get(), 1, GL_FLOAT, 0);
}

void SkinBuffers::drawEdges() const {
  glDrawElements(GL_LINES, static_cast<GLsizei>(edge_indices_), GL_UNSIGNED_INT, nullptr);
}

}  // namespace palpate::view
