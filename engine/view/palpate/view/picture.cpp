// Draws at several times the size, reads back, averages. The target is kept as long as the size is; the whole surface
// is uploaded each time, because its changes are unknown. Cold path.
#include "palpate/view/picture.h"

namespace palpate::view {

Studio::Studio(std::shared_ptr<const scene::World> world) : painter_(std::move(world)) {}

TakenPicture Studio::capture(const deform::DeformedSurface& surface, const Frame& frame,
                             const PictureSettings& settings, const PictureSize& size) {
  Canvas canvas;
  canvas.width = size.width * size.supersampling;
  canvas.height = size.height * size.supersampling;
  canvas.supersampling = size.supersampling;
  canvas.pixels_per_point = size.supersampling;
  if (!target_ || target_->width() != canvas.width || target_->height() != canvas.height) {
    target_ = std::make_unique<Target>(canvas.width, canvas.height);
  }
  canvas.framebuffer = target_->framebuffer();
  painter_.renderer().updateAll(surface);
  Painted painted = painter_.paint(frame, surface, settings, canvas);
  const Image image = target_->read();
  return {size.supersampling == 1 ? image : reduced(image, size.supersampling), std::move(painted.notes),
          rendererName()};
}

Image picture(std::shared_ptr<const scene::World> world, const deform::DeformedSurface& surface, const Frame& frame,
              const PictureSettings& settings, const PictureSize& size) {
  return Studio(std::move(world)).capture(surface, frame, settings, size).image;
}

}  // namespace palpate::view
