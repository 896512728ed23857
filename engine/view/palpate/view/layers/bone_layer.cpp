// Bones with the way to the nearest skin at each vertex, so that the shader can darken them by the flesh before them.
// The tree decides whether skin hides a bone, by a segment from the eye to every tenth vertex.
#include "palpate/view/layers/bone_layer.h"

#include <cstddef>
#include <vector>

#include "palpate/mesh/triangle_mesh.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::view {

namespace {

struct BoneVertex {
  Vec3f place;
  Vec3f normal;
  Vec3f to_skin;  // to the nearest skin at rest, mm
};

/// Bones farther from any skin than this are invisible.
constexpr double kDeepestMm = 150.0;

constexpr std::string_view kBoneVertex = R"(
layout(location = 0) in vec3 place_in;
layout(location = 1) in vec3 normal_in;
layout(location = 2) in vec3 to_skin;
out vec3 place;
out vec3 normal;
out float depth;
void main() {
  place = place_in;
  normal = normal_in;
  // Flesh lies between the bone and the eye where the nearest skin is on the eye's side.
  depth = min(length(to_skin), 45.0);
  depth *= smoothstep(-0.2, 0.5, dot(to_skin, normalize(eye - place)) / max(length(to_skin), 1e-3));
  gl_Position = clip_from_body * vec4(place, 1.0);
}
)";

// One ivory: flesh over a bone takes light, of all colours alike, for the skin that is seen with it gives it its hue.
constexpr std::string_view kBoneFragment = R"(
in vec3 place;
in vec3 normal;
in float depth;
uniform float skin_opacity;
out vec4 colour;
const vec3 ivory = vec3(0.76, 0.69, 0.56);
void main() {
  vec3 n = normalize(normal);
  vec3 to_eye = normalize(eye - place);
  float facing = saturate(dot(n, to_eye));
  vec3 light = ivory * matteLight(n, 0.9) * (0.55 + 0.45 * facing);
  light += key_light * (0.7 * specularGloss(n, to_key, to_eye, 0.6, 0.45));
  float under_skin = smoothstep(0.0, 0.25, skin_opacity);
  light *= 1.0 - under_skin * (0.5 - 0.5 * exp(-0.05 * depth));
  colour = vec4(encoded(toned(light)), 1.0);
}
)";

void append(const body::Bone& bone, const scene::World& world, std::vector<BoneVertex>& vertices,
            std::vector<Triangle>& triangles) {
  const auto base = static_cast<Index>(vertices.size());
  const std::vector<Vec3> normals = mesh::vertexNormals(bone.mesh);
  for (std::size_t v = 0; v < normals.size(); ++v) {
    const Vec3& place = bone.mesh.positions[v];
    const auto nearest = tree::nearestPoint(world.surface.geometry->tree, place, kDeepestMm);
    const Vec3 to_skin = nearest.triangle == kNoIndex ? Vec3(Vec3::Zero()) : Vec3(nearest.closest.point - place);
    vertices.push_back(
        {(place - world.deformable->origin).cast<float>(), normals[v].cast<float>(), to_skin.cast<float>()});
  }
  for (const Triangle& t : bone.mesh.triangles) triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
}

}  // namespace

BoneLayer::BoneLayer() : program_("bones", kSharedShader, kBoneVertex, kBoneFragment) {
  glBindVertexArray(vertex_array_.get());
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, triangles_.get());
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.get());
  attributeAt(0, 3, GL_FLOAT, sizeof(BoneVertex), offsetof(BoneVertex, place));
  attributeAt(1, 3, GL_FLOAT, sizeof(BoneVertex), offsetof(BoneVertex, normal));
  attributeAt(2, 3, GL_FLOAT, sizeof(BoneVertex), offsetof(BoneVertex, to_skin));
  glBindVertexArray(0);
}

void BoneLayer::setWorld(const scene::World& world) {
  world_ = &world;
  hidden_from_.setConstant(std::numeric_limits<float>::quiet_NaN());
  bones_.clear();
  std::vector<BoneVertex> vertices;
  std::vector<Triangle> triangles;
  for (const body::Bone& bone : world.body->anatomy.bones) {
    const auto first = static_cast<Index>(3 * triangles.size());
    append(bone, world, vertices, triangles);
    bones_.push_back({first, static_cast<Index>(3 * triangles.size()) - first});
  }
  glBindVertexArray(vertex_array_.get());
  fillBuffer<Triangle>(GL_ELEMENT_ARRAY_BUFFER, triangles_.get(), triangles);
  fillBuffer<BoneVertex>(GL_ARRAY_BUFFER, vertices_.get(), vertices);
  glBindVertexArray(0);
}

/// A bone is hidden when the skin at rest is before every tenth of its vertices; a dent uncovers none.
void BoneLayer::findHidden(const Vec3f& eye) {
  constexpr std::size_t kStride = 10;
  hidden_from_ = eye;
  for (std::size_t b = 0; b < bones_.size(); ++b) {
    const std::vector<Vec3>& points = world_->body->anatomy.bones[b].mesh.positions;
    bones_[b].hidden = true;
    for (std::size_t v = 0; v < points.size() && bones_[b].hidden; v += kStride) {
      const auto skin = tree::firstFrontCrossing(world_->surface.geometry->tree,
                                                 world_->deformable->origin + eye.cast<double>(), points[v]);
      bones_[b].hidden = skin.triangle != kNoIndex;
    }
  }
}

void BoneLayer::draw(const Look& look, const Viewpoint& viewpoint) {
  if (bones_.empty()) return;
  const bool all = look.skin_opacity < 1.0;
  if (!all && hidden_from_ != viewpoint.eye) findHidden(viewpoint.eye);
  program_.use();
  setViewpoint(program_, viewpoint);
  program_.set("skin_opacity", static_cast<float>(look.skin_opacity));
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
  glBindVertexArray(vertex_array_.get());
  for (const Range& bone : bones_) {
    if (!all && bone.hidden) continue;
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(bone.count), GL_UNSIGNED_INT,
                   bufferOffset(bone.first * sizeof(Index)));
  }
  glDisable(GL_CULL_FACE);
}

}  // namespace palpate::view
