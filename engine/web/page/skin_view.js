// The skin as it is drawn: one buffer of place, normal and strain that the frames of a source change in part, coloured in
// the shader, so that another colouring costs nothing.
import * as THREE from './three.module.min.js';
import { FLOATS_OF_VERTEX } from './engine.js';

export const COLOURINGS = ['plain', 'strain', 'stiffness'];

// Two lights that go with the camera and a little from everywhere; light wraps round the skin and reddens where it ends.
const LIGHT = `
uniform sampler2D strain_map;
uniform sampler2D stiffness_map;
uniform int colouring;
uniform float opacity;
uniform vec3 skin;
vec4 lit_skin(vec3 n, vec3 v, float value, float light_left) {
  vec3 base = skin * light_left;
  float gloss = 0.10;
  if (colouring != 0) {
    vec4 mapped = colouring == 1 ? texture(strain_map, vec2(value, 0.5)) : texture(stiffness_map, vec2(value, 0.5));
    base = pow(mapped.rgb, vec3(2.2)) * 0.85 * light_left;
    gloss = 0.03;
  }
  vec3 key = normalize(vec3(-0.45, 0.62, 0.64));
  vec3 fill = normalize(vec3(0.75, -0.1, 0.5));
  float k = dot(n, key);
  vec3 wrap = colouring == 0 ? vec3(0.34, 0.16, 0.12) : vec3(0.15);
  vec3 lit = max((vec3(k) + wrap) / (1.0 + wrap), 0.0) * 1.05;
  lit += vec3(0.30, 0.33, 0.38) * max(dot(n, fill), 0.0) + vec3(0.16, 0.17, 0.19) * (0.6 + 0.4 * n.y);
  float shine = pow(max(dot(n, normalize(key + v)), 0.0), 24.0);
  vec3 light = base * lit + vec3(gloss) * shine;
  float rim = 1.0 - max(dot(n, v), 0.0);
  float seen = opacity < 1.0 ? opacity + (1.0 - opacity) * rim * rim * 0.7 : 1.0;
  return vec4(pow(light, vec3(1.0 / 2.2)), seen);
}`;

// What the walls of a dent leave of the light; less where it is small in the picture, as in the viewer
// (engine/view/palpate/view/layers/skin_shader.h).
const DENT = `
in vec3 rest;
uniform float picture_height;
float light_left_by_dent(vec3 seen, vec3 n) {
  float points_a_mm = projectionMatrix[1][1] * picture_height / (2.0 * max(1.0, -seen.z));
  float contrast = 2.2 - 1.2 * smoothstep(1.25, 5.0, points_a_mm);
  return 1.0 - min(0.9, 0.34 * contrast) * smoothstep(0.2, 9.0, dot(normalMatrix * (rest - position), n));
}`;

const VERTEX = `
${DENT}
in float strain;
in float stiffness;
uniform vec2 stiffness_range;
uniform float strain_range;
#ifdef BY_VERTEX
${LIGHT}
out vec4 lit;
#else
uniform int colouring;
out vec3 at;
out vec3 outward;
out float value;
out float light_left;
#endif
void main() {
  float shown = colouring == 1 ? 0.5 + 0.5 * strain / strain_range
                               : (stiffness - stiffness_range.x) / max(1e-6, stiffness_range.y - stiffness_range.x);
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  vec3 n = normalize(normalMatrix * normal);
  float left = light_left_by_dent(seen.xyz, n);
#ifdef BY_VERTEX
  vec3 v = normalize(-seen.xyz);
  lit = lit_skin(dot(n, v) < -0.2 ? -n : n, v, shown, left); // at the rim normals may look a little away
#else
  value = shown;
  at = seen.xyz;
  outward = n;
  light_left = left;
#endif
  gl_Position = projectionMatrix * seen;
}`;

const FRAGMENT = `
out vec4 colour;
#ifdef BY_VERTEX
in vec4 lit;
void main() {
  colour = lit;
}
#else
${LIGHT}
in vec3 at;
in vec3 outward;
in float value;
in float light_left;
void main() {
  vec3 n = normalize(outward);
  colour = lit_skin(gl_FrontFacing ? n : -n, normalize(-at), value, light_left);
}
#endif`;

function mapOf(bytes) {
  const texture = new THREE.DataTexture(bytes, 256, 1, THREE.RGBAFormat);
  texture.minFilter = texture.magFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

/// Limits that leave out the last two per cent at each end, so that one vertex does not flatten all others.
function rangeOf(values) {
  if (!values || values.length === 0) return [0, 1];
  const sorted = Float32Array.from(values).sort();
  const low = sorted[Math.floor(0.02 * (sorted.length - 1))];
  const high = sorted[Math.floor(0.98 * (sorted.length - 1))];
  return high - low > 1e-3 ? [low, high] : [0.8 * low, 1.2 * high + 1e-3];
}

export class SkinView {
  /// `by_vertex`: lit there, which is a third of the work where the processor draws.
  constructor(body, by_vertex = false) {
    const vertices = body.rest.length / FLOATS_OF_VERTEX;
    this.buffer = new THREE.InterleavedBuffer(body.rest.slice(), FLOATS_OF_VERTEX);
    this.buffer.setUsage(THREE.DynamicDrawUsage);
    const part = (size, offset) => new THREE.InterleavedBufferAttribute(this.buffer, size, offset);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', part(3, 0));
    geometry.setAttribute('normal', part(3, 3));
    geometry.setAttribute('strain', part(1, 6));
    geometry.setAttribute('stiffness', new THREE.BufferAttribute(body.stiffness ?? new Float32Array(vertices), 1));
    geometry.setAttribute('rest', new THREE.InterleavedBufferAttribute(new THREE.InterleavedBuffer(body.rest, FLOATS_OF_VERTEX), 3, 0));
    geometry.setIndex(new THREE.BufferAttribute(body.corners, 1));
    geometry.computeBoundingSphere();
    this.material = new THREE.ShaderMaterial({
      glslVersion: THREE.GLSL3,
      defines: by_vertex ? { BY_VERTEX: 1 } : {},
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      side: body.closed ? THREE.FrontSide : THREE.DoubleSide,
      uniforms: {
        strain_map: { value: mapOf(body.colours.strain) },
        stiffness_map: { value: mapOf(body.colours.stiffness) },
        colouring: { value: 0 },
        opacity: { value: 1 },
        picture_height: { value: 600 }, // CSS pixels
        strain_range: { value: 0.2 },
        stiffness_range: { value: new THREE.Vector2(...rangeOf(body.stiffness)) },
        skin: { value: new THREE.Color(0.49, 0.272, 0.176) }, // the middle tone of the viewer (view/skin_tone.h), linear
      },
    });
    this.mesh = new THREE.Mesh(geometry, this.material);
    this.mesh.frustumCulled = false; // what is pressed leaves the sphere that was computed at rest
    this.mesh.renderOrder = 2; // after the bones, which show through
  }

  /// Takes what changed. Ranges of several frames between two pictures add up.
  take({ ranges, values }) {
    let from = 0;
    for (let i = 0; i < ranges.length; i += 2) {
      const start = ranges[i] * FLOATS_OF_VERTEX;
      const count = (ranges[i + 1] - ranges[i]) * FLOATS_OF_VERTEX;
      this.buffer.array.set(values.subarray(from, from + count), start);
      this.buffer.addUpdateRange(start, count);
      from += count;
    }
    if (ranges.length > 0) this.buffer.needsUpdate = true;
  }

  setStiffness(values) {
    const attribute = this.mesh.geometry.getAttribute('stiffness');
    attribute.array.set(values);
    attribute.needsUpdate = true;
    this.material.uniforms.stiffness_range.value.set(...rangeOf(values));
  }
  setColouring(name) {
    this.material.uniforms.colouring.value = COLOURINGS.indexOf(name);
  }
  setPictureHeight(pixels) {
    this.material.uniforms.picture_height.value = pixels;
  }
  setOpacity(opacity) {
    this.material.uniforms.opacity.value = opacity;
    this.material.transparent = opacity < 1;
    this.material.needsUpdate = true;
  }
  /// Low and high end of what is shown, in its unit.
  range(name) {
    const { stiffness_range, strain_range } = this.material.uniforms;
    if (name === 'strain') return [-100 * strain_range.value, 100 * strain_range.value];
    return [stiffness_range.value.x, stiffness_range.value.y];
  }

  dispose() {
    this.mesh.geometry.dispose();
    this.material.uniforms.strain_map.value.dispose();
    this.material.uniforms.stiffness_map.value.dispose();
    this.material.dispose();
  }
}
