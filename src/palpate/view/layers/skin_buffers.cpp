#include "palpate/view/layers/skin_buffers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "palpate/base/random.h"
#include "palpate/scene/skin_texture.h"
#include "palpate/scene/world.h"

namespace palpate::view {

namespace {

// What makes one place of the skin look different from the next, a vertex each: mottling, redness, thin skin over bone.
//
// Computed once at load in rest coordinates, so that it moves with the skin. The shader multiplies it with the colour
// of the whole skin; finer detail is the shader's own (skin_shader.h).

/// Red, green and blue: a factor on the colour of the skin, kTintUnit is 1. Fourth: curvature, 255 = a fingertip's.
using TintBytes = std::array<std::uint8_t, 4>;

inline constexpr double kTintUnit = 128.0;

/// One a vertex of the skin.
std::vector<TintBytes> skinTints(const scene::World& world);

namespace {

/// Mottling: sizes of the blotches (mm), and how much all of them change the colour.
constexpr double kBlotchMm[] = {60.0, 30.0, 15.0};
constexpr double kBlotchShare[] = {0.5, 0.3, 0.2};
constexpr double kMottling = 0.08;
/// Bone shows through skin that is not much thicker than this.
constexpr double kThinSkinMm = 9.0;
/// A sphere of this radius counts as fully curved: a fingertip.
constexpr double kFullCurvatureMm = 8.0;

double latticeValue(std::int64_t x, std::int64_t y, std::int64_t z) {
  const auto mixed = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15ull +
                     static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4full +
                     static_cast<std::uint64_t>(z) * 0x165667b19e3779f9ull;
  return Random(mixed).uniform(-1.0, 1.0);
}

/// Smooth noise in [-1, 1], one value a unit cell (Perlin's value noise).
double noiseAt(const Vec3& p) {
  const Vec3 cell = p.array().floor();
  const Vec3 t = p - cell;
  const Vec3 s = t.array().square() * (3.0 - 2.0 * t.array());
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1.0;
    std::array<std::int64_t, 3> at{};
    for (int axis = 0; axis < 3; ++axis) {
      const int high = (corner >> axis) & 1;
      weight *= high == 1 ? s[axis] : 1.0 - s[axis];
      at[axis] = static_cast<std::int64_t>(cell[axis]) + high;
    }
    sum += weight * latticeValue(at[0], at[1], at[2]);
  }
  return sum;
}

double mottlingAt(const Vec3& p) {
  double sum = 0.0;
  for (std::size_t i = 0; i < std::size(kBlotchMm); ++i) sum += kBlotchShare[i] * noiseAt(p / kBlotchMm[i]);
  // The sum of smooth noises seldom comes near its bounds: spread it.
  return std::clamp(1.8 * sum, -1.0, 1.0);
}

/// 0 far from bone, 1 right over it; and the wider red halo of skin that is rubbed: spine and shoulder blades.
struct BoneInfluence {
  double thin = 0.0;
  double red = 0.0;
};

BoneInfluence boneInfluence(const scene::Anatomy& anatomy, Index vertex) {
  if (anatomy.depth_mm.empty()) return {};
  const double depth = anatomy.depth_mm[vertex];
  const bool rubbed = anatomy.bones[anatomy.nearest_bone[vertex]].kind != body::BoneKind::rib;
  constexpr double kRedReachMm = 22.0;
  return {std::exp(-(depth * depth) / (kThinSkinMm * kThinSkinMm)), rubbed ? std::exp(-depth / kRedReachMm) : 0.0};
}

double curvatureAt(const deform::Skin& skin, Index vertex) {
  double largest = 0.0;
  const Vec3f place = skin.restPosition(vertex);
  const Vec3f normal = skin.restNormal(vertex);
  for (const Index other : skin.neighbours[vertex]) {
    const double length = (skin.restPosition(other) - place).norm();
    if (length > 0.0) largest = std::max<double>(largest, (skin.restNormal(other) - normal).norm() / length);
  }
  return std::min(1.0, largest * kFullCurvatureMm);
}

std::uint8_t byteOf(double value) { return static_cast<std::uint8_t>(std::clamp(value + 0.5, 0.0, 255.0)); }

TintBytes tintAt(const scene::World& world, Index vertex) {
  const Vec3& place = world.skin.positions[vertex];
  const BoneInfluence bone = boneInfluence(world.anatomy, vertex);
  // Blood varies more than pigment: the red channel least in value, so blotches read as warmer and cooler.
  const double blood = 0.6 * mottlingAt(place) + 1.1 * (bone.red - 0.35) * (bone.red > 0.0 ? 1.0 : 0.0);
  const double pigment = mottlingAt(place + Vec3(311.0, 173.0, 59.0));
  const double light = 1.0 + kMottling * 0.6 * pigment + 0.05 * bone.thin;
  const double red = light * (1.0 + 0.15 * kMottling * blood);
  const double green = light * (1.0 - kMottling * blood + 0.03 * bone.thin);
  const double blue = light * (1.0 - 0.8 * kMottling * blood + 0.05 * bone.thin);
  return {byteOf(kTintUnit * red), byteOf(kTintUnit * green), byteOf(kTintUnit * blue),
          byteOf(255.0 * curvatureAt(world.deformable, vertex))};
}

}  // namespace

std::vector<TintBytes> skinTints(const scene::World& world) {
  std::vector<TintBytes> tints(world.deformable.vertices);
  for (Index v = 0; v < world.deformable.vertices; ++v) tints[v] = tintAt(world, v);
  return tints;
}

}  // namespace

namespace {

/// Locations in kSkinAttributes.
constexpr GLuint kRest = 7;
constexpr GLuint kTint = 8;
constexpr GLuint kValue = 9;
constexpr GLuint kTexturePlace = 10;
constexpr int kDeformedArrays = 7;
/// Skins of so many triangles have a coarser set (skin_chunks.h), drawn where its cells are smaller than these pixels.
constexpr std::size_t kManyTriangles = 200000;
constexpr float kCoarseCellMm = 2.0f;
constexpr float kCoarseCellPixels = 3.0f;

std::span<const float> streamOf(const deform::DeformedSurface& surface, int array) {
  if (array < 3) return surface.position(array);
  return array < 6 ? surface.normal(array - 3) : surface.strain();
}

void pointAt(GLuint location, GLuint buffer, GLint size, GLenum type, std::size_t offset) {
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  glEnableVertexAttribArray(location);
  glVertexAttribPointer(location, size, type, type == GL_UNSIGNED_BYTE ? GL_TRUE : GL_FALSE, 0, bufferOffset(offset));
}

/// Into the array buffer that is bound.
void put(std::size_t offset, std::span<const float> values) {
  glBufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(values.size_bytes()),
                  values.data());
}

DrawnVertices drawnVerticesOf(const scene::World& world) {
  const deform::Skin& skin = world.deformable;
  if (!world.texture) return drawnVertices(skin.vertices, skin.triangles);
  return drawnVertices(skin.vertices, skin.triangles, world.texture->corners);
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

std::vector<Vec3f> restNormals(const deform::Skin& skin) {
  std::vector<Vec3f> normals(skin.vertices);
  for (Index v = 0; v < skin.vertices; ++v) normals[v] = skin.restNormal(v);
  return normals;
}

/// The outline stays as it is: it is what the eye sees first. At a seam the picture goes on elsewhere: no triangle may
/// reach across it.
std::vector<Stays> whatStays(const scene::World& world, const DrawnVertices& drawn) {
  const std::vector<std::uint8_t> border = drawn.withCopies<std::uint8_t>(world.surface.vertex_on_border);
  const std::vector<std::uint8_t> seam = drawn.nearSeam();
  std::vector<Stays> stays(drawn.count());
  for (Index v = 0; v < drawn.count(); ++v) {
    stays[v] = seam[v] != 0 ? Stays::cell : border[v] != 0 ? Stays::vertex : Stays::no;
  }
  return stays;
}

}  // namespace

SkinBuffers::SkinBuffers(const scene::World& world)
    : world_(&world),
      drawn_(drawnVerticesOf(world)),
      stiffness_(world.stiffness_n_per_mm.begin(), world.stiffness_n_per_mm.end()),
      box_(mesh::boundingBox(world.skin).cast<float>()) {
  const std::vector<Vec3f> places = drawn_.withCopies<Vec3f>(restPlaces(world.deformable));
  fillBuffer<Vec3f>(GL_ARRAY_BUFFER, rest_.get(), places);
  fillBuffer<TintBytes>(GL_ARRAY_BUFFER, tint_.get(), drawn_.withCopies<TintBytes>(skinTints(world)));
  fillBuffer<float>(GL_ARRAY_BUFFER, field_values_.get(), drawn_.withCopies<float>(stiffness_));
  fillBuffer<mesh::TexturePlace>(GL_ARRAY_BUFFER, texture_places_.get(), drawn_.places);
  glBindBuffer(GL_ARRAY_BUFFER, deformed_.get());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(offsetOf(kDeformedArrays)), nullptr, GL_STREAM_DRAW);
  whole_ = uploaded(places, drawn_.triangles);
  if (drawn_.triangles.size() >= kManyTriangles) makeCoarse(places);
}

void SkinBuffers::setMapsOf(const scene::World& world) {
  world_ = &world;
  stiffness_.assign(world.stiffness_n_per_mm.begin(), world.stiffness_n_per_mm.end());
  half_major_.clear();
  shown_field_ = Colouring::plain;
}

std::unique_ptr<SkinBuffers::Density> SkinBuffers::uploaded(std::span<const Vec3f> places,
                                                            std::span<const Triangle> triangles) const {
  auto density = std::make_unique<Density>(places, triangles);
  glBindVertexArray(density->vertex_array.get());
  fillBuffer<Triangle>(GL_ELEMENT_ARRAY_BUFFER, density->triangles.get(), triangles);
  for (int i = 0; i < kDeformedArrays; ++i) {
    pointAt(static_cast<GLuint>(i), deformed_.get(), 1, GL_FLOAT, offsetOf(i));
  }
  pointAt(kRest, rest_.get(), 3, GL_FLOAT, 0);
  pointAt(kTint, tint_.get(), 4, GL_UNSIGNED_BYTE, 0);
  pointAt(kValue, field_values_.get(), 1, GL_FLOAT, 0);
  if (!drawn_.places.empty()) pointAt(kTexturePlace, texture_places_.get(), 2, GL_FLOAT, 0);
  glBindVertexArray(0);
  return density;
}

void SkinBuffers::makeCoarse(const std::vector<Vec3f>& places) {
  const std::vector<Vec3f> normals = drawn_.withCopies<Vec3f>(restNormals(world_->deformable));
  const DrawnShape whole{places, normals, drawn_.triangles};
  coarse_ = uploaded(places, coarserTriangles(whole, whatStays(*world_, drawn_), kCoarseCellMm));
}

SkinBuffers::Density& SkinBuffers::densityFor(const Viewpoint& viewpoint) {
  const bool small = viewpoint.pixelsPerMm(box_) * kCoarseCellMm < kCoarseCellPixels;
  return coarse_ && small ? *coarse_ : *whole_;
}

const SplitRuns& SkinBuffers::bind(const Viewpoint& viewpoint, std::span<const Influence> influences) {
  Density& density = densityFor(viewpoint);
  glBindVertexArray(density.vertex_array.get());
  return density.chunks.split(viewpoint.clip, influences);
}

void SkinBuffers::upload(const deform::DeformedSurface& surface, deform::VertexRange range) {
  const deform::VertexRange copies = drawn_.copiesIn(range);
  for (int i = 0; i < kDeformedArrays; ++i) {
    const std::span<const float> values = streamOf(surface, i);
    put(offsetOf(i) + range.first * sizeof(float), values.subspan(range.first, range.end - range.first));
    if (copies.first != copies.end) uploadCopies(values, i, copies);
  }
}

void SkinBuffers::uploadCopies(std::span<const float> values, int array, deform::VertexRange copies) {
  copies_.clear();
  for (Index copy = copies.first; copy < copies.end; ++copy) copies_.push_back(values[drawn_.copied[copy]]);
  put(offsetOf(array) + (std::size_t{drawn_.of_skin} + copies.first) * sizeof(float), copies_);
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

void SkinBuffers::showField(Colouring colouring) {
  if (colouring == Colouring::strain || shown_field_ == colouring) return;  // strain comes with the deformation
  shown_field_ = colouring;
  if (colouring == Colouring::ellipses && half_major_.empty()) half_major_ = halfMajors(*world_);
  const std::vector<float>& values = colouring == Colouring::stiffness ? stiffness_ : half_major_;
  fillBuffer<float>(GL_ARRAY_BUFFER, field_values_.get(), drawn_.withCopies<float>(values));
}

void SkinBuffers::bindEdges() {
  glBindVertexArray(edge_array_.get());
  if (edge_indices_ != 0) return;
  const std::vector<Index> ends = edgesOf(world_->deformable);
  edge_indices_ = static_cast<Index>(ends.size());
  fillBuffer<Index>(GL_ELEMENT_ARRAY_BUFFER, edges_.get(), ends);
  for (int axis = 0; axis < 3; ++axis) {
    pointAt(static_cast<GLuint>(axis), deformed_.get(), 1, GL_FLOAT, offsetOf(axis));
  }
}

void SkinBuffers::drawEdges() const {
  glDrawElements(GL_LINES, static_cast<GLsizei>(edge_indices_), GL_UNSIGNED_INT, nullptr);
}

}  // namespace palpate::view
