// Dull padding in a colour unlike skin and ground; the sky that the body covers is missing in all lights, so that the
// body is seen to lie. Each picture.
#include "palpate/view/layers/support_layer.h"

#include <algorithm>
#include <cstddef>

namespace palpate::view {

namespace {

constexpr std::string_view kSupportVertex = R"(
layout(location = 0) in vec3 place_in;
layout(location = 1) in vec3 normal_in;
layout(location = 2) in float sky_in;
out vec3 place;
out vec3 normal;
out float sky;
void main() {
  place = place_in;
  normal = normal_in;
  sky = sky_in;
  gl_Position = clip_from_body * vec4(place_in, 1.0);
}
)";

constexpr std::string_view kSupportFragment = R"(
in vec3 place;
in vec3 normal;
in float sky;
uniform float opacity;
out vec4 colour;
const vec3 padding = vec3(0.118, 0.148, 0.165);
void main() {
  vec3 n = normalize(normal);
  vec3 light = padding * skinLight(n, vec3(0.15), mix(0.35, 1.0, sky), mix(0.15, 1.0, sky));
  light += key_light * (0.5 * sky * specularGloss(n, to_key, normalize(eye - place), 0.62, 0.5));
  colour = vec4(encoded(toned(light)), opacity);
}
)";

}  // namespace

SupportLayer::SupportLayer() : program_("support", kSharedShader, kSupportVertex, kSupportFragment) {
  glBindVertexArray(vertex_array_.get());
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, triangles_.get());
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.get());
  attributeAt(0, 3, GL_FLOAT, sizeof(SupportVertex), offsetof(SupportVertex, place));
  attributeAt(1, 3, GL_FLOAT, sizeof(SupportVertex), offsetof(SupportVertex, normal));
  attributeAt(2, 1, GL_FLOAT, sizeof(SupportVertex), offsetof(SupportVertex, sky));
  glBindVertexArray(0);
}

void SupportLayer::setWorld(const scene::World& world) {
  slab_ = supportSlab(world);
  if (!slab_) return;
  const SupportShape shape = supportShape(*slab_, world);
  glBindVertexArray(vertex_array_.get());
  fillBuffer<Triangle>(GL_ELEMENT_ARRAY_BUFFER, triangles_.get(), shape.triangles);
  fillBuffer<SupportVertex>(GL_ARRAY_BUFFER, vertices_.get(), shape.vertices);
  glBindVertexArray(0);
  count_ = static_cast<GLsizei>(3 * shape.triangles.size());
}

float SupportLayer::opacityFor(const Look& look, const Viewpoint& viewpoint) const {
  if (!slab_ || look.plain_background) return 0.0f;
  constexpr double kGoneSine = -0.2;  // sine of the angle that the eye is below the plane
  const Vec3 to_eye = viewpoint.eye.cast<double>() - slab_->middle;
  const double sine = to_eye.dot(slab_->up) / to_eye.norm();
  return static_cast<float>(std::clamp(1.0 - sine / kGoneSine, 0.0, 1.0));
}

void SupportLayer::draw(const Viewpoint& viewpoint, float opacity) {
  if (!(opacity > 0.0f)) return;
  program_.use();
  setViewpoint(program_, viewpoint);
  program_.set("opacity", opacity);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
  (opacity < 1.0f ? glEnable : glDisable)(GL_BLEND);
  blendOver();
  glBindVertexArray(vertex_array_.get());
  glDrawElements(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
}

}  // namespace palpate::view
