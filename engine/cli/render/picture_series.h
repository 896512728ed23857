// Pictures of one world, one after the other: fingers in, deformed skin drawn.
#pragma once

#include <string>
#include <vector>

#include "palpate/engine/living_skin.h"
#include "palpate/scene/world.h"
#include "palpate/servo/loop.h"
#include "palpate/view/finger_pose.h"
#include "palpate/view/image.h"
#include "palpate/view/picture.h"

namespace palpate::app {

// The fingers of a scene as they are drawn: their colours, sizes and names.

/// One per finger of the scene, in order: the first is the left hand's (blue), the second the right hand's (red).
std::vector<view::FingerMark> makeFingerMarks(const scene::World& world, const servo::TickSamples& frame);

std::vector<std::string> fingerNames(const scene::World& world);

class PictureSeries {
 public:
  /// Throws Error where nothing can be drawn.
  PictureSeries(std::shared_ptr<const scene::World> world, const view::PictureSize& size);

  /// The skin as these fingers deform it, and the fingers on it; none: the body at rest.
  view::TakenPicture capture(const servo::TickSamples& frame, double time_s, const view::PictureSettings& settings);

 private:
  std::shared_ptr<const scene::World> world_;
  view::PictureSize size_;
  engine::LivingSkin skin_;
  view::Studio studio_;
};

}  // namespace palpate::app
