// The layers and the order they are drawn in (docs/explanation/rendering.md). It sets depth and winding of OpenGL's
// state; a layer turns on what it needs and leaves the depth test on, by "less", and blending and culling off. A
// world with the same body exchanges maps and keeps its buffers. Each picture.
#include "palpate/view/renderer.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "palpate/scene/world.h"
#include "palpate/view/drawn_skin.h"
#include "palpate/view/layers/bone_layer.h"
#include "palpate/view/layers/finger_layer.h"
#include "palpate/view/layers/gl_objects.h"
#include "palpate/view/layers/line_layer.h"
#include "palpate/view/layers/skin_dents.h"
#include "palpate/view/layers/skin_layer.h"
#include "palpate/view/layers/skin_paint.h"
#include "palpate/view/layers/support_layer.h"
#include "palpate/view/overlays/lump_marks.h"
#include "palpate/view/overlays/marks.h"
#include "palpate/view/overlays/overlays.h"

namespace palpate::view {

namespace {

constexpr double kWireframePx = 0.8;
/// Skin of a lighter tone gets a darker hand.
constexpr double kLightBody = 2.5;
/// A near plane behind the eye, mm: nothing fades.
constexpr double kNeverNear = -1e4;

FingerLayer::Form fingerForm(const Look& look) {
  return look.finger == FingerShape::hand ? FingerLayer::Form::hand : FingerLayer::Form::finger;
}

/// Presses on the skin at rest, from its origin.
std::vector<Press> collectPresses(const Frame& frame, const std::optional<body::BreathField>& breath,
                                  const Vec3& origin) {
  std::vector<Press> presses;
  for (const FingerMark& finger : frame.fingers) {
    if (finger.contact.touch == contact::Touch::free) continue;
    const Vec3& anchor = finger.contact.anchor;
    presses.push_back(
        {(breath ? breath->rest(anchor, frame.lift_mm) : anchor) - origin, finger.radius_mm, finger.contact.depth_mm});
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

struct Renderer::Impl {
  std::shared_ptr<const scene::World> world;
  Background background;
  SkinLayer skin;
  BoneLayer bones;
  SupportLayer support;
  FingerLayer fingers;
  LineLayer lines;
  std::optional<Overlays> overlays;
  DrawnSkin drawn;
  Blanching blanching;
  std::vector<FingerPose> poses;
  std::vector<HandPose> hands;  // per pose, unless balls are drawn
  std::vector<ShadowCaster> casters;
  const OverlayShapes* shown = nullptr;  // for the current picture

  void setWorld(std::shared_ptr<const scene::World> next) {
    if (world && world->body == next->body) {
      skin.updateMaps(*next);
      bones.setSameBody(*next);
    } else {
      skin.setWorld(*next);
      bones.setWorld(*next);
      support.setWorld(*next);
    }
    drawn.setBreath(skin.buffers().breathShares());
    overlays.emplace(*next);
    blanching = {};
    world = std::move(next);
  }

  /// Lumps are shown under translucent skin.
  Look seenLook(Look look) const {
    if (look.shows(Overlay::lumps) && !world->lumps.empty()) {
      look.skin_opacity = std::min(look.skin_opacity, kSkinOverLumps);
    }
    return look;
  }

  void poseFingers(const Frame& frame, const Look& look) {
    poses.clear();
    hands.clear();
    casters.clear();
    if (look.finger == FingerShape::none) return;
    for (const FingerMark& finger : frame.fingers) poses.push_back(computeFingerPose(*world, drawn, finger));
    for (FingerPose& pose : poses) pose.outline *= frame.pixels_per_point;
    if (look.finger != FingerShape::ball) {
      for (const FingerPose& pose : poses) hands.push_back(fingers.handPose(*world, fingerForm(look), pose));
    }
    countFromOrigin();
    if (look.finger == FingerShape::ball) {
      for (const FingerPose& pose : poses) {
        const Vec3f centre = pose.centre.cast<float>();
        casters.push_back({centre, centre, static_cast<float>(pose.radius_mm)});
      }
      return;
    }
    for (std::size_t i = 0; i < hands.size(); ++i) fingers.addCasters(fingerForm(look), poses[i], hands[i], casters);
  }

  /// Relative to the origin, like all data on the graphics card.
  void countFromOrigin() {
    const Vec3& origin = world->deformable->origin;
    for (FingerPose& pose : poses) pose.centre -= origin;
    for (HandPose& hand : hands) hand.origin -= origin;
  }

  void drawFingers(const Look& look, const Viewpoint& viewpoint) {
    if (look.finger == FingerShape::ball) fingers.drawBalls(poses, viewpoint);
    drawHands(look, viewpoint, FingerLayer::Part::opaque);
  }

  /// In another tone than the body, so that the two are distinguishable. A hand fades before it reaches the near plane,
  /// which leaves room for it; a finger is too short to reach it.
  void drawHands(const Look& look, const Viewpoint& viewpoint, FingerLayer::Part part) {
    const FingerLayer::Form form = fingerForm(look);
    const HandTones tones{.skin = look.skin_tone < kLightBody ? 4.0 : 2.0,
                          .near_mm = form == FingerLayer::Form::hand ? viewpoint.near_mm : kNeverNear};
    for (std::size_t i = 0; i < hands.size(); ++i) fingers.drawHand(form, poses[i], hands[i], tones, viewpoint, part);
  }

  /// True from outside an opaque skin without a border, unless the near plane cuts it open.
  bool hidesBones(const Look& look, const Viewpoint& viewpoint) {
    return look.skin_opacity >= 1.0 && world->body->closed &&
           skin.buffers().box().exteriorDistance(viewpoint.eye) > viewpoint.near_mm;
  }

  /// Opaque things come first, so that hidden pixels are never shaded; transparent skin comes last, over the rest.
  void drawBody(const Look& look, const Viewpoint& viewpoint, const SkinTouch& touch) {
    const bool opaque = look.skin_opacity >= 1.0;
    if (opaque) skin.draw(look, viewpoint, touch);
    drawFingers(look, viewpoint);
    if (!hidesBones(look, viewpoint)) bones.draw(look, viewpoint);
    const float support_opacity = support.opacityFor(look, viewpoint);
    if (support_opacity == 1.0f) support.draw(viewpoint, 1.0f);
    background.draw(look);
    if (!opaque) lines.draw(shown->solid, viewpoint, PatchDepth::solid);
    if (!opaque) skin.draw(look, viewpoint, touch);
    if (support_opacity < 1.0f) support.draw(viewpoint, support_opacity);  // seen from below, over the body
    drawHands(look, viewpoint, FingerLayer::Part::fading);
  }

  void drawOverlays(const Frame& frame, const Look& look, const Viewpoint& viewpoint) {
    if (look.shows(Overlay::wireframe)) {
      skin.buffers().bindEdges();
      lines.drawEdges(viewpoint, kWireframePx * frame.pixels_per_point, kWireframePaint,
                      [&] { skin.buffers().drawEdges(); });
    }
    const OverlayShapes& shapes = *shown;
    lines.draw(shapes.patches, viewpoint);
    lines.draw(shapes.thin, viewpoint, frame.pixels_per_point);
    lines.draw(shapes.bold, viewpoint, frame.pixels_per_point);
    lines.draw(shapes.seen_through, viewpoint, PatchDepth::seen_through);
    for (const Lines& marks : frame.marks) lines.draw(marks, viewpoint, frame.pixels_per_point);
  }
};

Renderer::Renderer(std::shared_ptr<const scene::World> world) : impl_(std::make_unique<Impl>()) {
  setWorld(std::move(world));
}
Renderer::~Renderer() = default;

void Renderer::setWorld(std::shared_ptr<const scene::World> world) {
  impl_->setWorld(std::move(world));
  updateAll(deform::DeformedSurface(*impl_->world->deformable));
}

Index Renderer::update(const deform::DeformedSurface& surface) {
  impl_->drawn.follow(surface);
  return impl_->skin.buffers().update(surface);
}

void Renderer::updateAll(const deform::DeformedSurface& surface) {
  impl_->drawn.copyAll(surface);
  impl_->skin.buffers().updateAll(surface);
}

void Renderer::setField(Colouring colouring, std::span<const float> values) {
  impl_->skin.buffers().setField(colouring, values);
}

void Renderer::setPartition(std::shared_ptr<const hdb::Partition> partition, const Vec3& box_edges_mm) {
  impl_->overlays->setPartition({std::move(partition), box_edges_mm});
}

void Renderer::draw(const Frame& frame, const Look& look, const Frustum& frustum, int width, int height,
                    const Frustum* lit_as) {
  const Look seen = impl_->seenLook(look);
  Viewpoint viewpoint = makeViewpoint(frustum, width, height, impl_->world->deformable->origin);
  if (lit_as != nullptr) viewpoint.lights = lightsFor(*lit_as);
  viewpoint.lift_mm = static_cast<float>(frame.lift_mm);
  viewpoint.pixels_per_point = static_cast<float>(frame.pixels_per_point);
  impl_->drawn.lift(viewpoint.lift_mm);
  impl_->poseFingers(frame, seen);
  const auto marks = impl_->blanching.at(frame.time_s, collectPresses(frame, impl_->world->breath, viewpoint.origin));
  const std::vector<SkinDent> dents = collectDents(frame.fingers, *impl_->world, frame.lift_mm);
  glDepthMask(GL_TRUE);
  glClear(GL_DEPTH_BUFFER_BIT);
  setWinding(frustum);
  impl_->shown = &impl_->overlays->shapes(seen, impl_->drawn, frame.fingers);
  impl_->drawBody(seen, viewpoint, {impl_->casters, marks, dents});
  impl_->drawOverlays(frame, seen, viewpoint);
  glBindVertexArray(0);
  glFrontFace(GL_CCW);
}

}  // namespace palpate::view
