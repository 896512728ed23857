// A renderer that is given another world shows it like a new one, but makes no program again: that would take longer
// than many pictures.
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include "palpate/view/offscreen.h"
#include "palpate/view/renderer.h"
#include "support/error_message.h"
#include "view/tests/view/textured_world.h"

namespace palpate::view {
namespace {

using World = std::shared_ptr<const scene::World>;

/// Counts calls of a GL function while it lives; `Which` is epoxy's pointer to it.
template <auto Which, class... Arguments>
class CallCount {
 public:
  CallCount() : original_(*Which) {
    count_ = 0;
    current_ = original_;
    *Which = [](Arguments... arguments) {
      ++count_;
      current_(arguments...);
    };
  }
  ~CallCount() { *Which = original_; }
  CallCount(const CallCount&) = delete;
  CallCount& operator=(const CallCount&) = delete;
  int count() const { return count_; }

 private:
  using Function = std::remove_reference_t<decltype(*Which)>;
  static inline int count_ = 0;
  static inline Function current_ = nullptr;
  Function original_;
};
using LinkCount = CallCount<&epoxy_glLinkProgram, GLuint>;
using PictureCount = CallCount<&epoxy_glGenerateMipmap, GLenum>;

class ChangeOfWorld : public testing::Test {
 protected:
  Image draw(Renderer& renderer, const World& world, const std::vector<FingerMark>& fingers = {}) {
    const Camera camera = fitted(mesh::boundingBox(world->body->skin), kTexturedAspect);
    target_.bind();
    Frame frame;
    frame.fingers = fingers;
    renderer.draw(frame, look_, makeFrustum(cameraScreen(camera, kTexturedAspect), camera.eye(), 10.0, 2000.0),
                  kTexturedWidth, kTexturedHeight);
    return target_.read();
  }
  Image drawNew(const World& world) {
    Renderer renderer(world);
    return draw(renderer, world);
  }

  OffscreenContext context_;
  Target target_{kTexturedWidth, kTexturedHeight};
  Look look_;
  World sheet_ = flatWorld();
  World ball_ = meshWorld(zoo::sphere(30.0, 4));
};

TEST_F(ChangeOfWorld, ShowsItAsANewRendererWould) {
  look_.show(Overlay::wireframe);
  look_.show(Overlay::normals);
  Renderer renderer(sheet_);
  const std::vector<FingerMark> fingers = {pressedFinger(*sheet_, {50.0, 50.0, 0.0}, 6.0)};
  renderer.updateAll(deformedBy(*sheet_, fingers));
  draw(renderer, sheet_, fingers);
  for (const World& world : {ball_, sheet_}) {
    renderer.setWorld(world);
    EXPECT_EQ(draw(renderer, world).pixels, drawNew(world).pixels);
  }
}

TEST_F(ChangeOfWorld, MakesNoProgramAgain) {
  look_.detail = false;  // the ball is seen from so near that skin lines would be asked for, for the first time
  Renderer renderer(sheet_);
  draw(renderer, sheet_);
  const LinkCount links;
  renderer.setWorld(ball_);
  draw(renderer, ball_);
  EXPECT_EQ(links.count(), 0);
  const Renderer another(sheet_);
  EXPECT_GT(links.count(), 0) << "they would be counted";
}

TEST_F(ChangeOfWorld, ForgetsWhatBelongedToTheOneBefore) {
  look_.colouring = Colouring::stiffness;
  Renderer renderer(sheet_);
  const std::vector<float> soft(sheet_->body->skin.positions.size(), 0.1f);
  renderer.setField(Colouring::stiffness, soft);
  renderer.setWorld(sheet_);
  EXPECT_EQ(draw(renderer, sheet_).pixels, drawNew(sheet_).pixels);
}

/// What an edit of the maps makes of a world.
World edited(const World& world, double stiffness_n_per_mm) {
  auto copy = std::make_shared<scene::World>(*world);
  copy->surface.stiffness_n_per_mm =
      std::make_shared<const std::vector<double>>(world->surface.stiffness_n_per_mm->size(), stiffness_n_per_mm);
  copy->ellipses = maps::AnyEllipseMap({}, {.basic_radius_mm = 25.0}, {});
  return copy;
}

TEST_F(ChangeOfWorld, OnTheSameBodyShowsTheNewMaps) {
  Renderer renderer(sheet_);
  for (const Colouring colouring : {Colouring::stiffness, Colouring::ellipses}) {
    look_.colouring = colouring;
    draw(renderer, sheet_);
    const World stiffer = edited(sheet_, 0.9);
    renderer.setWorld(stiffer);
    EXPECT_EQ(draw(renderer, stiffer).pixels, drawNew(stiffer).pixels);
    renderer.setWorld(sheet_);
  }
}

TEST_F(ChangeOfWorld, OnTheSameBodyGoesBackToRest) {
  Renderer renderer(sheet_);
  const std::vector<FingerMark> fingers = {pressedFinger(*sheet_, {50.0, 50.0, 0.0}, 6.0)};
  renderer.updateAll(deformedBy(*sheet_, fingers));
  const World same = edited(sheet_, 0.9);
  renderer.setWorld(same);
  EXPECT_EQ(draw(renderer, same).pixels, drawNew(same).pixels);
}

TEST_F(ChangeOfWorld, KeepsThePictureThatBothHave) {
  const World dressed = texturedWorld(zoo::grid(8, 100.0), support::onSheet, pngBytes(Image(8, 8, {200, 40, 30})));
  Renderer renderer(dressed);
  const PictureCount pictures;
  renderer.setWorld(edited(dressed, 0.9));
  EXPECT_EQ(pictures.count(), 0);
  EXPECT_EQ(draw(renderer, dressed).pixels, drawNew(dressed).pixels);
  renderer.setWorld(sheet_);
  EXPECT_EQ(draw(renderer, sheet_).pixels, drawNew(sheet_).pixels) << "and takes it off";
}

TEST_F(ChangeOfWorld, ToABrokenPictureChangesNothing) {
  Renderer renderer(sheet_);
  const Image before = draw(renderer, sheet_);
  const World broken = texturedWorld(zoo::grid(8, 100.0), support::onSheet, "\x89PNG\r\n");
  EXPECT_NE(support::thrownMessage([&] { renderer.setWorld(broken); }).find("is a broken picture"), std::string::npos);
  EXPECT_EQ(draw(renderer, sheet_).pixels, before.pixels);
}

}  // namespace
}  // namespace palpate::view
