#include "palpate/view/finger_layer.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "palpate/view/shared_shader.h"

namespace palpate::view {

namespace {

constexpr std::string_view kVertex = R"(
layout(location = 0) in vec3 on_sphere;
uniform vec3 centre;
uniform float radius;
out vec3 place;
out vec3 normal;
void main() {
  place = centre + radius * on_sphere;
  normal = on_sphere;
  gl_Position = clip_from_body * vec4(place, 1.0);
}
)";

constexpr std::string_view kFragment = R"(
in vec3 place;
in vec3 normal;
uniform vec3 finger_colour;
uniform vec3 down;  // towards the skin, which takes away light and gives its own
out vec4 colour;
void main() {
  vec3 n = normalize(normal);
  vec3 to_eye = normalize(eye - place);
  float near_skin = 0.5 + 0.5 * dot(n, down);
  vec3 light = finger_colour * (matteLight(n, 0.8) * (1.0 - 0.55 * near_skin));
  light += finger_colour * vec3(0.5, 0.25, 0.18) * (near_skin * near_skin);
  light += key_light * gloss(n, to_key, to_eye, 0.35, 0.04) + fill_light * gloss(n, to_fill, to_eye, 0.35, 0.04);
  light += 0.25 * sky_light * pow(1.0 - saturate(dot(n, to_eye)), 4.0);
  colour = vec4(encoded(toned(0.75 * light)), 1.0);
}
)";

constexpr Index kRings = 24;
constexpr Index kSectors = 48;

std::vector<Vec3f> spherePoints() {
  std::vector<Vec3f> points;
  for (Index ring = 0; ring <= kRings; ++ring) {
    const double polar = std::numbers::pi * ring / kRings;
    for (Index sector = 0; sector <= kSectors; ++sector) {
      const double around = 2.0 * std::numbers::pi * sector / kSectors;
      points.emplace_back(std::sin(polar) * std::cos(around), std::cos(polar), std::sin(polar) * std::sin(around));
    }
  }
  return points;
}

std::vector<Triangle> sphereTriangles() {
  std::vector<Triangle> triangles;
  for (Index ring = 0; ring < kRings; ++ring) {
    for (Index sector = 0; sector < kSectors; ++sector) {
      const Index a = ring * (kSectors + 1) + sector;
      const Index below = a + kSectors + 1;
      triangles.push_back({a, a + 1, below});
      triangles.push_back({a + 1, below + 1, below});
    }
  }
  return triangles;
}

}  // namespace

FingerLayer::FingerLayer() : program_("finger", kSharedShader, kVertex, kFragment) {
  const std::vector<Triangle> triangles = sphereTriangles();
  ball_indices_ = static_cast<Index>(3 * triangles.size());
  glBindVertexArray(ball_array_.get());
  fillBuffer<Triangle>(GL_ELEMENT_ARRAY_BUFFER, ball_triangles_.get(), triangles);
  fillBuffer<Vec3f>(GL_ARRAY_BUFFER, ball_.get(), spherePoints());
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  glBindVertexArray(0);
}

void FingerLayer::drawBalls(std::span<const FingerPose> fingers, const Viewpoint& viewpoint) const {
  if (fingers.empty()) return;
  program_.use();
  setViewpoint(program_, viewpoint);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
  glBindVertexArray(ball_array_.get());
  for (const FingerPose& finger : fingers) {
    program_.set("centre", Vec3f(finger.centre.cast<float>()));
    program_.set("radius", static_cast<float>(finger.radius_mm));
    program_.set("finger_colour", finger.colour);
    program_.set("down", Vec3f(-finger.normal.cast<float>()));
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(ball_indices_), GL_UNSIGNED_INT, nullptr);
  }
  glDisable(GL_CULL_FACE);
}

}  // namespace palpate::view
