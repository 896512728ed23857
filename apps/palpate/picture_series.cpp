#include "apps/palpate/picture_series.h"

#include "apps/palpate/finger_marks.h"

namespace palpate::app {

PictureSeries::PictureSeries(std::shared_ptr<const scene::World> world, const view::PictureSize& size)
    : world_(std::move(world)),
      size_(size),
      deformer_(world_->deformable, formsForDisplay(*world_, world_->scene.fingers.size())),
      surface_(world_->deformable),
      studio_(world_) {}

view::TakenPicture PictureSeries::take(const Frame& frame, double time_s, const view::PictureSettings& settings) {
  deformer_.apply(contactsOf(*world_, frame), surface_);
  const std::vector<view::FingerMark> marks = marksOf(*world_, frame);
  return studio_.take(surface_, {marks, time_s}, settings, size_);
}

}  // namespace palpate::app
