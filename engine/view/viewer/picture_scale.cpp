#include "view/viewer/picture_scale.h"

#include <algorithm>
#include <cmath>

namespace palpate::viewer {

namespace {

constexpr int kAllEighths = 8;
constexpr int kMinEighths = static_cast<int>(kAllEighths * kMinPictureShare);

}  // namespace

void PictureScale::frame(double between_s) {
  since_raised_s_ += between_s;
  between_s > settings_.goal_s ? slow(between_s) : spare(between_s);
}

/// Costs per pixel fall with the square; fixed costs need another step.
void PictureScale::slow(double between_s) {
  spare_s_ = 0.0;
  const double before_s = last_slow_s_;
  last_slow_s_ = between_s;
  if (before_s == 0.0 || eighths_ == kMinEighths) return;
  const double wanted = share() * std::sqrt(settings_.aim * settings_.goal_s / std::min(before_s, between_s));
  const bool in_vain = since_raised_s_ < settings_.in_vain_s;
  patience_s_ = in_vain ? std::min(settings_.max_patience_s, 2.0 * patience_s_) : settings_.spare_for_s;
  eighths_ = std::clamp(static_cast<int>(kAllEighths * wanted), kMinEighths, eighths_ - 1);
  last_slow_s_ = 0.0;
}

void PictureScale::spare(double between_s) {
  last_slow_s_ = 0.0;
  if (eighths_ == kAllEighths) return;
  const double growth = static_cast<double>(eighths_ + 1) / eighths_;
  const bool spare = growth * growth * between_s < settings_.aim * settings_.goal_s;
  spare_s_ = spare ? spare_s_ + between_s : 0.0;
  if (spare_s_ < patience_s_) return;
  ++eighths_;
  spare_s_ = since_raised_s_ = 0.0;
}

}  // namespace palpate::viewer
