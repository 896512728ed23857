#include "view/viewer/finger_form.h"

#include <algorithm>

#include "view/viewer/state/viewer_state.h"

namespace palpate::viewer {

namespace {

/// A frame in time reduces the suspicion by as much as several slow ones of its length raised it.
constexpr double kFormForgiving = 2.0;
constexpr double kLongestWaitS = 3600.0;

}  // namespace

void FingerForm::frame(double between_s, double cost_s, bool counts) {
  if (!counts || between_s > settings_.hitch_s) return;
  hand_ ? frameOfHand(between_s) : frameOfFinger(between_s, cost_s);
}

void FingerForm::frameOfHand(double between_s) {
  const bool slow = between_s > settings_.slow_s;
  slow_s_ = std::max(0.0, slow_s_ + (slow ? between_s : -kFormForgiving * between_s));
  if (slow_s_ < settings_.slow_for_s) return;
  hand_ = false;
  again_s_ = again_s_ > 0.0 ? std::min(kLongestWaitS, 2.0 * again_s_) : settings_.again_after_s;
  wait_s_ = again_s_;
  slow_s_ = spare_s_ = 0.0;
}

void FingerForm::frameOfFinger(double between_s, double cost_s) {
  const bool spare = between_s <= settings_.slow_s && cost_s < settings_.spare_share * settings_.slow_s;
  spare_s_ = spare ? spare_s_ + between_s : 0.0;
  if (spare_s_ < wait_s_) return;
  hand_ = true;
  slow_s_ = spare_s_ = 0.0;
}

view::FingerShape fingerShapeNow(FingerForm& form, const BodyView& seen, double elapsed_s, bool counts) {
  const view::FingerShape chosen = seen.state.look.finger;
  if (chosen != view::FingerShape::automatic) {
    form.reset();
    return chosen;
  }
  const bool any = seen.finger_present[0] || seen.finger_present[1];
  // Pictures that are slow enough to be simplified or drawn with fewer pixels leave no time for hands.
  const bool spared = seen.simple_shading || (!form.hand() && seen.performance.picture_share < 1.0);
  form.frame(elapsed_s, 1e-3 * seen.performance.frame_ms, counts && any && !spared);
  return form.hand() && !seen.simple_shading ? view::FingerShape::hand : view::FingerShape::finger;
}

}  // namespace palpate::viewer
