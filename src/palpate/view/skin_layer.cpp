#include "palpate/view/skin_layer.h"

#include <algorithm>
#include <array>

#include "palpate/view/shared_shader.h"
#include "palpate/view/skin_shader.h"
#include "palpate/view/skin_tint.h"

namespace palpate::view {

namespace {

/// Locations in kSkinAttributes.
constexpr GLuint kStrain = 6;
constexpr GLuint kRest = 7;
constexpr GLuint kTint = 8;
constexpr GLuint kValue = 9;
constexpr int kDeformedArrays = 7;
constexpr int kMapTexels = 1024;
/// Pores fade out below (skin_shader.h): where all of the body is farther away they are not computed at all.
constexpr float kFewestPixelsPerMm = 1.7f;
constexpr std::size_t kMostBalls = 4;  // as in the shader

std::string vertexSource(std::string_view main) {
  return std::string(kSkinAttributes).append(kSkinOpacity).append(main);
}
std::string fragmentSource(std::string_view main) { return std::string(kSkinOpacity).append(main); }

Program skinProgram(std::string_view name, std::string_view vertex, std::string_view fragment) {
  return {name, kSharedShader, vertexSource(vertex), fragmentSource(fragment)};
}

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

std::vector<float> halfMajors(const scene::World& world) {
  std::vector<float> values;
  values.reserve(world.skin.positions.size());
  for (const Vec3& p : world.skin.positions) {
    values.push_back(static_cast<float>(world.ellipses.at(p.x(), p.y()).half_major_mm));
  }
  return values;
}

void uploadColourMap(GLuint texture, ColourMap map) {
  std::vector<ColourBytes> texels(kMapTexels);
  for (int i = 0; i < kMapTexels; ++i) texels[i] = bytesOf(colourOf(map, static_cast<double>(i) / (kMapTexels - 1)));
  glBindTexture(GL_TEXTURE_2D, texture);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, kMapTexels, 1, 0, GL_RGB, GL_UNSIGNED_BYTE, texels.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

void setMarks(const Program& program, std::span<const PressMark> marks) {
  std::array<Eigen::Vector4f, kMostMarks> places;
  std::array<float, kMostMarks> strengths{};
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const Vec3f& place = marks[i].place;
    places[i] = {place.x(), place.y(), place.z(), marks[i].radius_mm};
    strengths[i] = marks[i].strength;
  }
  program.set("mark_count", static_cast<int>(marks.size()));
  program.set("mark", std::span<const Eigen::Vector4f>(places).first(marks.size()));
  program.set("mark_strength", std::span<const float>(strengths).first(marks.size()));
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
    : gouraud_(skinProgram("gouraud", kGouraudVertex, kGouraudFragment)),
      skin_(skinProgram("skin", kSkinVertex, kSkinFragment)),
      field_(skinProgram("field", kFieldVertex, kFieldFragment)),
      depth_(skinProgram("depth", kDepthVertex, kDepthFragment)),
      world_(world),
      stiffness_(world.stiffness_n_per_mm.begin(), world.stiffness_n_per_mm.end()),
      vertices_(world.deformable.vertices),
      indices_(static_cast<Index>(3 * world.deformable.triangles.size())),
      closed_(world.closed),
      box_(mesh::boundingBox(world.skin).cast<float>()) {
  const std::size_t array_bytes = std::size_t{vertices_} * sizeof(float);
  glBindVertexArray(vertex_array_.get());
  fillBuffer<Triangle>(GL_ELEMENT_ARRAY_BUFFER, triangles_.get(), world.deformable.triangles);
  fillBuffer<Vec3f>(GL_ARRAY_BUFFER, rest_.get(), restPlaces(world.deformable));
  fillBuffer<TintBytes>(GL_ARRAY_BUFFER, tint_.get(), skinTints(world));
  fillBuffer<float>(GL_ARRAY_BUFFER, field_values_.get(), stiffness_);
  glBindBuffer(GL_ARRAY_BUFFER, deformed_.get());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(kDeformedArrays * array_bytes), nullptr, GL_STREAM_DRAW);
  for (GLuint i = 0; i < kDeformedArrays; ++i) pointAt(i, deformed_.get(), 1, GL_FLOAT, i * array_bytes);
  pointAt(kRest, rest_.get(), 3, GL_FLOAT, 0);
  pointAt(kTint, tint_.get(), 4, GL_UNSIGNED_BYTE, 0);
  pointAt(kValue, field_values_.get(), 1, GL_FLOAT, 0);
  glBindVertexArray(0);
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

/// Uploads field and colour map when another one is shown.
void SkinLayer::showField(Colouring colouring) {
  if (shown_field_ == colouring) return;
  shown_field_ = colouring;
  uploadColourMap(colour_map_.get(), colourMapOf(colouring));
  if (colouring == Colouring::strain) return;
  if (colouring == Colouring::ellipses && half_major_.empty()) half_major_ = halfMajors(world_);
  fillBuffer<float>(GL_ARRAY_BUFFER, field_values_.get(), colouring == Colouring::stiffness ? stiffness_ : half_major_);
}

const Program& SkinLayer::paintField(const Look& look) {
  showField(look.colouring);
  const ColourRange& range = look.range();
  const double width = range.high - range.low;
  field_.use();
  field_.set("low", static_cast<float>(range.low));
  field_.set("per_unit", static_cast<float>(width != 0.0 ? 1.0 / width : 0.0));
  field_.set("strain_percent", look.colouring == Colouring::strain ? 1.0f : 0.0f);
  field_.set("texels", static_cast<float>(kMapTexels));
  field_.set("no_value", Vec3f(Vec3f::Constant(static_cast<float>(kNoColour.red))));
  field_.set("colour_map", 0);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, colour_map_.get());
  return field_;
}

const Program& SkinLayer::paintSkin(const Look& look, const Viewpoint& viewpoint, const SkinTouch& touch) {
  skin_.use();
  skin_.set("detail", look.detail && viewpoint.pixelsPerMm(box_) > kFewestPixelsPerMm ? 1.0f : 0.0f);
  std::array<Eigen::Vector4f, kMostBalls> balls;
  std::array<Vec3f, kMostBalls> tails;
  const std::size_t fingers = std::min(kMostBalls, touch.fingers.size());
  for (std::size_t i = 0; i < fingers; ++i) {
    const Vec3f centre = touch.fingers[i].centre.cast<float>();
    balls[i] = {centre.x(), centre.y(), centre.z(), static_cast<float>(touch.fingers[i].radius_mm)};
    tails[i] = touch.fingers[i].tail.cast<float>();
  }
  skin_.set("ball_count", static_cast<int>(fingers));
  skin_.set("ball", std::span(balls).first(fingers));
  skin_.set("ball_tail", std::span(tails).first(fingers));
  setMarks(skin_, touch.marks);
  return skin_;
}

const Program& SkinLayer::paint(const Look& look, const Viewpoint& viewpoint, const SkinTouch& touch) {
  if (look.colouring != Colouring::plain) return paintField(look);
  if (look.shading == Shading::skin) return paintSkin(look, viewpoint, touch);
  gouraud_.use();
  return gouraud_;
}

void SkinLayer::drawTriangles() const {
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(indices_), GL_UNSIGNED_INT, nullptr);
}

/// Depth alone, so that afterwards only the nearest skin of each pixel is blended: exact, whatever the order.
void SkinLayer::drawDepth(const Viewpoint& viewpoint) const {
  depth_.use();
  setViewpoint(depth_, viewpoint);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  drawTriangles();
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void SkinLayer::draw(const Look& look, const Viewpoint& viewpoint, const SkinTouch& touch) {
  if (!(look.skin_opacity > 0.0)) return;
  const bool transparent = look.skin_opacity < 1.0;
  glBindVertexArray(vertex_array_.get());
  glEnable(GL_DEPTH_TEST);
  // A closed skin hides its inside; an open sheet may be looked at from within.
  (closed_ ? glEnable : glDisable)(GL_CULL_FACE);
  if (transparent) drawDepth(viewpoint);
  glDepthFunc(transparent ? GL_EQUAL : GL_LESS);
  (transparent ? glEnable : glDisable)(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  const Program& program = paint(look, viewpoint, touch);
  setViewpoint(program, viewpoint);
  program.set("skin_colour", look.skin_colour);
  program.set("skin_opacity", static_cast<float>(std::min(1.0, look.skin_opacity)));
  drawTriangles();
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
