#include "palpate/engine/contact_stream.h"

#include <algorithm>
#include <vector>

#include "palpate/engine/touching.h"

namespace palpate::engine {

std::string encodedSkinOf(const scene::World& world) {
  std::vector<float> shares;
  if (world.breath) {
    shares.reserve(world.body->skin.positions.size());
    for (const Vec3& place : world.body->skin.positions)
      shares.push_back(static_cast<float>(world.breath->share(place)));
  }
  return encodedSkin(world.body->skin, shares);
}

std::string encodedFormsOf(const scene::World& world, std::size_t fingers) {
  return encodedForms(formsForFingers(world, true, fingers));
}

StreamedFrame frameFor(std::size_t fingers) {
  StreamedFrame frame;
  frame.fingers.reserve(fingers);
  frame.contacts.reserve(2 * fingers);
  return frame;
}

void fillFrame(const scene::World& world, std::span<const trace::Sample> samples, StreamedFrame& frame) noexcept {
  frame.tick = samples.empty() ? 0 : samples.front().tick;
  frame.lift_mm = liftAt(world, frame.tick);
  frame.fingers.clear();
  frame.contacts.clear();
  for (const trace::Sample& sample : samples.first(std::min(samples.size(), frame.fingers.capacity()))) {
    const contact::FingerOutput& felt = sample.contact;
    frame.fingers.push_back({felt.tip, felt.proxy, felt.normal, felt.force, felt.depth_mm, felt.touch});
    addTouching(world, sample.contact, frame.lift_mm, frame.contacts);
  }
}

}  // namespace palpate::engine
