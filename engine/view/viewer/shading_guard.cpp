#include "view/viewer/shading_guard.h"

#include <fmt/format.h>

#include <algorithm>

#include "palpate/base/language.h"
#include "view/viewer/picture_scale.h"
#include "view/viewer/state/viewer_state.h"

namespace palpate::viewer {

namespace {

/// A frame in time reduces the suspicion by as much as several slow ones of its length raised it.
constexpr double kForgiving = 2.0;
constexpr double kMaxPatience = 64.0;

/// Whether the picture has fewer pixels to go to, or would have in motion.
bool hasPixelsLeft(const BodyView& seen) {
  const bool adapts = seen.state.adapts_resolution && seen.state.stereo.mode == view::StereoMode::mono;
  return adapts && seen.performance.picture_share > kMinPictureShare;
}

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
  patience_ = std::min(kMaxPatience, 2.0 * patience_);
  spare_s_ = 0.0;
  return Change::as_requested;
}

void guardShading(ShadingGuard& guard, BodyView& seen, double elapsed_s, bool counts, Conversation& user) {
  const ViewState& state = seen.state;
  if (!state.simpler_when_slow || state.look.shading == view::Shading::gouraud) {
    guard.reset();
  } else {
    const bool gains = counts && !hasPixelsLeft(seen);
    const auto change = guard.frame(elapsed_s, 1e-3 * seen.performance.frame_ms, gains);
    if (change == ShadingGuard::Change::simpler) {
      // The menu bar shows it as long as it lasts; a plate over the picture would hide what is already slow.
      user.messages.note(trf("At {:.0f} fps the skin is drawn smooth for now; choose for good under Show > shading",
                             seen.performance.frames_per_s),
                         user.now_s);
    } else if (change == ShadingGuard::Change::as_requested) {
      user.messages.note("Pictures are fast again: the skin is drawn as before", user.now_s);
    }
  }
  seen.simple_shading = guard.simple();
}

}  // namespace palpate::viewer
