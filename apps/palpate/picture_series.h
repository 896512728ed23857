// Pictures of one world, one after the other: fingers in, deformed skin drawn.
#pragma once

#include "apps/palpate/surface_files.h"
#include "palpate/view/picture.h"

namespace palpate::app {

class PictureSeries {
 public:
  /// Throws Error where nothing can be drawn.
  PictureSeries(std::shared_ptr<const scene::World> world, const view::PictureSize& size);

  /// The skin as these fingers deform it, and the fingers on it; none: the body at rest.
  view::TakenPicture take(const Frame& frame, double time_s, const view::PictureSettings& settings);

 private:
  std::shared_ptr<const scene::World> world_;
  view::PictureSize size_;
  deform::AnyDeformer deformer_;
  deform::DeformedSurface surface_;
  view::Studio studio_;
};

}  // namespace palpate::app
