#include "view/viewer/shading_guard.h"

#include <algorithm>

namespace palpate::viewer {

namespace {

/// A frame that was in time takes back as much of the suspicion as several slow ones of its length brought.
constexpr double kForgiving = 2.0;
constexpr double kMostPatience = 64.0;

}  // namespace

ShadingGuard::Change ShadingGuard::frame(double between_s, double cost_s, bool counts) {
  if (!counts || between_s > settings_.hitch_s) return Change::none;
  if (!simple_) {
    const bool slow = between_s > settings_.slow_s;
    slow_s_ = std::max(0.0, slow_s_ + (slow ? between_s : -kForgiving * between_s));
    if (slow_s_ < settings_.slow_for_s) return Change::none;
    simple_ = true;
    slow_s_ = spare_s_ = 0.0;
    return Change::simpler;
  }
  const bool spare = std::max(between_s * settings_.spare_share, cost_s) < settings_.spare_share * settings_.slow_s;
  spare_s_ = spare ? spare_s_ + between_s : 0.0;
  if (spare_s_ < patience_ * settings_.spare_for_s) return Change::none;
  simple_ = false;
  patience_ = std::min(kMostPatience, 2.0 * patience_);
  spare_s_ = 0.0;
  return Change::as_wished;
}

}  // namespace palpate::viewer
