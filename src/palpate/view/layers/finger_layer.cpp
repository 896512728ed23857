// A unit sphere for all balls, a hand a side made when first shown; one program shades both, darker and redder towards
// the skin, by formula.
// Data flow: FingerPose, HandPose -> here -> framebuffer, each picture. Own.
#include "palpate/view/layers/finger_layer.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::view {

namespace {

constexpr std::string_view kFingerVertex = R"(
layout(location = 0) in vec3 point;
layout(location = 1) in vec3 point_normal;
uniform mat3 axes;  // a turn, and a size
uniform vec3 origin;
uniform float grown;  // mm along the normals
out vec3 place;
out vec3 normal;
void main() {
  normal = axes * point_normal;
  place = origin + axes * point + grown * normalize(normal);
  gl_Position = clip_from_body * vec4(place, 1.0);
}
)";

constexpr std::string_view kFingerFragment = R"(
in vec3 place;
in vec3 normal;
uniform vec3 finger_colour;
uniform vec3 down;  // towards the skin, which takes away light and gives its own
uniform float rim;  // 1: an outline, which knows no light
out vec4 colour;
void main() {
  if (rim > 0.5) {
    colour = vec4(encoded(finger_colour), 1.0);
    return;
  }
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

/// Linear: light, so that it is seen on skin of every tone and on both fingers.
const Vec3f kRim{0.95f, 0.93f, 0.80f};

constexpr Index kBallRings = 24;
constexpr Index kSectors = 48;

mesh::TriangleMesh unitSphere() {
  mesh::TriangleMesh sphere;
  for (Index ring = 0; ring <= kBallRings; ++ring) {
    const double polar = std::numbers::pi * ring / kBallRings;
    for (Index sector = 0; sector < kSectors; ++sector) {
      const double around = 2.0 * std::numbers::pi * sector / kSectors;
      sphere.positions.emplace_back(std::sin(polar) * std::cos(around), std::cos(polar),
                                    std::sin(polar) * std::sin(around));
    }
  }
  for (Index ring = 0; ring < kBallRings; ++ring) {
    for (Index sector = 0; sector < kSectors; ++sector) {
      const Index next = (sector + 1) % kSectors;
      const Index row = ring * kSectors;
      const Index below = row + kSectors;
      sphere.triangles.push_back({row + sector, row + next, below + sector});
      sphere.triangles.push_back({row + next, below + next, below + sector});
    }
  }
  return sphere;
}

std::vector<Vec3f> floatsOf(const std::vector<Vec3>& values) {
  std::vector<Vec3f> floats;
  floats.reserve(values.size());
  for (const Vec3& value : values) floats.push_back(value.cast<float>());
  return floats;
}

void pointAt(GLuint location, GLuint buffer, const std::vector<Vec3f>& values) {
  fillBuffer<Vec3f>(GL_ARRAY_BUFFER, buffer, values);
  attributeAt(location, 3, GL_FLOAT);
}

}  // namespace

FingerLayer::FingerLayer()
    : program_("finger", kSharedShader, kFingerVertex, kFingerFragment), ball_(uploaded(unitSphere())) {}

FingerLayer::Shape FingerLayer::uploaded(const mesh::TriangleMesh& mesh) {
  Shape shape;
  shape.indices = static_cast<Index>(3 * mesh.triangles.size());
  glBindVertexArray(shape.vertex_array.get());
  fillBuffer<Triangle>(GL_ELEMENT_ARRAY_BUFFER, shape.triangles.get(), mesh.triangles);
  pointAt(0, shape.places.get(), floatsOf(mesh.positions));
  pointAt(1, shape.normals.get(), floatsOf(mesh::vertexNormals(mesh)));
  glBindVertexArray(0);
  return shape;
}

const FingerLayer::Hand& FingerLayer::hand(bool left) {
  std::optional<Hand>& hand = hands_[left ? 1 : 0];
  if (!hand) {
    body::HandSettings settings;
    settings.side = left ? body::Side::left : body::Side::right;
    mesh::TriangleMesh mesh = body::makeHand(settings);
    Shape shape = uploaded(mesh);
    hand.emplace(Hand{std::move(mesh), std::move(shape)});
  }
  return *hand;
}

void FingerLayer::begin(const Viewpoint& viewpoint) const {
  program_.use();
  setViewpoint(program_, viewpoint);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
}

void FingerLayer::drawShape(const Shape& shape, const FingerPose& finger, const Mat3& axes, const Vec3& origin,
                            const Viewpoint& viewpoint) const {
  program_.set("axes", Eigen::Matrix3f(axes.cast<float>()));
  program_.set("origin", Vec3f(origin.cast<float>()));
  program_.set("finger_colour", finger.colour);
  program_.set("down", Vec3f(-finger.normal.cast<float>()));
  program_.set("grown", 0.0f);
  program_.set("rim", 0.0f);
  glBindVertexArray(shape.vertex_array.get());
  const auto draw = [&] {
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(shape.indices), GL_UNSIGNED_INT, nullptr);
  };
  draw();
  if (finger.outline <= 0.0) return;
  // The back faces of a slightly larger shape: what stands out behind the shape is its outline.
  const float away_mm = (finger.centre.cast<float>() - viewpoint.eye).norm();
  program_.set("grown", static_cast<float>(finger.outline) * away_mm / viewpoint.pixels_per_radian);
  program_.set("rim", 1.0f);
  program_.set("finger_colour", Vec3f(kRim));
  glCullFace(GL_FRONT);
  draw();
  glCullFace(GL_BACK);
}

void FingerLayer::drawBalls(std::span<const FingerPose> fingers, const Viewpoint& viewpoint) const {
  begin(viewpoint);
  for (const FingerPose& finger : fingers) {
    drawShape(ball_, finger, finger.radius_mm * Mat3::Identity(), finger.centre, viewpoint);
  }
  glDisable(GL_CULL_FACE);
}

HandPose FingerLayer::handPose(const scene::World& world, const FingerPose& finger) {
  return handPoseOf(world, finger, hand(finger.left).mesh);
}

void FingerLayer::drawHand(const FingerPose& finger, const HandPose& pose, const Viewpoint& viewpoint) {
  const Shape& shape = hand(finger.left).shape;
  // A hand is open at its wrist: its inside would pass for an outline.
  FingerPose bare = finger;
  bare.outline = 0.0;
  begin(viewpoint);
  drawShape(shape, bare, pose.axes, pose.origin, viewpoint);
  glDisable(GL_CULL_FACE);
}

}  // namespace palpate::view
