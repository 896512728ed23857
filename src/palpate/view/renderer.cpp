#include "palpate/view/renderer.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "palpate/scene/world.h"
#include "palpate/view/layers/bone_layer.h"
#include "palpate/view/layers/drawn_skin.h"
#include "palpate/view/layers/finger_layer.h"
#include "palpate/view/layers/gl_objects.h"
#include "palpate/view/layers/line_layer.h"
#include "palpate/view/layers/skin_layer.h"
#include "palpate/view/layers/skin_paint.h"
#include "palpate/view/overlays/overlays.h"

namespace palpate::view {

namespace {

// Whether two worlds differ only in what lies on the body: stiffness, ellipses, force law, deformation.

/// The same skin, bones and texture, vertex by vertex, as scene::rebuilt leaves them. A few ms for a million
/// triangles.
bool haveSameBody(const scene::World& a, const scene::World& b);

namespace {

bool areSame(const mesh::TriangleMesh& a, const mesh::TriangleMesh& b) {
  return a.triangles == b.triangles && a.positions == b.positions;
}

}  // namespace

bool haveSameBody(const scene::World& a, const scene::World& b) {
  const auto same_bone = [](const body::Bone& p, const body::Bone& q) { return areSame(p.mesh, q.mesh); };
  return a.texture == b.texture && areSame(a.skin, b.skin) &&
         std::equal(a.anatomy.bones.begin(), a.anatomy.bones.end(), b.anatomy.bones.begin(), b.anatomy.bones.end(),
                    same_bone);
}

}  // namespace

namespace {

// What lies behind the body: a soft grey gradient, or white paper.

class Background {
 public:
  Background();
  /// Fills what is still empty of the viewport: where the depth is that of the far plane.
  void draw(bool white) const;

 private:
  Program program_;
  GlVertexArray
      nothing_;  // a core context draws nothing without a vertex array, not even vertices made of their number
};

namespace {

// Rows of quads that cover the picture; the colour is worked out at their corners, neutral grey so that colours read
// true, a little lighter behind the body.
constexpr std::string_view kVertex = R"(
uniform float white;
out vec3 corner_grey;
const int columns = 16;
void main() {
  int quad = gl_VertexID / 6, corner = gl_VertexID % 6;
  ivec2 at = ivec2(quad % columns, quad / columns);
  at += ivec2(corner == 1 || corner == 2 || corner == 4, corner == 2 || corner >= 4);
  vec2 place = vec2(at) * (2.0 / float(columns)) - 1.0;
  vec3 grey = mix(vec3(0.285, 0.290, 0.300), vec3(0.125, 0.130, 0.142), 0.5 + 0.5 * place.y);
  grey += 0.045 * exp(-1.2 * dot(place, place));
  corner_grey = mix(grey, vec3(1.0), white);
  gl_Position = vec4(place, 1.0, 1.0);
}
)";
constexpr GLsizei kVertices = 6 * 16 * 16;

// A fixed pattern hides the steps of 8 bits.
constexpr std::string_view kFragment = R"(
in vec3 corner_grey;
out vec4 colour;
void main() {
  float noise = fract(dot(gl_FragCoord.xy, vec2(0.7548777, 0.5698403)));
  colour = vec4(corner_grey + (noise - 0.5) * (1.0 / 255.0), 1.0);
}
)";

}  // namespace

Background::Background() : program_("background", "", kVertex, kFragment) {}

void Background::draw(bool white) const {
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);  // it lies on the far plane
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  program_.use();
  program_.set("white", white ? 1.0f : 0.0f);
  glBindVertexArray(nothing_.get());
  glDrawArrays(GL_TRIANGLES, 0, kVertices);
  glDepthFunc(GL_LESS);
}

}  // namespace

namespace {

constexpr double kWireframePx = 0.8;

std::vector<Press> pressesOf(std::span<const FingerMark> fingers) {
  std::vector<Press> presses;
  for (const FingerMark& finger : fingers) {
    if (finger.contact.touch == contact::Touch::free) continue;
    presses.push_back({finger.contact.anchor, finger.radius_mm, finger.contact.depth_mm});
  }
  return presses;
}

/// A mirrored display turns triangles inside out: keep fronts in front.
void setWinding(const Frustum& frustum) {
  const Mat4f clip = frustum.clip();
  Eigen::Matrix3f seen;
  seen << clip.block<1, 3>(0, 0), clip.block<1, 3>(1, 0), clip.block<1, 3>(3, 0);
  glFrontFace(seen.determinant() < 0.0f ? GL_CCW : GL_CW);
}

}  // namespace

struct Renderer::Parts {
  std::shared_ptr<const scene::World> world;
  Background background;
  SkinLayer skin;
  BoneLayer bones;
  FingerLayer fingers;
  LineLayer lines;
  std::optional<Overlays> overlays;
  DrawnSkin drawn;
  Blanching blanching;
  std::vector<FingerPose> poses;
  std::vector<HandPose> hands;  // of the poses, when hands are drawn

  void setWorld(std::shared_ptr<const scene::World> next) {
    if (world && haveSameBody(*world, *next)) {
      skin.setMapsOf(*next);
      bones.setSameBody(*next);
    } else {
      skin.setWorld(*next);
      bones.setWorld(*next);
    }
    overlays.emplace(*next);
    blanching = {};
    world = std::move(next);
  }

  void poseFingers(const Frame& frame, const Look& look) {
    poses.clear();
    hands.clear();
    if (look.finger == FingerShape::none) return;
    for (const FingerMark& finger : frame.fingers) poses.push_back(poseOf(*world, drawn, finger));
    for (FingerPose& pose : poses) pose.outline *= frame.pixels_per_point;
    if (look.finger != FingerShape::hand) return;
    for (FingerPose& pose : poses) {
      hands.push_back(fingers.handPose(*world, pose));
      pose.tail = pose.centre - kFingerMm * hands.back().axes.col(1);
    }
  }

  void drawFingers(const Look& look, const Viewpoint& viewpoint) {
    if (look.finger == FingerShape::sphere) fingers.drawBalls(poses, viewpoint);
    for (std::size_t i = 0; i < hands.size(); ++i) fingers.drawHand(poses[i], hands[i], viewpoint);
  }

  /// What hides comes first where nothing shines through, so that hidden pixels are never shaded; transparent skin
  /// comes last, over what it covers.
  void drawBody(const Look& look, const Viewpoint& viewpoint, std::span<const PressMark> marks) {
    const bool opaque = look.skin_opacity >= 1.0;
    if (opaque) skin.draw(look, viewpoint, {poses, marks});
    drawFingers(look, viewpoint);
    bones.draw(look, viewpoint);
    background.draw(look.white_background);
    if (!opaque) skin.draw(look, viewpoint, {poses, marks});
  }

  void drawOverlays(const Frame& frame, const Look& look, const Viewpoint& viewpoint) {
    if (look.shows(Overlay::wireframe)) {
      skin.buffers().bindEdges();
      lines.drawEdges(viewpoint, kWireframePx * frame.pixels_per_point, kWireframePaint,
                      [&] { skin.buffers().drawEdges(); });
    }
    const OverlayShapes& shapes = overlays->shapes(look, drawn, frame.fingers);
    lines.draw(shapes.patches, viewpoint);
    lines.draw(shapes.thin, viewpoint, frame.pixels_per_point);
    lines.draw(shapes.bold, viewpoint, frame.pixels_per_point);
    for (const Lines& marks : frame.marks) lines.draw(marks, viewpoint, frame.pixels_per_point);
  }
};

Renderer::Renderer(std::shared_ptr<const scene::World> world) : parts_(std::make_unique<Parts>()) {
  setWorld(std::move(world));
}
Renderer::~Renderer() = default;

void Renderer::setWorld(std::shared_ptr<const scene::World> world) {
  parts_->setWorld(std::move(world));
  updateAll(deform::DeformedSurface(parts_->world->deformable));
}

Index Renderer::update(const deform::DeformedSurface& surface) {
  parts_->drawn.follow(surface);
  return parts_->skin.buffers().update(surface);
}

void Renderer::updateAll(const deform::DeformedSurface& surface) {
  parts_->drawn.copyAll(surface);
  parts_->skin.buffers().updateAll(surface);
}

void Renderer::setField(Colouring colouring, std::span<const float> values) {
  parts_->skin.buffers().setField(colouring, values);
}

void Renderer::setPartition(std::shared_ptr<const hdb::Partition> partition, const Vec3& box_edges_mm) {
  parts_->overlays->setPartition({std::move(partition), box_edges_mm});
}

void Renderer::draw(const Frame& frame, const Look& look, const Frustum& frustum, int width, int height) {
  const Viewpoint viewpoint = viewpointOf(frustum, width, height);
  parts_->poseFingers(frame, look);
  const auto marks = parts_->blanching.at(frame.time_s, pressesOf(frame.fingers));
  glDepthMask(GL_TRUE);
  glClear(GL_DEPTH_BUFFER_BIT);
  setWinding(frustum);
  parts_->drawBody(look, viewpoint, marks);
  parts_->drawOverlays(frame, look, viewpoint);
  glBindVertexArray(0);
  glFrontFace(GL_CCW);
}

}  // namespace palpate::view
