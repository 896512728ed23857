#include "palpate/view/renderer.h"

#include <vector>

#include "palpate/view/background.h"
#include "palpate/view/blanching.h"
#include "palpate/view/bone_layer.h"
#include "palpate/view/drawn_skin.h"
#include "palpate/view/finger_layer.h"
#include "palpate/view/skin_layer.h"

namespace palpate::view {

struct Renderer::Parts {
  std::shared_ptr<const scene::World> world;
  Background background;
  SkinLayer skin;
  BoneLayer bones;
  FingerLayer fingers;
  DrawnSkin drawn;
  Blanching blanching;
  std::vector<FingerPose> poses;
  std::vector<Press> presses;

  explicit Parts(std::shared_ptr<const scene::World> w) : world(std::move(w)), skin(*world), bones(*world) {}
};

Renderer::Renderer(std::shared_ptr<const scene::World> world) : parts_(std::make_unique<Parts>(std::move(world))) {
  updateAll(deform::DeformedSurface(parts_->world->deformable));
}
Renderer::~Renderer() = default;

Index Renderer::update(const deform::DeformedSurface& surface) {
  for (const deform::VertexRange& range : surface.changed()) parts_->drawn.copy(surface, range);
  return parts_->skin.update(surface);
}

void Renderer::updateAll(const deform::DeformedSurface& surface) {
  parts_->drawn.copy(surface, {0, surface.vertices()});
  parts_->skin.updateAll(surface);
}

namespace {

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

void Renderer::draw(const Frame& frame, const Look& look, const Frustum& frustum, int width, int height) {
  Parts& p = *parts_;
  const Viewpoint viewpoint = viewpointOf(frustum, width, height);
  p.poses.clear();
  for (const FingerMark& finger : frame.fingers) p.poses.push_back(poseOf(*p.world, p.drawn, finger));
  const bool with_fingers = look.finger != FingerShape::none;
  const std::span<const FingerPose> poses =
      with_fingers ? std::span<const FingerPose>(p.poses) : std::span<const FingerPose>();
  const auto marks = p.blanching.at(frame.time_s, pressesOf(frame.fingers));

  glDepthMask(GL_TRUE);
  glClear(GL_DEPTH_BUFFER_BIT);
  p.background.draw(look.white_background);
  setWinding(frustum);
  // Nearest first where nothing shines through: hidden pixels are never shaded.
  if (look.skin_opacity >= 1.0) p.skin.draw(look, viewpoint, {poses, marks});
  p.fingers.drawBalls(poses, viewpoint);
  p.bones.draw(look, viewpoint);
  if (look.skin_opacity < 1.0) p.skin.draw(look, viewpoint, {poses, marks});
  glBindVertexArray(0);
  glFrontFace(GL_CCW);
}

}  // namespace palpate::view
