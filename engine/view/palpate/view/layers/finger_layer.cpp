// A unit sphere for all balls, a finger for both sides and a hand per side, made when first shown. One program shades
// balls and outlines, the other hands and fingers; both are darker towards the skin, by formula.
// Data flow: FingerPose, HandPose -> here -> framebuffer, each picture.
#include "palpate/view/layers/finger_layer.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "palpate/mesh/triangle_mesh.h"
#include "palpate/view/skin_tone.h"

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
  light += 0.8 * (key_light * gloss(n, to_key, to_eye, 0.35, 0.04) + fill_light * gloss(n, to_fill, to_eye, 0.35, 0.04));
  light += 0.25 * sky_light * pow(1.0 - saturate(dot(n, to_eye)), 4.0);
  colour = vec4(encoded(toned(1.1 * light)), 1.0);
}
)";

constexpr std::string_view kHandVertex = R"(
layout(location = 0) in vec3 point;
layout(location = 1) in vec3 point_normal;
layout(location = 2) in float redness;
uniform mat3 axes;
uniform vec3 origin;
uniform vec3 forearm;      // in the hand's frame
uniform float fade_begin;  // mm along it
uniform float fade_end;
uniform float near_mm;
out vec3 place;
out vec3 normal;
out vec3 in_hand;
out float red;
out float opacity;
void main() {
  normal = axes * point_normal;
  place = origin + axes * point;
  in_hand = point;
  red = redness;
  opacity = 1.0 - smoothstep(fade_begin, fade_end, dot(point, forearm));
  opacity *= smoothstep(near_mm + 5.0, near_mm + 100.0, dot(eye - place, backward));
  gl_Position = clip_from_body * vec4(place, 1.0);
}
)";

constexpr std::string_view kHandFragment = R"(
in vec3 place;
in vec3 normal;
in vec3 in_hand;
in float red;
in float opacity;
uniform float fading;  // 1: draws what is not opaque, 0: what is
uniform vec3 finger_colour;
uniform vec3 down;  // towards the skin, which takes away light
uniform vec3 skin_colour;
uniform float skin_scatter;
uniform vec3 forearm;
uniform float band_at;    // mm along the forearm
uniform float band_half;  // mm
uniform vec3 nail_centre[5];
uniform vec3 nail_along[5];
uniform vec3 nail_across[5];
uniform vec3 nail_up[5];
out vec4 colour;

// Within a nail below 1; y: which one wears the finger's colour.
vec2 nailHere() {
  vec2 nearest = vec2(9.0, 0.0);
  for (int i = 0; i < 5; ++i) {
    vec3 away = in_hand - nail_centre[i];
    float along = dot(away, nail_along[i]) / dot(nail_along[i], nail_along[i]);
    float across = dot(away, nail_across[i]) / dot(nail_across[i], nail_across[i]);
    float up = dot(away, nail_up[i]) / dot(nail_up[i], nail_up[i]);
    float edge = pow(along * along * along * along + across * across * across * across, 0.25) + max(-up - 0.5, 0.0) * 8.0;
    if (edge < nearest.x) nearest = vec2(edge, i == 1 ? 1.0 : 0.0);
  }
  return nearest;
}

void main() {
  if ((fading > 0.5) == (opacity > 0.995) || opacity < 0.004) discard;
  vec3 n = normalize(normal);
  vec3 to_eye = normalize(eye - place);
  vec3 skin = skin_colour * mix(vec3(1.0), vec3(1.02, 0.80, 0.78), red);
  float sheen = 0.9, narrow = 0.46;
  vec2 nail = nailHere();
  float on_nail = 1.0 - smoothstep(0.94, 1.02, nail.x);
  float border = smoothstep(0.80, 0.98, nail.x) * (1.0 - smoothstep(1.0, 1.18, nail.x));
  vec3 plate = mix(skin_colour * vec3(1.18, 1.06, 1.08), finger_colour, nail.y);
  skin = mix(skin, plate, on_nail) * (1.0 - 0.30 * border);
  sheen += 1.6 * on_nail;
  narrow -= 0.16 * on_nail;
  // A band round the wrist, or the sleeve of a finger.
  float band = abs(dot(in_hand, forearm) - band_at) - band_half;
  float on_band = 1.0 - smoothstep(0.0, 0.8, band);
  skin = mix(skin, finger_colour, on_band) * (1.0 - 0.35 * smoothstep(-1.4, 0.0, band) * (1.0 - smoothstep(0.6, 2.6, band)));
  float near_skin = 0.5 + 0.5 * dot(n, down);
  float left = 1.0 - 0.42 * near_skin * near_skin;
  vec3 wrap = wrapAmount(0.7, skin_scatter * (1.0 - on_band));
  float slant = 1.0 - saturate(dot(n, to_eye));
  float slant3 = slant * slant * slant;
  vec3 light = skinLight(n, wrap, left, left) + (vec3(0.16, 0.07, 0.05) + rim_light * (0.5 + 0.5 * n.y)) * slant3;
  vec3 seen_colour = skin * light + key_light * (sheen * specularGloss(n, to_key, to_eye, 0.58, narrow));
  seen_colour += ambientFrom(reflect(-to_eye, n)) * (0.02 + 0.10 * slant3 * slant);
  colour = vec4(encoded(toned(seen_colour)), opacity);
}
)";

/// The forearm is opaque up to this much before its end.
constexpr double kFadeMm = 110.0;
/// Its very end is invisible.
constexpr double kUnseenMm = 8.0;

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

std::vector<Vec3f> toFloats(const std::vector<Vec3>& values) {
  std::vector<Vec3f> floats;
  floats.reserve(values.size());
  for (const Vec3& value : values) floats.push_back(value.cast<float>());
  return floats;
}

std::array<Vec3f, 5> toFloats(const body::PalpatingHand& hand, Vec3 body::Nail::*part) {
  std::array<Vec3f, 5> floats;
  for (std::size_t i = 0; i < floats.size(); ++i) floats[i] = (hand.nails[i].*part).cast<float>();
  return floats;
}

void drawTriangles(Index indices) {
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(indices), GL_UNSIGNED_INT, nullptr);
}

void pointAt(GLuint location, GLuint buffer, const std::vector<Vec3f>& values) {
  fillBuffer<Vec3f>(GL_ARRAY_BUFFER, buffer, values);
  attributeAt(location, 3, GL_FLOAT);
}

}  // namespace

FingerLayer::FingerLayer()
    : program_("finger", kSharedShader, kFingerVertex, kFingerFragment),
      hand_program_("hand", kSharedShader, kHandVertex, kHandFragment),
      ball_(uploaded(unitSphere())) {}

FingerLayer::Shape FingerLayer::uploaded(const mesh::TriangleMesh& mesh) {
  Shape shape;
  shape.indices = static_cast<Index>(3 * mesh.triangles.size());
  glBindVertexArray(shape.vertex_array.get());
  fillBuffer<Triangle>(GL_ELEMENT_ARRAY_BUFFER, shape.triangles.get(), mesh.triangles);
  pointAt(0, shape.places.get(), toFloats(mesh.positions));
  pointAt(1, shape.normals.get(), toFloats(mesh::vertexNormals(mesh)));
  glBindVertexArray(0);
  return shape;
}

FingerLayer::Hand FingerLayer::uploaded(body::PalpatingHand made) {
  Shape shape = uploaded(made.mesh);
  Hand hand{std::move(made), std::move(shape), {}};
  glBindVertexArray(hand.shape.vertex_array.get());
  fillBuffer<float>(GL_ARRAY_BUFFER, hand.redness.get(), hand.hand.redness);
  attributeAt(2, 1, GL_FLOAT);
  glBindVertexArray(0);
  return hand;
}

const FingerLayer::Hand& FingerLayer::hand(Form form, bool left) {
  if (form == Form::finger) {
    if (!finger_) finger_.emplace(uploaded(body::makePalpatingFinger()));
    return *finger_;
  }
  std::optional<Hand>& hand = hands_[left ? 1 : 0];
  if (!hand) hand.emplace(uploaded(body::makePalpatingHand(left ? body::Side::left : body::Side::right)));
  return *hand;
}

void FingerLayer::begin(const Viewpoint& viewpoint) const {
  program_.use();
  setViewpoint(program_, viewpoint);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
}

void FingerLayer::setShape(const Shape& shape, const FingerPose& finger, const Mat3& axes, const Vec3& origin) const {
  program_.set("axes", Eigen::Matrix3f(axes.cast<float>()));
  program_.set("origin", Vec3f(origin.cast<float>()));
  program_.set("finger_colour", finger.colour);
  program_.set("down", Vec3f(-finger.normal.cast<float>()));
  program_.set("grown", 0.0f);
  program_.set("rim", 0.0f);
  glBindVertexArray(shape.vertex_array.get());
}

/// The back faces of a slightly larger shape: their visible edge is the outline.
void FingerLayer::drawRim(const Shape& shape, const FingerPose& finger, const Viewpoint& viewpoint) const {
  const float away_mm = (finger.centre.cast<float>() - viewpoint.eye).norm();
  program_.set("grown", static_cast<float>(finger.outline) * away_mm / viewpoint.pixels_per_radian);
  program_.set("rim", 1.0f);
  program_.set("finger_colour", Vec3f(kRim));
  glCullFace(GL_FRONT);
  drawTriangles(shape.indices);
  glCullFace(GL_BACK);
}

void FingerLayer::drawBalls(std::span<const FingerPose> fingers, const Viewpoint& viewpoint) const {
  begin(viewpoint);
  for (const FingerPose& finger : fingers) {
    setShape(ball_, finger, finger.radius_mm * Mat3::Identity(), finger.centre);
    drawTriangles(ball_.indices);
    if (finger.outline > 0.0) drawRim(ball_, finger, viewpoint);
  }
  glDisable(GL_CULL_FACE);
}

HandPose FingerLayer::handPose(const scene::World& world, Form form, const FingerPose& finger) {
  const double size = form == Form::finger ? finger.radius_mm / body::kFingertipMm : 1.0;
  return computeHandPose(world, finger, hand(form, finger.left).hand, size);
}

void FingerLayer::addCasters(Form form, const FingerPose& finger, const HandPose& pose,
                             std::vector<ShadowCaster>& casters) {
  const body::PalpatingHand& hand = this->hand(form, finger.left).hand;
  const auto placed = [&](const Vec3& in_hand) { return Vec3f((pose.origin + pose.axes * in_hand).cast<float>()); };
  if (form == Form::finger) {
    const Vec3 sleeve = (hand.band_mm + hand.band_half_mm) * hand.forearm;
    casters.push_back({placed(hand.pad), placed(sleeve), static_cast<float>(finger.radius_mm)});
    return;
  }
  const double side = finger.left ? -1.0 : 1.0;
  // The index finger from its pad to the knuckle, the other fingers together, and the palm.
  casters.push_back({placed(hand.pad), placed({-27.0 * side, 94.0, 1.0}), 8.0f});
  casters.push_back({placed({6.0 * side, 160.0, -6.0}), placed({6.0 * side, 100.0, 0.0}), 14.0f});
  casters.push_back({placed({4.0 * side, 80.0, 0.0}), placed({0.0, 10.0, 0.0}), 26.0f});
}

void FingerLayer::setHand(const Hand& hand, const FingerPose& finger, const HandTones& tones,
                          const Viewpoint& viewpoint) const {
  const SkinTone tone = interpolateSkinTone(tones.skin);
  hand_program_.use();
  setViewpoint(hand_program_, viewpoint);
  hand_program_.set("skin_colour", tone.colour);
  hand_program_.set("skin_scatter", tone.scatter);
  hand_program_.set("finger_colour", finger.colour);
  hand_program_.set("down", Vec3f(-finger.normal.cast<float>()));
  hand_program_.set("forearm", Vec3f(hand.hand.forearm.cast<float>()));
  hand_program_.set("fade_begin", static_cast<float>(hand.hand.forearm_mm - kFadeMm));
  hand_program_.set("fade_end", static_cast<float>(hand.hand.forearm_mm - kUnseenMm));
  hand_program_.set("band_at", static_cast<float>(hand.hand.band_mm));
  hand_program_.set("band_half", static_cast<float>(hand.hand.band_half_mm));
  hand_program_.set("near_mm", static_cast<float>(tones.near_mm));
  for (const auto& [name, part] :
       {std::pair{"nail_centre", &body::Nail::centre}, std::pair{"nail_along", &body::Nail::along},
        std::pair{"nail_across", &body::Nail::across}, std::pair{"nail_up", &body::Nail::up}}) {
    const std::array<Vec3f, 5> values = toFloats(hand.hand, part);
    hand_program_.set(name, std::span<const Vec3f>(values));
  }
}

void FingerLayer::drawHand(Form form, const FingerPose& finger, const HandPose& pose, const HandTones& tones,
                           const Viewpoint& viewpoint, Part part) {
  if (form == Form::finger && part == Part::fading) return;
  const Hand& hand = this->hand(form, finger.left);
  setHand(hand, finger, tones, viewpoint);
  hand_program_.set("axes", Eigen::Matrix3f(pose.axes.cast<float>()));
  hand_program_.set("origin", Vec3f(pose.origin.cast<float>()));
  hand_program_.set("fading", part == Part::fading ? 1.0f : 0.0f);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
  (part == Part::fading ? glEnable : glDisable)(GL_BLEND);
  blendOver();
  glBindVertexArray(hand.shape.vertex_array.get());
  drawTriangles(hand.shape.indices);
  glDisable(GL_BLEND);
  if (form == Form::finger && finger.outline > 0.0) {
    begin(viewpoint);
    setShape(hand.shape, finger, pose.axes, pose.origin);
    drawRim(hand.shape, finger, viewpoint);
  }
  glDisable(GL_CULL_FACE);
}

}  // namespace palpate::view
