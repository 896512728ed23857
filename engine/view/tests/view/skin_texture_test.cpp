// A picture on the skin: each place of the skin shows its place in the picture, at rest and deformed, across seams.
#include <gtest/gtest.h>
#include <stb/stb_image_write.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "palpate/view/offscreen.h"
#include "palpate/view/renderer.h"
#include "palpate/view/skin_tone.h"
#include "support/changed_body.h"
#include "support/error_message.h"
#include "view/tests/view/pixel_difference.h"
#include "view/tests/view/textured_world.h"

namespace palpate::view {
namespace {

using World = std::shared_ptr<const scene::World>;

std::string jpegBytes(const Image& image) {
  std::string bytes;
  const auto append = [](void* to, void* data, int size) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
  };
  stbi_write_jpg_to_func(append, &bytes, image.width, image.height, 3, image.pixels.data(), 100);
  return bytes;
}

constexpr Pixel kRedPaint{200, 40, 30};
constexpr Pixel kBluePaint{30, 60, 190};
constexpr Pixel kGreenPaint{40, 160, 50};
constexpr Pixel kSandPaint{210, 190, 120};

/// Red and green above, sand and blue below.
Image fourColours() {
  Image image(64, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x)
      image.at(x, y) = y < 32 ? (x < 32 ? kRedPaint : kGreenPaint) : (x < 32 ? kSandPaint : kBluePaint);
  }
  return image;
}

/// Red on the left half, blue on the right one.
Image twoColours() {
  Image image(64, 4);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 64; ++x) image.at(x, y) = x < 32 ? kRedPaint : kBluePaint;
  }
  return image;
}

class TexturedSkin : public testing::Test {
 protected:
  TexturedSkin() { look_.finger = FingerShape::none; }

  Frustum frustumFor(const scene::World& world) const {
    Camera camera = fitted(mesh::boundingBox(world.body->skin), kTexturedAspect);
    camera.yaw_rad = yaw_rad_;
    return makeFrustum(cameraScreen(camera, kTexturedAspect), camera.eye(), 10.0, 2000.0);
  }
  Image draw(const World& world, const std::vector<FingerMark>& fingers = {}) {
    Renderer renderer(world);
    renderer.updateAll(deformedBy(*world, fingers));
    target_.bind();
    renderer.draw({}, look_, frustumFor(*world), kTexturedWidth, kTexturedHeight);
    return target_.read();
  }
  /// Of the flat sheet, at a place on it.
  Pixel seen(const Image& image, const scene::World& world, const Vec3& place) const {
    const Vec2 pixel = seenAt(frustumFor(world), place).cwiseProduct(Vec2(kTexturedWidth, kTexturedHeight));
    return image.at(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
  }

  OffscreenContext context_;
  Target target_{kTexturedWidth, kTexturedHeight};
  Look look_;
  double yaw_rad_ = 0.0;
};

TEST_F(TexturedSkin, ShowsEachPlaceOfThePictureInItsColour) {
  const mesh::TriangleMesh sheet = zoo::grid(20, 100.0);
  const World world = texturedWorld(sheet, support::onSheet, pngBytes(fourColours()));
  for (const Shading shading : {Shading::gouraud, Shading::skin}) {
    look_.shading = shading;
    const Image image = draw(world);
    for (const auto& [x, y, colour] : {std::tuple{25.0, 75.0, kRedPaint},
                                       {75.0, 75.0, kGreenPaint},
                                       {25.0, 25.0, kSandPaint},
                                       {75.0, 25.0, kBluePaint},
                                       {46.0, 54.0, kRedPaint},
                                       {54.0, 46.0, kBluePaint}}) {
      // As if all of the picture were of that colour.
      const Image plain = draw(texturedWorld(sheet, support::onSheet, pngBytes(Image(4, 4, colour))));
      const Vec3 place(x, y, 0.0);
      EXPECT_LE(difference(seen(image, *world, place), seen(plain, *world, place)), 1) << place.transpose();
    }
  }
}

TEST_F(TexturedSkin, LooksLikeSkinOfTheColourOfThePicture) {
  const mesh::TriangleMesh sheet = zoo::grid(20, 100.0);
  const Image skin = draw(meshWorld(sheet));
  Pixel encoded;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double linear = interpolateSkinTone(look_.skin_tone).colour[i];
    encoded[static_cast<std::size_t>(i)] =
        static_cast<std::uint8_t>(std::lround(255.0 * (1.055 * std::pow(linear, 1.0 / 2.4) - 0.055)));
  }
  const Image picture = draw(texturedWorld(sheet, support::onSheet, pngBytes(Image(8, 8, encoded))));
  double sum = 0.0;
  for (std::size_t i = 0; i < skin.pixels.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) sum += int{picture.pixels[i][c]} - int{skin.pixels[i][c]};
  }
  EXPECT_NEAR(sum / (3.0 * static_cast<double>(skin.pixels.size())), 0.0, 3.0) << "mottling apart";
}

TEST_F(TexturedSkin, DoesNotSmearAtASeam) {
  const World ball = texturedWorld(zoo::sphere(20.0, 3), support::onSphere, pngBytes(twoColours()));
  yaw_rad_ = -std::numbers::pi / 2.0;  // the seam, on the patient's left, in the middle
  for (const Shading shading : {Shading::gouraud, Shading::skin}) {
    look_.shading = shading;
    const Image image = draw(ball);
    const Frustum frustum = frustumFor(*ball);
    for (double z = -12.0; z <= 12.0; z += 3.0) {
      for (double angle = -0.5; angle <= 0.5; angle += 0.04) {
        if (std::abs(angle) < 0.03) continue;
        const double radius = std::sqrt(400.0 - z * z);
        const Vec3 place(-radius * std::cos(angle), -radius * std::sin(angle), z);
        const Vec2 pixel = seenAt(frustum, place).cwiseProduct(Vec2(kTexturedWidth, kTexturedHeight));
        const Pixel colour = image.at(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
        EXPECT_EQ(colour[0] > colour[2], angle > 0.0) << "at " << place.transpose();
      }
    }
  }
}

/// The same picture everywhere, but the right half of the sheet takes it from one picture farther on: a seam that
/// nobody may see.
mesh::TexturePlace onSheetInTwoParts(const Vec3& place, const Vec3& middle) {
  return support::onSheet(place, middle) + mesh::TexturePlace(middle.x() > 50.0 ? 1.0f : 0.0f, 0.0f);
}

TEST_F(TexturedSkin, KeepsItsSeamsClosedWhileItDeforms) {
  const mesh::TriangleMesh sheet = zoo::grid(50, 100.0);
  const std::string picture = pngBytes(fourColours());
  const World whole = texturedWorld(sheet, support::onSheet, picture);
  const World parted = texturedWorld(sheet, onSheetInTwoParts, picture);
  const std::vector<FingerMark> fingers = {pressedFinger(*whole, {50.0, 45.0, 0.0}, 8.0, {4.0, 3.0, 0.0})};
  EXPECT_LE(largestDifference(draw(whole, fingers), draw(parted, fingers)), 1);
  EXPECT_GT(largestDifference(draw(whole, fingers), draw(whole)), 30) << "it did deform";
}

TEST_F(TexturedSkin, FollowsADeformationRangeByRange) {
  const World world = texturedWorld(zoo::grid(50, 100.0), onSheetInTwoParts, pngBytes(fourColours()));
  const std::vector<FingerMark> fingers = {pressedFinger(*world, {50.0, 45.0, 0.0}, 8.0)};
  const Image expected = draw(world, fingers);
  Renderer renderer(world);
  deform::Deformer deformer(*world->deformable);
  deform::DeformedSurface surface(*world->deformable);
  const auto contact = deform::contactOf(fingers[0].contact, world->ellipses, {});
  deformer.apply({&*contact, 1}, surface);
  renderer.update(surface);
  target_.bind();
  renderer.draw({}, look_, frustumFor(*world), kTexturedWidth, kTexturedHeight);
  EXPECT_EQ(target_.read().pixels, expected.pixels);
}

TEST_F(TexturedSkin, MovesItsPictureWithTheSkin) {
  const World world = texturedWorld(zoo::grid(50, 100.0), support::onSheet, pngBytes(twoColours()));
  const std::vector<FingerMark> fingers = {pressedFinger(*world, {50.0, 50.0, 0.0}, 6.0, {6.0, 0.0, 0.0})};
  const deform::DeformedSurface surface = deformedBy(*world, fingers);
  ASSERT_GT(surface.displacement(0)[51 * 25 + 25], 2.0f) << "the middle was dragged to the right";
  const Image image = draw(world, fingers);
  for (const Index column : {22u, 24u, 26u, 28u}) {
    const Pixel colour = seen(image, *world, surface.positionAt(51 * 25 + column).cast<double>());
    EXPECT_EQ(colour[0] > colour[2], column < 25) << column;
  }
}

TEST_F(TexturedSkin, MayBeJpeg) {
  const mesh::TriangleMesh sheet = zoo::grid(10, 100.0);
  const Image png = draw(texturedWorld(sheet, support::onSheet, pngBytes(Image(16, 16, kSandPaint))));
  const Image jpeg = draw(texturedWorld(sheet, support::onSheet, jpegBytes(Image(16, 16, kSandPaint))));
  EXPECT_LE(largestDifference(png, jpeg), 3);
}

TEST_F(TexturedSkin, CanBeSwitchedOffAndGivesWayToFields) {
  const mesh::TriangleMesh sheet = zoo::grid(20, 100.0);
  const World bare = meshWorld(sheet);
  const World world = texturedWorld(sheet, onSheetInTwoParts, pngBytes(fourColours()));
  EXPECT_GT(largestDifference(draw(world), draw(bare)), 30);
  look_.texture = false;
  EXPECT_LE(largestDifference(draw(world), draw(bare)), 1);
  look_.texture = true;
  for (const Colouring colouring : {Colouring::strain, Colouring::stiffness, Colouring::ellipses}) {
    look_.colouring = colouring;
    EXPECT_EQ(draw(world).pixels, draw(bare).pixels);
  }
}

TEST_F(TexturedSkin, ShinesThroughLikeAnyOther) {
  const World world = texturedWorld(zoo::grid(20, 100.0), onSheetInTwoParts, pngBytes(fourColours()));
  for (const Shading shading : {Shading::gouraud, Shading::skin}) {
    look_.shading = shading;
    look_.skin_opacity = 1.0;
    const Image opaque = draw(world);
    look_.skin_opacity = 1.0 - 1e-7;
    EXPECT_LE(largestDifference(draw(world), opaque), 1);
  }
}

TEST_F(TexturedSkin, SaysWhichPictureIsBroken) {
  const std::string whole = pngBytes(fourColours());
  const mesh::TriangleMesh sheet = zoo::grid(4, 100.0);
  for (const std::string& picture : {whole.substr(0, 60), std::string("\x89PNG\r\n\x1a\n"), std::string()}) {
    EXPECT_EQ(support::thrownMessage([&] { Renderer(texturedWorld(sheet, support::onSheet, picture)); }),
              "s.toml:4: [body] texture: picture.png: is a broken picture");
  }
}

// A painted skin has factors on the tone: the tone is seen through it.
TEST_F(TexturedSkin, OfAPaintedPictureFollowsTheTone) {
  const auto world = std::make_shared<scene::World>(*texturedWorld(zoo::grid(20, 100.0), support::onSheet, ""));
  scene::SkinTexture texture = *world->body->texture;
  texture.made = scene::MadeSkin{.seed = 3, .size_mm = {100.0, 100.0}};
  support::changeBody(*world, [&](scene::Body& body) {
    body.texture = std::make_shared<const scene::SkinTexture>(std::move(texture));
  });
  for (const Shading shading : {Shading::skin, Shading::gouraud}) {
    look_.shading = shading;
    look_.skin_tone = 1.0;
    const Pixel light = draw(world).at(kTexturedWidth / 2, kTexturedHeight / 2);
    look_.skin_tone = 6.0;
    const Pixel dark = draw(world).at(kTexturedWidth / 2, kTexturedHeight / 2);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_LT(dark[c] + 40, light[c]);
  }
}

}  // namespace
}  // namespace palpate::view
