// Oracles that need no stored picture: what is drawn is compared with what must be true of it.
#include "palpate/view/renderer.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "palpate/mesh/reorder.h"
#include "palpate/view/offscreen.h"
#include "view/tests/view/pixel_difference.h"
#include "view/tests/view/small_world.h"

namespace palpate::view {
namespace {

constexpr int kWidth = 480;
constexpr int kHeight = 270;
constexpr double kAspect = static_cast<double>(kWidth) / kHeight;
constexpr double kNear = 50.0;
constexpr double kFar = 2000.0;

/// A renderer, a target and a camera straight above the middle of the flat skin.
struct Scene {
  explicit Scene(std::shared_ptr<const scene::World> shown = flatWorld()) : world(std::move(shown)) {}

  OffscreenContext context;
  std::shared_ptr<const scene::World> world;
  Target target{kWidth, kHeight};
  Renderer renderer{world};
  Camera camera = fitted(mesh::boundingBox(world->body->skin), kAspect);
  Look look;
  std::vector<FingerMark> fingers;

  Frustum frustum() const { return makeFrustum(cameraScreen(camera, kAspect), camera.eye(), kNear, kFar); }

  void press(const Vec3& place, double depth_mm, const Vec3& drag_mm = Vec3::Zero()) {
    fingers = {pressedFinger(*world, place, depth_mm, drag_mm)};
    renderer.updateAll(deformedBy(*world, fingers));
  }

  Image draw() {
    target.bind();
    Frame frame;
    frame.fingers = fingers;
    renderer.draw(frame, look, frustum(), kWidth, kHeight);
    return target.read();
  }

  Vec2 toPixel(const Vec3& place) const { return seenAt(frustum(), place).cwiseProduct(Vec2(kWidth, kHeight)); }

  /// Distance from the camera, along its axis, of what is seen at a place.
  double distanceAt(const Vec3& place) {
    const Vec2 pixel = toPixel(place);
    float depth = 0.0f;
    target.bind();
    glReadPixels(static_cast<int>(pixel.x()), kHeight - 1 - static_cast<int>(pixel.y()), 1, 1, GL_DEPTH_COMPONENT,
                 GL_FLOAT, &depth);
    return 2.0 * kNear * kFar / (kFar + kNear - (2.0 * depth - 1.0) * (kFar - kNear));
  }
  double expectedDistance(const Vec3& place) const { return (camera.eye() - place).dot(camera.backward()); }
};

std::size_t differing(const Image& a, const Image& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) count += a.pixels[i] != b.pixels[i] ? 1 : 0;
  return count;
}

TEST(Renderer, DrawsTheSamePictureTwice) {
  Scene scene;
  scene.press({50.0, 50.0, 0.0}, 6.0);
  scene.look.overlays.set();
  const Image first = scene.draw();
  EXPECT_EQ(scene.draw().pixels, first.pixels);
}

// Skin that is pressed and dragged, seen whole and from near by, where most of it is outside the picture.
TEST(Renderer, DrawsTheSamePictureWhenWhatIsOutsideIsLeftOut) {
  mesh::TriangleMesh mesh = zoo::grid(120, 300.0);
  mesh::reorderSpatially(mesh);
  Scene scene(meshWorld(std::move(mesh)));
  scene.press({150.0, 150.0, 0.0}, 8.0, {12.0, 0.0, 0.0});
  for (const double opacity : {1.0, 0.6}) {
    for (const double nearness : {1.0, 0.4, 0.15}) {
      Camera camera = scene.camera;
      scene.camera.distance_mm *= nearness;
      scene.camera.centre += Vec3(20.0, 10.0, 0.0);
      scene.camera.yaw_rad = 0.4;
      scene.look.skin_opacity = opacity;
      const Image left_out = scene.draw();
      scene.look.cull = false;
      EXPECT_EQ(scene.draw().pixels, left_out.pixels) << nearness << " " << opacity;
      scene.look.cull = true;
      scene.camera = camera;
    }
  }
}

TEST(Renderer, ShowsAFieldInTheColoursOfItsMap) {
  Scene scene;
  for (const Colouring colouring : {Colouring::strain, Colouring::stiffness, Colouring::ellipses}) {
    scene.look.colouring = colouring;
    scene.look.strain_percent = {-20.0, 20.0};
    scene.look.stiffness_n_per_mm = {0.2, 1.0};
    scene.look.half_major_mm = {20.0, 80.0};
    const double value = colouring == Colouring::strain      ? 0.0
                         : colouring == Colouring::stiffness ? kTestStiffness
                                                             : 50.0;
    const ColourRange range = scene.look.range();
    const auto expected = bytesOf(colourOf(fieldColourMap(colouring), (value - range.low) / (range.high - range.low)));
    const Pixel seen = scene.draw().at(kWidth / 2, kHeight / 2);
    EXPECT_LE(difference(seen, {expected[0], expected[1], expected[2]}), 2)
        << kColouringNames[static_cast<int>(colouring)];
  }
}

TEST(Renderer, ShowsAFieldThatWasEdited) {
  Scene scene;
  scene.look.colouring = Colouring::stiffness;
  const Image before = scene.draw();
  const std::vector<float> stiffer(scene.world->body->skin.positions.size(), 0.9f);
  scene.renderer.setField(Colouring::stiffness, stiffer);
  EXPECT_NE(scene.draw().at(kWidth / 2, kHeight / 2), before.at(kWidth / 2, kHeight / 2));
}

TEST(Renderer, PutsTheDeformedSkinWhereItIs) {
  Scene scene;
  scene.look.finger = FingerShape::none;
  const Vec3 place(50.0, 50.0, 0.0);
  scene.draw();
  EXPECT_NEAR(scene.distanceAt(place), scene.expectedDistance(place), 0.3);
  scene.press(place, 8.0);
  const Vec3 dent = place - Vec3(0.0, 0.0, 8.0);
  for (const Shading shading : {Shading::gouraud, Shading::skin}) {
    scene.look.shading = shading;
    scene.draw();
    EXPECT_NEAR(scene.distanceAt(dent), scene.expectedDistance(dent), 0.3);
  }
}

TEST(Renderer, DrawsTheBallInFrontOfTheSkinItPresses) {
  Scene scene;
  for (const double depth : {0.5, 4.0, 9.0}) {
    scene.press({37.0, 61.0, 0.0}, depth, {2.0, 0.0, 0.0});
    scene.look.finger = FingerShape::none;
    scene.draw();
    const Vec3 tip = scene.fingers.front().contact.tip;
    const double skin = scene.distanceAt(tip);
    scene.look.finger = FingerShape::ball;
    scene.draw();
    // Seen from above: the ball's top is two radii nearer than the skin it lies on.
    EXPECT_NEAR(skin - scene.distanceAt(tip), 16.0, 1.0) << depth;
  }
}

TEST(Renderer, UploadsOnlyWhatChanged) {
  Scene scene;
  const auto finger = pressedFinger(*scene.world, {30.0, 30.0, 0.0}, 5.0);
  deform::Deformer deformer(*scene.world->deformable);
  deform::DeformedSurface surface(*scene.world->deformable);
  const auto contact = deform::contactOf(finger.contact, maps::SurfaceEllipse{{15.0, 0.0, 0.0}, 1.0}, {});
  deformer.apply({&*contact, 1}, surface);
  Index changed = 0;
  for (const auto& range : surface.changed()) changed += range.end - range.first;
  EXPECT_EQ(scene.renderer.update(surface), changed);
  EXPECT_LT(changed, surface.vertices() / 2) << "a small dent is a small upload";
  deformer.apply({}, surface);  // back to rest
  scene.renderer.update(surface);
  deformer.apply({}, surface);
  EXPECT_EQ(scene.renderer.update(surface), 0u) << "nothing moved";
}

TEST(Renderer, FollowsADeformationRangeByRange) {
  Scene scene;
  const auto finger = pressedFinger(*scene.world, {30.0, 30.0, 0.0}, 5.0);
  deform::Deformer deformer(*scene.world->deformable);
  deform::DeformedSurface surface(*scene.world->deformable);
  const Image rest = scene.draw();
  const auto contact = deform::contactOf(finger.contact, maps::SurfaceEllipse{{15.0, 0.0, 0.0}, 1.0}, {});
  deformer.apply({&*contact, 1}, surface);
  scene.renderer.update(surface);
  const Image followed = scene.draw();
  scene.renderer.updateAll(surface);
  EXPECT_EQ(scene.draw().pixels, followed.pixels);
  EXPECT_NE(followed.pixels, rest.pixels);
  deformer.apply({}, surface);
  scene.renderer.update(surface);
  EXPECT_EQ(scene.draw().pixels, rest.pixels);
}

TEST(Renderer, DrawsSkinThatHidesAllAsIfItWereOpaque) {
  Scene scene;
  scene.press({50.0, 50.0, 0.0}, 6.0);
  for (const Shading shading : {Shading::gouraud, Shading::skin}) {
    scene.look.shading = shading;
    scene.look.skin_opacity = 1.0;
    const Image opaque = scene.draw();
    scene.look.skin_opacity = 1.0 - 1e-7;  // takes the way of transparent skin
    EXPECT_LE(largestDifference(scene.draw(), opaque), 1);
  }
}

TEST(Renderer, HidesTheSkinWithoutOpacity) {
  Scene scene;
  scene.look.skin_opacity = 0.0;
  const Image bare = scene.draw();
  EXPECT_LE(difference(bare.at(kWidth / 2, kHeight / 2), bare.at(kWidth / 2, kHeight / 2 + 1)), 3) << "background";
  scene.look.skin_opacity = 1.0;
  EXPECT_GT(differing(scene.draw(), bare), 10000u);
}

TEST(Renderer, ChangesOnlyPixelsNearAnOverlay) {
  Scene scene;
  scene.press({50.0, 50.0, 0.0}, 4.0);
  const Image off = scene.draw();
  scene.look.show(Overlay::contact);
  const Image on = scene.draw();
  const contact::FingerOutput& contact = scene.fingers.front().contact;
  const Vec2 middle = scene.toPixel(contact.proxy);
  EXPECT_GT(differing(on, off), 5u);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      if (on.at(x, y) == off.at(x, y)) continue;
      EXPECT_LT((Vec2(x, y) - middle).norm(), 25.0) << "pixel " << x << ", " << y;
    }
  }
}

TEST(Renderer, ShowsEveryOverlay) {
  Scene scene;
  scene.camera.yaw_rad = 0.5;
  scene.press({50.0, 50.0, 0.0}, 6.0, {3.0, 0.0, 0.0});
  scene.renderer.setPartition(nullptr, Vec3::Zero());
  const Image off = scene.draw();
  for (std::size_t i = 0; i < kOverlays; ++i) {
    const auto overlay = static_cast<Overlay>(i);
    if (overlay == Overlay::names) continue;                                  // words, which lie over the picture
    if (overlay == Overlay::pressure || overlay == Overlay::lumps) continue;  // of worlds with lumps
    if (overlay == Overlay::muscles) continue;                                // of the trunk
    scene.look.overlays.reset();
    scene.look.overlays.set(i);
    EXPECT_GT(differing(scene.draw(), off), 20u) << kOverlayNames[i];
  }
}

TEST(Renderer, LeavesAnOpaquePicture) {
  Scene scene;
  scene.press({50.0, 50.0, 0.0}, 6.0);
  scene.look.skin_opacity = 0.4;
  scene.look.overlays.set();
  scene.draw();
  std::vector<std::uint8_t> alpha(static_cast<std::size_t>(kWidth) * kHeight);
  glReadPixels(0, 0, kWidth, kHeight, GL_ALPHA, GL_UNSIGNED_BYTE, alpha.data());
  EXPECT_EQ(std::count(alpha.begin(), alpha.end(), 255), kWidth * kHeight);
}

TEST(Renderer, KeepsFrontsInFrontInAMirror) {
  Scene scene;
  scene.look.colouring = Colouring::stiffness;
  const Pixel plain = scene.draw().at(kWidth / 2, kHeight / 2);
  Frustum mirrored = scene.frustum();
  mirrored.projection.row(0) *= -1.0f;
  scene.target.bind();
  scene.renderer.draw({}, scene.look, mirrored, kWidth, kHeight);
  EXPECT_EQ(scene.target.read().at(kWidth / 2, kHeight / 2), plain);
}

TEST(Renderer, ShowsAHandForEachFinger) {
  Scene scene;
  const FingerMark left = pressedFinger(*scene.world, {20.0, 50.0, 0.0}, 4.0);
  const FingerMark right = pressedFinger(*scene.world, {80.0, 50.0, 0.0}, 4.0);
  scene.look.finger = FingerShape::none;
  const Image bare = scene.draw();
  const auto covered = [&](FingerShape shape, const std::vector<FingerMark>& fingers) {
    scene.look.finger = shape;
    scene.fingers = fingers;
    const Image drawn = scene.draw();
    std::vector<bool> differs(drawn.pixels.size());
    for (std::size_t i = 0; i < differs.size(); ++i) differs[i] = drawn.pixels[i] != bare.pixels[i];
    return differs;
  };
  const auto ball = covered(FingerShape::ball, {left});
  const auto ball_size = std::count(ball.begin(), ball.end(), true);
  const auto both = covered(FingerShape::hand, {left, right});
  const std::vector<bool> hands[] = {covered(FingerShape::hand, {left}), covered(FingerShape::hand, {right})};
  for (const int own : {0, 1}) {
    EXPECT_GT(std::count(hands[own].begin(), hands[own].end(), true), 2 * ball_size);
    std::size_t alone = 0, shown = 0;  // pixels of this hand where the other is not
    for (std::size_t i = 0; i < both.size(); ++i) {
      if (!hands[own][i] || hands[1 - own][i]) continue;
      ++alone;
      if (both[i]) ++shown;
    }
    EXPECT_GT(alone, 1000u);
    EXPECT_EQ(shown, alone) << own;
  }
}

}  // namespace
}  // namespace palpate::view
