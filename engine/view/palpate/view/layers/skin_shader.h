// The shaders of the skin: light at the vertices, light at the pixels, a field as colours, and depth alone.
#pragma once

#include <string_view>

namespace palpate::view {

/// Attributes of the skin, for every vertex shader of it. Positions and normals are one float array per axis, as the
/// deformation writes them. `invariant` makes the depth of all passes the same to the bit.
inline constexpr std::string_view kSkinAttributes = R"(
layout(location = 0) in float x;
layout(location = 1) in float y;
layout(location = 2) in float z;
layout(location = 3) in float nx;
layout(location = 4) in float ny;
layout(location = 5) in float nz;
layout(location = 6) in float strain;
layout(location = 7) in vec3 rest_place;
layout(location = 8) in vec4 tint;    // kTintUnit is 128
layout(location = 9) in float value;  // of the field shown, when it does not change with the deformation
layout(location = 10) in vec2 picture_place;  // with PICTURE
layout(location = 12) in vec3 rest_normal;
layout(location = 13) in float breath_share;  // of lift_mm, along z
invariant gl_Position;
uniform vec3 skin_colour;
uniform float skin_blood;   // SkinTone
uniform float skin_opacity;
uniform float made_white;   // kMadeSkinWhite where the picture has factors on the skin's colour; 0: it has colours
uniform float dent_contrast;  // 1: as it would be near by; above, what a dent does to normals and light is exaggerated
uniform float mm_per_point;     // of the picture, 1 mm from the eye
uniform float least_help_mm, full_help_mm;  // kLeastHelpMm, kFullHelpMm

vec3 placeHere() { return vec3(x, y, z + lift_mm * breath_share); }
#ifdef TOUCHED
uniform int dent_count;
uniform vec4 dent_at[8];   // SkinDent: place and how much it is a dent
uniform vec4 dent_way[8];  // normal and reach

// x: how deep the place lies under where it was, mm, both along the press that made the dent and along the skin's own
// normal: a drag that goes straight is none by the first, one that follows the skin by the second. y: how much the
// place belongs to that dent.
vec2 dentHere() {
  vec3 sunk = rest_place - vec3(x, y, z);
  vec2 deepest = vec2(0.0);
  for (int i = 0; i < dent_count; ++i) {
    float reach = dent_way[i].w;
    float belongs = dent_at[i].w * (1.0 - smoothstep(reach, 1.3 * reach, distance(rest_place, dent_at[i].xyz))) *
                    smoothstep(0.1, 0.5, dot(rest_normal, dent_way[i].xyz));  // the other wall of a fold does not
    float depth = min(dot(sunk, dent_way[i].xyz), dot(sunk, rest_normal));
    if (belongs * depth > deepest.x * deepest.y) deepest = vec2(depth, belongs);
  }
  return deepest;
}
// What a dent needs to be seen: nothing near by, all of it where a dent of 40 mm is 50 points wide.
float helpAt(vec3 place, vec2 dent) {
  return dent.y * smoothstep(least_help_mm, full_help_mm, mm_per_point * dot(eye - place, backward));
}
float contrastAt(vec3 place, vec2 dent) { return dent_contrast * (1.0 + 1.2 * helpAt(place, dent)); }
// The share of light that the walls of a dent leave.
float lightLeftByDent(float contrast, vec2 dent) {
  return 1.0 - dent.y * min(0.9, 0.34 * contrast) * smoothstep(0.2, 9.0, dent.x);
}
#else
vec2 dentHere() { return vec2(0.0); }
float contrastAt(vec3 place, vec2 dent) { return dent_contrast; }
float lightLeftByDent(float contrast, vec2 dent) { return 1.0; }
#endif
// Normals that have turned since rest turn farther.
vec3 normalHere(float contrast) {
  vec3 normal = vec3(nx, ny, nz);
  return normal + max(contrast - 1.0, 0.0) * (normal - rest_normal);
}
#ifdef COLOURS
layout(location = 11) in vec4 given_colour;  // sRGB
vec3 albedoHere() {
  vec3 c = given_colour.rgb;
  return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c));
}
#else
vec3 albedoHere() {
  vec3 share = tint.rgb * (255.0 / 128.0);
  return skin_colour * mix(vec3(dot(share, vec3(0.3, 0.5, 0.2))), share, skin_blood);
}
#endif
)";

/// Shared by the fragment shaders: skin seen at a slant hides more than skin seen face on.
inline constexpr std::string_view kSkinOpacity = R"(
float opacityAt(float facing, float face_on) {
  float slant = 1.0 - facing;
  return mix(face_on, 1.0, slant * slant * slant);
}
)";

inline constexpr std::string_view kDepthVertex = R"(
void main() { gl_Position = clip_from_body * vec4(placeHere(), 1.0); }
)";
inline constexpr std::string_view kDepthFragment = R"(
void main() {}
)";

/// The dissertation's shading: light at the vertices, colours interpolated across the triangle. On the user's picture
/// light is interpolated, and the picture that it falls on.
inline constexpr std::string_view kGouraudVertex = R"(
uniform float skin_scatter;
uniform float skin_sheen;
out vec4 front;  // fourth: opacity
out vec3 back;
#ifdef TOUCHED
out vec3 place;
out vec3 normal;
out vec2 contour;  // depth under rest, mm; how much of the contours is seen
#else
vec3 place, normal;
#endif
#ifdef PICTURE
out float front_shine;
out vec2 at;
#endif
void main() {
  place = placeHere();
  gl_Position = clip_from_body * vec4(place, 1.0);
  vec2 sunk = dentHere();
  float contrast = contrastAt(place, sunk);
  normal = normalize(normalHere(contrast));
#ifdef TOUCHED
  contour = vec2(sunk.x, helpAt(place, sunk) * min(dent_contrast, 1.0));
#endif
  vec3 to_eye = normalize(eye - place);
  vec3 wrap = wrapAmount(tint.a, skin_scatter);
  float facing = dot(normal, to_eye);
  float slant = 1.0 - saturate(facing);
  float dent = lightLeftByDent(contrast, sunk);
  vec3 light = skinLight(normal, wrap, dent, dent) + rim_light * (0.5 * slant * slant * slant);
  vec3 light_behind = skinLight(-normal, wrap, 0.5, 0.5) * 0.5;
  float shine = skin_sheen * dent * specularGloss(normal, to_key, to_eye, 0.60, 0.50);
  front.a = opacityAt(abs(facing), skin_opacity);
#ifdef PICTURE
  vec3 under = made_white > 0.0 ? made_white * albedoHere() : vec3(1.0);
  front.rgb = under * light;
  back = under * light_behind;
  front_shine = shine;
  at = picture_place;
#else
  vec3 albedo = albedoHere();
  front.rgb = encoded(toned(albedo * light + shine));
  back = encoded(toned(albedo * light_behind));
#endif
}
)";
inline constexpr std::string_view kGouraudFragment = R"(
in vec4 front;
in vec3 back;
out vec4 colour;
#ifdef TOUCHED
in vec3 place;
in vec3 normal;
in vec2 contour;
vec3 touched(vec3 encoded_colour) {
  vec2 left = lightLeftByFingers(place, normalize(normal));
  return contoured(encoded_colour * sqrt(0.65 * left.y + 0.35 * left.x), contour);
}
#else
vec3 touched(vec3 encoded_colour) { return encoded_colour; }
#endif
#ifdef PICTURE
in float front_shine;
in vec2 at;
uniform sampler2D picture;
void main() {
  vec3 skin = texture(picture, at).rgb;
  vec3 light = gl_FrontFacing ? skin * front.rgb + front_shine : skin * back;
  colour = vec4(touched(encoded(toned(light))), front.a);
}
#else
void main() { colour = vec4(touched(gl_FrontFacing ? front.rgb : back), front.a); }
#endif
)";

/// Contours of equal depth in a dent that is small in the picture (with TOUCHED): pairs of a dark line and a bright one
/// outside of it, as wide near by as far away, so that one is visible on pale and on dark skin.
inline constexpr std::string_view kDentContours = R"(
uniform float pixels_a_point;
// x: depth under rest, mm; y: how much is seen. Colours are encoded.
vec3 contoured(vec3 skin, vec2 contour) {
  const float rim = 0.5;    // kOutermostContourMm
  const float apart = 2.0;  // mm
  const float width = 1.1;  // points
  float slope = max(fwidth(contour.x), 1e-5);
  float level = rim + apart * max(0.0, floor((contour.x - rim) / apart + 0.5));
  float inward = (contour.x - level) / slope;  // pixels
  float px = width * pixels_a_point;
  vec2 line = clamp(0.5 * px + 0.5 - abs(vec2(inward - 0.5 * px, inward + 0.5 * px)), 0.0, 1.0);
  // On ground that is almost level a line would be where rounding puts it.
  line *= contour.y * smoothstep(0.01, 0.03, slope * pixels_a_point) * (level > rim ? 0.55 : 1.0);
  return saturate(skin * (1.0 - 0.34 * line.x) + 0.14 * line.y);
}
)";

/// The share of light that fingers leave, by formula (with TOUCHED). Balls, and rods with round ends for fingers and
/// hands. Based on: Quilez, "sphere ambient occlusion" and "sphere soft shadow".
inline constexpr std::string_view kFingerShade = R"(
uniform int ball_count;
uniform vec4 ball[8];        // centre and radius of what shadows the skin
uniform vec3 ball_tail[8];   // other end of a finger; the centre for a ball

vec3 nearestOnFinger(int i, vec3 p) {
  vec3 along = ball_tail[i] - ball[i].xyz;
  float t = saturate(dot(p - ball[i].xyz, along) / max(dot(along, along), 1e-6));
  return ball[i].xyz + t * along;
}

// x: share of the sky that the fingers leave, y: share of the key light.
vec2 lightLeftByFingers(vec3 p, vec3 n) {
  vec2 left = vec2(1.0);
  for (int i = 0; i < ball_count; ++i) {
    float r = ball[i].w;
    vec3 to = nearestOnFinger(i, p) - p;
    float d = length(to);
    float covered = min(0.85, saturate(dot(n, to) / d) * r * r / (d * d)) * (1.0 - smoothstep(2.5, 4.0, d / r));
    left.x *= 1.0 - covered;
    // Towards the key: how far the ray passes from the finger, against how far it has gone.
    float ahead = max(dot(nearestOnFinger(i, p + to_key * 2.0 * r) - p, to_key), 0.0);
    vec3 pass = p + to_key * ahead;
    float clearance = distance(nearestOnFinger(i, pass), pass) - r;
    float penumbra = 0.17 * ahead + 1.0;
    float dark = ahead > 0.0 ? 0.72 * saturate(1.0 - ahead / min(220.0, 15.0 * r)) : 0.0;
    // A wide lamp: part of its light is lost where the ball is near.
    left.y *= (1.0 - dark * (1.0 - smoothstep(-penumbra, penumbra, clearance))) * (1.0 - 0.45 * covered);
  }
  return left;
}
)";

inline constexpr std::string_view kSkinVertex = R"(
out vec3 place;
out vec3 normal;
out vec3 rest;
out vec4 albedo;  // fourth: curvature
out float dent;   // share of light left there
#ifdef TOUCHED
out vec2 contour;  // depth under rest, mm; how much of the contours is seen
#endif
#ifdef PICTURE
out vec2 at;
#endif
void main() {
  place = placeHere();
  vec2 sunk = dentHere();
  float contrast = contrastAt(place, sunk);
  normal = normalHere(contrast);
  rest = rest_place;
  albedo = vec4(albedoHere(), tint.a);
  dent = lightLeftByDent(contrast, sunk);
#ifdef TOUCHED
  contour = vec2(sunk.x, helpAt(place, sunk) * min(dent_contrast, 1.0));
#endif
#ifdef PICTURE
  at = picture_place;
#endif
  gl_Position = clip_from_body * vec4(place, 1.0);
}
)";

/// Skin by its parts: wrapped diffuse light per channel (red travels farthest under the skin), a broad weak gloss, fine
/// lines as noises in rest coordinates, blood pressed away under the finger and returning, the finger's shadow.
/// Based on: Green, "Real-time approximations to subsurface scattering", GPU Gems, 2004; Penner, "Pre-integrated skin
/// shading", 2011.
inline constexpr std::string_view kSkinFragment = R"(
in vec3 place;
in vec3 normal;
in vec3 rest;
in vec4 albedo;
in float dent;
#ifdef TOUCHED
in vec2 contour;
#endif
out vec4 colour;

#ifdef PICTURE
in vec2 at;
uniform sampler2D picture;
uniform float made_white;
#endif

uniform float skin_opacity;
uniform float skin_scatter;
uniform float skin_sheen;
uniform int mark_count;
uniform vec4 mark[8];        // where the skin is or was pressed (rest coordinates) and the radius of the pad
uniform float mark_strength[8];

#ifdef PORES
// Skin lines: two families of furrows 0.7 mm apart that cross each other, and blotches of some millimetres. A noise's
// middle value is a net of closed curves; stretched it is a family of lines.
const float lines_per_mm = 1.45;
const mat3 one_way = mat3(0.870, 0.260, 0.240, 1.160, -0.215, 0.0, 0.870, 0.260, -0.240);
const mat3 other_way = mat3(-0.870, 0.260, 0.240, 1.160, 0.215, 0.0, -0.870, 0.260, -0.240);
const float blotches_per_mm = 0.33;
// Freckles, moles and the mouths of pores: balls in the cells of lattices that are turned, so that no grid lies along
// the body's axes.
const mat3 freckle_cells = 0.17 * mat3(0.80, 0.36, -0.48, -0.60, 0.48, -0.64, 0.0, 0.80, 0.60);
const float pores_per_mm = 0.75;
const mat3 pore_cells = pores_per_mm * mat3(0.60, -0.64, 0.48, 0.0, 0.60, 0.80, -0.80, -0.48, 0.36);

// Value noise: gradient and value. The lattice is hashed by products and fractions of small whole numbers, all four
// corners of a layer at once (after Sharpe, "A fast and simple 32bit floating point hash function", 2011); it repeats
// every 61 cells.
vec4 noiseAt(vec3 p) {
  const float period = 61.0;
  vec3 base = floor(p);
  vec3 t = p - base;
  vec3 s = t * t * (3.0 - 2.0 * t);
  vec3 ds = 6.0 * t * (1.0 - t);
  vec3 cell = base - floor(base / period) * period;
  vec3 next = mix(cell + 1.0, vec3(0.0), step(period - 1.5, cell));
  vec4 corners = vec4(cell.xy, next.xy) + vec4(37.0, 149.0, 37.0, 149.0);
  corners *= corners;
  corners = corners.xzxz * corners.yyww;  // 00, 10, 01, 11
  vec2 layer = 1.0 / (vec2(cell.z, next.z) * 41.713 + 587.243);
  vec4 lower = fract(corners * layer.x), upper = fract(corners * layer.y);
  vec4 low = vec4(lower.x, lower.z, upper.x, upper.z);
  vec4 step_x = vec4(lower.y, lower.w, upper.y, upper.w) - low;
  vec4 at_x = low + s.x * step_x;
  vec2 at_y = mix(at_x.xz, at_x.yw, s.y);
  vec2 slope_x = mix(step_x.xz, step_x.yw, s.y);
  vec2 slope_y = at_x.yw - at_x.xz;
  return vec4(ds * vec3(mix(slope_x.x, slope_x.y, s.z), mix(slope_y.x, slope_y.y, s.z), at_y.y - at_y.x),
              mix(at_y.x, at_y.y, s.z));
}

// A ball in the cell of a lattice, with a radius between two shares of the cell, smaller ones far more often.
// x: 1 in its middle, 0 outside; y: a random number of it.
vec2 spotAt(vec3 p, float least, float most) {
  const float period = 61.0;
  vec3 base = floor(p);
  vec3 cell = base - floor(base / period) * period;
  float mixed = fract(dot(cell, vec3(0.7548777, 0.5698403, 0.3819660)));
  vec3 random = fract(mixed * (mixed + 0.37) * vec3(613.0, 757.3, 977.1));
  float size = fract(random.x * 37.7 + random.y * 11.3);
  float radius = mix(least, most, size * size * size);
  float away = distance(p - base, most + random * (1.0 - 2.0 * most));
  return vec2(1.0 - smoothstep(0.5 * radius, radius, away), size);
}

// How much of a net is seen: its cells must be some pixels wide, else it shimmers or looks like the peel of an orange.
float visibleShare(float mm_per_pixel, float per_mm) { return 1.0 - smoothstep(0.11, 0.24, mm_per_pixel * per_mm); }

// Slope (xyz) and height below the ridges (w, 0 to 1 in the furrow).
vec4 furrowRelief(vec4 noise) {
  float side = noise.w - 0.5;
  float within = saturate(1.0 - abs(side) * 7.0);
  return vec4(noise.xyz * (sign(side) * within), within * within);
}
#endif

// Paler where the blood is pressed away, redder round it.
vec3 blanched(vec3 skin) {
  float pale = 0.0, rim = 0.0;
  for (int i = 0; i < mark_count; ++i) {
    float away = distance(rest, mark[i].xyz) / mark[i].w;
    pale = max(pale, mark_strength[i] * (1.0 - smoothstep(0.35, 1.05, away)));
    rim = max(rim, mark_strength[i] * (1.0 - smoothstep(1.15, 2.3, away)));
  }
  float grey = dot(skin, vec3(0.2126, 0.7152, 0.0722));
  skin *= mix(vec3(1.0), vec3(1.0, 0.86, 0.85), rim * (1.0 - pale));
  return mix(skin, 1.18 * grey * vec3(1.16, 0.97, 0.83), 0.6 * pale);
}

void main() {
  vec3 to_eye = normalize(eye - place);
  vec3 smooth_normal = normalize(gl_FrontFacing ? normal : -normal);
  vec3 detailed = smooth_normal;
#ifdef PICTURE
  vec3 skin = texture(picture, at).rgb * (made_white > 0.0 ? made_white * albedo.rgb : vec3(1.0));
#else
  vec3 skin = albedo.rgb;
#endif
  // What is too small to be seen makes the gloss wider instead.
  float broad = 0.60, narrow = 0.46;
#ifdef PORES
  {
    vec3 across = fwidth(rest);
    float mm_per_pixel = max(across.x, max(across.y, across.z));
    float seen = visibleShare(mm_per_pixel, lines_per_mm);
    vec4 one = furrowRelief(noiseAt(one_way * rest));
    vec4 other = furrowRelief(noiseAt(other_way * rest + 17.3));
    vec3 slope = 0.11 * seen * (one.xyz * one_way + other.xyz * other_way);
    slope -= smooth_normal * dot(slope, smooth_normal);
    detailed = normalize(smooth_normal - slope);
    float blotch = noiseAt(blotches_per_mm * rest).w - 0.5;
    skin *= 1.0 - 0.06 * seen * max(one.w, other.w);
    skin *= vec3(1.0) + vec3(0.06, 0.13, 0.12) * (blotch * visibleShare(mm_per_pixel, 2.0 * blotches_per_mm));
    // Pigment in spots shows on light skin; in dark skin there is as much of it everywhere.
    vec2 freckle = spotAt(freckle_cells * rest, 0.06, 0.24);
    float pigment = freckle.x * (0.25 + 0.45 * freckle.y * freckle.y) * (0.3 + 0.7 * skin_scatter * skin_scatter);
    skin *= 1.0 - vec3(0.45, 0.68, 0.85) * (pigment * visibleShare(mm_per_pixel, 0.65));
    float pore = spotAt(pore_cells * rest, 0.12, 0.26).x;
    skin *= 1.0 - vec3(0.13, 0.19, 0.20) * (pore * visibleShare(mm_per_pixel, pores_per_mm));
    narrow -= 0.06 * seen;
  }
#endif
#ifdef TOUCHED
  skin = blanched(skin);
  vec2 left = lightLeftByFingers(place, smooth_normal);
#else
  const vec2 left = vec2(1.0);
#endif
  float facing = saturate(dot(smooth_normal, to_eye));
  float slant = 1.0 - facing;
  float slant3 = slant * slant * slant;
  // Light that went under the skin knows no fine relief: half of it is taken by the smooth normal.
  vec3 half_smooth = normalize(smooth_normal + detailed);
  vec3 light = skinLight(half_smooth, wrapAmount(albedo.a, skin_scatter), left.y * dent, left.x * dent);
  // At the edge thin skin lets light through, and the light behind the body is seen in its down.
  light += (vec3(0.16, 0.07, 0.05) * skin_scatter + rim_light * (0.5 + 0.5 * smooth_normal.y)) * (slant3 * left.x);
  float gloss_of_key = specularGloss(detailed, to_key, to_eye, broad, narrow);
  float gloss_of_sky = 0.015 + 0.10 * slant3 * slant;
  vec3 seen_colour = skin * light + key_light * (left.y * dent * skin_sheen * gloss_of_key) +
                     ambientFrom(reflect(-to_eye, detailed)) * (left.x * dent * skin_sheen * gloss_of_sky);
  if (!gl_FrontFacing) seen_colour *= 0.5;
  vec3 shown = encoded(toned(seen_colour));
#ifdef TOUCHED
  shown = contoured(shown, contour);
#endif
  colour = vec4(shown, opacityAt(facing, skin_opacity));
}
)";

/// A field as colours: no tone curve, no gloss. Light takes at most a quarter, nothing where the skin faces the eye, so
/// that a colour can be looked up on its legend.
inline constexpr std::string_view kFieldVertex = R"(
uniform float low;
uniform float per_unit;
uniform float strain_percent;  // 1: the field is the strain, 0: it is `value`
out float share;
out float brightness;
out float facing;
void main() {
  vec3 place = placeHere();
  gl_Position = clip_from_body * vec4(place, 1.0);
  vec3 normal = vec3(nx, ny, nz);
  share = ((strain_percent > 0.0 ? 100.0 * strain : value) - low) * per_unit;
  // Dents must still be seen: what turns away from the key darkens; what faces the eye is at full colour.
  float lit = dot(normal, to_key) / max(dot(backward, to_key), 0.2);
  brightness = 0.75 + 0.25 * saturate(lit);
  facing = abs(dot(normal, normalize(eye - place)));
}
)";
inline constexpr std::string_view kFieldFragment = R"(
in float share;
in float brightness;
in float facing;
uniform sampler2D colour_map;
uniform float texels;
uniform vec3 no_value;
uniform float skin_opacity;
out vec4 colour;
void main() {
  float at = (saturate(share) * (texels - 1.0) + 0.5) / texels;
  vec3 mapped = share == share ? texture(colour_map, vec2(at, 0.5)).rgb : no_value;
  colour = vec4(mapped * min(brightness, 1.0), opacityAt(saturate(facing), skin_opacity));
}
)";

}  // namespace palpate::view
