#include "cli/render/picture_series.h"

#include <algorithm>
#include <iterator>

namespace palpate::app {

namespace {

/// A point finger is drawn as a fingertip.
constexpr double kFingertipMm = 8.0;

view::FingerMark makeFingerMark(const scene::World& world, const trace::Sample& sample) {
  const Vec3f colours[] = {view::kLeftFinger, view::kRightFinger, view::kOtherFinger};
  const double radius_mm = world.scene.fingers[sample.finger].radius_mm;
  return {.contact = sample.contact,
          .radius_mm = radius_mm > 0.0 ? radius_mm : kFingertipMm,
          .colour = colours[std::min<std::size_t>(sample.finger, std::size(colours) - 1)],
          .haptic_radius_mm = radius_mm,
          .left = sample.finger % 2 == 0,
          .pad = view::fingerPad(world.scene, sample.finger)};
}

}  // namespace

std::vector<view::FingerMark> makeFingerMarks(const scene::World& world, const servo::TickSamples& frame) {
  std::vector<view::FingerMark> marks;
  for (const trace::Sample& sample : frame) marks.push_back(makeFingerMark(world, sample));
  return marks;
}

std::vector<std::string> fingerNames(const scene::World& world) {
  std::vector<std::string> names;
  for (const scene::Finger& finger : world.scene.fingers) names.push_back(finger.name);
  return names;
}

PictureSeries::PictureSeries(std::shared_ptr<const scene::World> world, const view::PictureSize& size)
    : world_(std::move(world)), size_(size), skin_(*world_), studio_(world_) {}

view::TakenPicture PictureSeries::capture(const servo::TickSamples& frame, double time_s,
                                          const view::PictureSettings& settings) {
  skin_.follow(frame);
  const std::vector<view::FingerMark> marks = makeFingerMarks(*world_, frame);
  return studio_.capture(skin_.surface(), {.fingers = marks, .time_s = time_s, .lift_mm = skin_.lift()}, settings,
                         size_);
}

}  // namespace palpate::app
