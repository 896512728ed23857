// Inputs of every shader about the eye: where it is, what it sees, where the light comes from, and the way from light
// to a pixel's value.
//
//   Frustum ─ makeViewpoint ─► Viewpoint ─ setViewpoint ─► the uniforms of kSharedShader, once per layer
//
// Based on: Narkowicz, "ACES filmic tone mapping curve", 2015; Kelemen and Szirmay-Kalos, "A microfacet based coupled
// specular-matte BRDF model with importance sampling", 2001 (the visibility of the gloss).
#pragma once

#include <string_view>

#include "palpate/view/camera.h"

namespace palpate::view {

class Program;

/// Directions to the lights, unit vectors of the body frame. They follow the camera's yaw only: turning the body keeps
/// its relief lit from the side, and looking from above does not flatten it.
struct Lights {
  Vec3f key = Vec3f::UnitZ();   ///< warm, from the cranial left and 57 degrees off the axis: raking light shows dents
  Vec3f fill = Vec3f::UnitZ();  ///< cool and weak, from the other side
};

/// For a body frame whose y axis points up.
Lights lightsFor(const Frustum& frustum);

struct Viewpoint {
  /// Origin of places on the graphics card, mm of the body frame: the skin's (deform/skin.h).
  Vec3 origin = Vec3::Zero();
  Mat4f clip = Mat4f::Identity();   ///< places there -> clip
  Vec3f eye = Vec3f::Zero();        ///< likewise
  Vec3f backward = Vec3f::UnitZ();  ///< unit, from the picture to the eye
  Lights lights;
  Vec2f pixels = Vec2f::Ones();    ///< size of the viewport
  double near_mm = 1.0;            ///< distance of the near plane
  float lift_mm = 0.0f;            ///< how far the breath has moved the body
  float pixels_per_point = 1.0f;   ///< Frame::pixels_per_point
  float pixels_per_radian = 1.0f;  ///< in the middle of the picture: pixels of 1 mm at 1 mm, divide by the distance

  /// A place of the body frame on the graphics card.
  Vec3f drawn(const Vec3& place) const { return (place - origin).cast<float>(); }

  /// At the nearest place of a box on the graphics card; infinite within it.
  float pixelsPerMm(const Eigen::AlignedBox3f& box) const { return pixels_per_radian / box.exteriorDistance(eye); }
};

Viewpoint makeViewpoint(const Frustum& frustum, int width, int height, const Vec3& origin = Vec3::Zero());

/// GLSL that every shader starts with. Lengths in mm, places from Viewpoint::origin, colours linear unless their name
/// says encoded.
inline constexpr std::string_view kSharedShader = R"(
uniform mat4 clip_from_body;
uniform vec3 eye;
uniform float lift_mm;  // how far the breath has moved the body
uniform vec3 backward;
uniform vec3 to_key;
uniform vec3 to_fill;

// A warm key, a cool fill at a quarter of it, and the sky: cool above, warm from the skin and the couch below.
const vec3 key_light = vec3(1.30, 1.20, 1.06);
const vec3 fill_light = vec3(0.22, 0.245, 0.28);
const vec3 sky_light = vec3(0.215, 0.230, 0.255);
const vec3 ground_light = vec3(0.135, 0.108, 0.092);
const vec3 rim_light = vec3(0.22, 0.225, 0.235);

float saturate(float x) { return clamp(x, 0.0, 1.0); }
vec3 saturate(vec3 x) { return clamp(x, 0.0, 1.0); }

vec3 ambientFrom(vec3 normal) { return mix(ground_light, sky_light, 0.5 + 0.5 * normal.y); }

// As it is up to 0.6, then bent towards 1 by the brightest channel: the hue stays.
vec3 toned(vec3 light) {
  float peak = max(max(light.r, light.g), max(light.b, 1e-4));
  float over = max(peak - 0.6, 0.0);
  return light * ((peak - over + over / (1.0 + 2.5 * over)) / peak);
}

// sRGB by square roots, within 0.002 of the true curve; powers cost several times as much.
vec3 encoded(vec3 linear) {
  vec3 r2 = sqrt(linear), r4 = sqrt(r2), r8 = sqrt(r4);
  return saturate(0.662002687 * r2 + 0.684122060 * r4 - 0.323583601 * r8 - 0.0225411470 * linear);
}

// Matte light on a plain surface (bones, fingers).
vec3 matteLight(vec3 normal, float key_share) {
  return key_light * (key_share * saturate(dot(normal, to_key))) + fill_light * saturate(dot(normal, to_fill)) +
         ambientFrom(normal);
}

// Light that goes round the edge of shadow, a channel each: that which travels under the skin, and that of a wide lamp,
// which sets over +-edge of the cosine. Where it sets at once, a ridge of the body throws a shadow with a hard edge.
vec3 wrapped(float cosine, vec3 wrap) {
  const float edge = 0.34;
  vec3 light = (cosine + wrap) / ((1.0 + wrap) * (1.0 + wrap));
  vec3 risen = clamp(light + edge, 0.0, 2.0 * edge);
  return min(max(light - edge, 0.0) + risen * risen / (4.0 * edge), 1.0);
}

// How far, by the share of a fingertip's curvature and by how much the tone lets through.
vec3 wrapAmount(float curvature, float scatter) {
  return vec3(0.08) + vec3(0.48, 0.14, 0.06) * (scatter * (0.45 + 0.55 * curvature));
}

// Shares that something leaves: of the key, and of all else.
vec3 skinLight(vec3 normal, vec3 wrap, float key_left, float sky_left) {
  return key_light * (key_left * wrapped(dot(normal, to_key), wrap)) +
         (fill_light * wrapped(dot(normal, to_fill), wrap) + ambientFrom(normal)) * sky_left;
}

// The gloss of skin without the colour of the light: a broad lobe and a faint narrow one (GGX), weak face on.
float specularGloss(vec3 normal, vec3 to_light, vec3 to_eye, float broad, float narrow) {
  vec3 half_way = normalize(to_light + to_eye);
  float nh = saturate(dot(normal, half_way));
  float lh = saturate(dot(to_light, half_way));
  vec2 a2 = vec2(broad * broad, narrow * narrow);
  a2 *= a2;
  vec2 d = nh * nh * (a2 - 1.0) + 1.0;
  vec2 lobes = a2 / (d * d);
  float grazing = (1.0 - lh) * (1.0 - lh);
  float fresnel = 0.028 + 0.972 * grazing * grazing * (1.0 - lh);
  return fresnel * (1.05 * lobes.x + 0.22 * lobes.y) / (4.0 * max(lh * lh, 0.25)) * saturate(dot(normal, to_light) * 1.5);
}

// One GGX lobe without the colour of the light; visibility as Kelemen and Szirmay-Kalos approximate it.
float gloss(vec3 normal, vec3 to_light, vec3 to_eye, float roughness, float f0) {
  vec3 half_way = normalize(to_light + to_eye);
  float nh = saturate(dot(normal, half_way));
  float lh = saturate(dot(to_light, half_way));
  float a2 = roughness * roughness * roughness * roughness;
  float d = nh * nh * (a2 - 1.0) + 1.0;
  float grazing = (1.0 - lh) * (1.0 - lh);
  float fresnel = f0 + (1.0 - f0) * grazing * grazing * (1.0 - lh);
  return fresnel * a2 / (12.566371 * d * d * max(lh * lh, 0.1)) * saturate(dot(normal, to_light) * 4.0);
}
)";

/// Sets the uniforms of kSharedShader; the program must be in use.
void setViewpoint(const Program& program, const Viewpoint& viewpoint);

}  // namespace palpate::view
