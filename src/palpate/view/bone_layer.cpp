#include "palpate/view/bone_layer.h"

#include <cstddef>
#include <vector>

#include "palpate/mesh/normals.h"
#include "palpate/partition/triangle_tree.h"
#include "palpate/view/shared_shader.h"

namespace palpate::view {

namespace {

struct BoneVertex {
  Vec3f place;
  Vec3f normal;
  float depth_mm;  // to the nearest skin at rest
};

/// Bones farther from any skin look as if they were this far.
constexpr double kDeepestMm = 80.0;

constexpr std::string_view kVertex = R"(
layout(location = 0) in vec3 place_in;
layout(location = 1) in vec3 normal_in;
layout(location = 2) in float depth_in;
out vec3 place;
out vec3 normal;
out float depth;
void main() {
  place = place_in;
  normal = normal_in;
  depth = depth_in;
  gl_Position = clip_from_body * vec4(place, 1.0);
}
)";

// Flesh takes blue and green first (per mm of the way through it).
constexpr std::string_view kFragment = R"(
in vec3 place;
in vec3 normal;
in float depth;
uniform float skin_opacity;
out vec4 colour;
const vec3 ivory = vec3(0.78, 0.70, 0.55);
const vec3 absorbed_per_mm = vec3(0.011, 0.030, 0.036);
void main() {
  vec3 n = normalize(normal);
  vec3 to_eye = normalize(eye - place);
  float facing = saturate(dot(n, to_eye));
  vec3 light = ivory * matteLight(n, 0.8) * (0.55 + 0.45 * facing);
  light += 0.6 * key_light * gloss(n, to_key, to_eye, 0.5, 0.04);
  float under_skin = smoothstep(0.0, 0.25, skin_opacity);
  light *= exp(-absorbed_per_mm * (depth * under_skin));
  colour = vec4(encoded(toned(0.45 * light)), 1.0);
}
)";

void append(const body::Bone& bone, const scene::World& world, std::vector<BoneVertex>& vertices,
            std::vector<Triangle>& triangles) {
  const auto base = static_cast<Index>(vertices.size());
  const std::vector<Vec3> normals = mesh::vertexNormals(bone.mesh);
  for (std::size_t v = 0; v < normals.size(); ++v) {
    const Vec3& place = bone.mesh.positions[v];
    const auto nearest = partition::nearestPoint(world.surface.tree, place, kDeepestMm);
    const double depth = nearest.triangle == kNoIndex ? kDeepestMm : std::sqrt(nearest.closest.squared_distance);
    vertices.push_back({place.cast<float>(), normals[v].cast<float>(), static_cast<float>(depth)});
  }
  for (const Triangle& t : bone.mesh.triangles) triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
}

void pointAt(GLuint location, GLint size, std::size_t offset) {
  glEnableVertexAttribArray(location);
  glVertexAttribPointer(location, size, GL_FLOAT, GL_FALSE, sizeof(BoneVertex), reinterpret_cast<const void*>(offset));
}

}  // namespace

BoneLayer::BoneLayer(const scene::World& world) : program_("bones", kSharedShader, kVertex, kFragment) {
  std::vector<BoneVertex> vertices;
  std::vector<Triangle> triangles;
  for (const body::Bone& bone : world.anatomy.bones) append(bone, world, vertices, triangles);
  indices_ = static_cast<Index>(3 * triangles.size());
  glBindVertexArray(vertex_array_.get());
  fillBuffer<Triangle>(GL_ELEMENT_ARRAY_BUFFER, triangles_.get(), triangles);
  fillBuffer<BoneVertex>(GL_ARRAY_BUFFER, vertices_.get(), vertices);
  pointAt(0, 3, offsetof(BoneVertex, place));
  pointAt(1, 3, offsetof(BoneVertex, normal));
  pointAt(2, 1, offsetof(BoneVertex, depth_mm));
  glBindVertexArray(0);
}

void BoneLayer::draw(const Look& look, const Viewpoint& viewpoint) const {
  if (empty()) return;
  program_.use();
  setViewpoint(program_, viewpoint);
  program_.set("skin_opacity", static_cast<float>(look.skin_opacity));
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
  glBindVertexArray(vertex_array_.get());
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(indices_), GL_UNSIGNED_INT, nullptr);
  glDisable(GL_CULL_FACE);
}

}  // namespace palpate::view
