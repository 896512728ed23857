#include "apps/palpate/run_statistics.h"

#include <algorithm>

namespace palpate::app {

RunStatistics::RunStatistics(std::size_t fingers, std::size_t triangles)
    : fingers_(fingers), visited_(fingers, std::vector<bool>(triangles, false)) {}

void RunStatistics::add(const trace::Sample& sample) {
  FingerStatistics& finger = fingers_[sample.finger];
  const contact::FingerOutput& contact = sample.contact;
  const double force = contact.force.norm();
  hash_.add(contact.force);
  ++finger.ticks;
  finger.peak_device_force_n = std::max(finger.peak_device_force_n, sample.device_force.norm());
  if (contact.touch == contact::Touch::free) return;
  ++finger.touching;
  (contact.touch == contact::Touch::stick ? finger.sticking : finger.slipping) += 1;
  finger.limited += sample.device_force != contact.force ? 1 : 0;
  finger.peak_force_n = std::max(finger.peak_force_n, force);
  finger.sum_force_n += force;
  finger.peak_depth_mm = std::max(finger.peak_depth_mm, contact.depth_mm);
  finger.sum_depth_mm += contact.depth_mm;
  auto visited = visited_[sample.finger].begin() + static_cast<std::ptrdiff_t>(contact.triangle);
  if (contact.triangle != kNoIndex && !*visited) {
    *visited = true;
    ++finger.triangles;
  }
}

bool RunStatistics::anyTouch() const {
  return std::any_of(fingers_.begin(), fingers_.end(), [](const auto& finger) { return finger.touching > 0; });
}

}  // namespace palpate::app
