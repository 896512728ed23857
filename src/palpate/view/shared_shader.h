// GLSL that every shader starts with: the eye, the lights, and the way from light to a pixel's value.
#pragma once

#include <string_view>

namespace palpate::view {

/// Lengths in mm of the body frame, colours linear unless their name says encoded. Tone curve: Narkowicz's fit of the
/// ACES curve ("ACES filmic tone mapping curve", 2015).
inline constexpr std::string_view kSharedShader = R"(
uniform mat4 clip_from_body;
uniform vec3 eye;
uniform vec3 backward;
uniform vec3 to_key;
uniform vec3 to_fill;

// A warm key, a cool fill at a quarter of it, and the sky: cool above, warm from the skin and the couch below.
const vec3 key_light = vec3(2.35, 2.15, 1.86);
const vec3 fill_light = vec3(0.42, 0.50, 0.60);
const vec3 sky_light = vec3(0.34, 0.37, 0.42);
const vec3 ground_light = vec3(0.21, 0.17, 0.14);

float saturate(float x) { return clamp(x, 0.0, 1.0); }
vec3 saturate(vec3 x) { return clamp(x, 0.0, 1.0); }

vec3 ambientFrom(vec3 normal) { return mix(ground_light, sky_light, 0.5 + 0.5 * normal.y); }

vec3 toned(vec3 light) { return saturate((light * (2.51 * light + 0.03)) / (light * (2.43 * light + 0.59) + 0.14)); }

vec3 encoded(vec3 linear) {
  return mix(12.92 * linear, 1.055 * pow(max(linear, vec3(1e-5)), vec3(1.0 / 2.4)) - 0.055,
             step(vec3(0.0031308), linear));
}

// Matte light on a plain surface (bones, fingers).
vec3 matteLight(vec3 normal, float key_share) {
  return key_light * (key_share * saturate(dot(normal, to_key))) + fill_light * saturate(dot(normal, to_fill)) +
         ambientFrom(normal);
}

// One GGX lobe without the colour of the light; visibility as Kelemen and Szirmay-Kalos approximate it (2001).
float gloss(vec3 normal, vec3 to_light, vec3 to_eye, float roughness, float f0) {
  vec3 half_way = normalize(to_light + to_eye);
  float nh = saturate(dot(normal, half_way));
  float lh = saturate(dot(to_light, half_way));
  float a2 = roughness * roughness * roughness * roughness;
  float d = nh * nh * (a2 - 1.0) + 1.0;
  float fresnel = f0 + (1.0 - f0) * pow(1.0 - lh, 5.0);
  return fresnel * a2 / (12.566371 * d * d * max(lh * lh, 0.1)) * saturate(dot(normal, to_light) * 4.0);
}
)";

}  // namespace palpate::view
