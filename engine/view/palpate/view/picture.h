// Pictures without a window: one call from a world, its deformed skin and the fingers on it to an image.
#pragma once

#include "palpate/view/image.h"
#include "palpate/view/offscreen.h"
#include "palpate/view/painter.h"

namespace palpate::view {

struct PictureSize {
  int width = 1280;
  int height = 720;
  int supersampling = 2;  ///< each pixel is the mean of this many squared
};

struct TakenPicture {
  Image image;
  std::vector<std::string> notes;  ///< see Painted
  std::string drawn_by;            ///< rendererName()
};

/// Takes pictures of one world: an offscreen context and its uploads. One thread.
class Studio {
 public:
  /// Throws Error where nothing can be drawn (OffscreenContext).
  explicit Studio(std::shared_ptr<const scene::World> world);

  TakenPicture capture(const deform::DeformedSurface& surface, const Frame& frame, const PictureSettings& settings,
                       const PictureSize& size);
  [[deprecated("capture, which this was until 0.3")]] TakenPicture take(const deform::DeformedSurface& surface,
                                                                        const Frame& frame,
                                                                        const PictureSettings& settings,
                                                                        const PictureSize& size) {
    return capture(surface, frame, settings, size);
  }

 private:
  OffscreenContext context_;
  Painter painter_;
  std::unique_ptr<Target> target_;
};

/// One single picture; the studio is built and thrown away.
Image picture(std::shared_ptr<const scene::World> world, const deform::DeformedSurface& surface, const Frame& frame,
              const PictureSettings& settings, const PictureSize& size = {});

}  // namespace palpate::view
