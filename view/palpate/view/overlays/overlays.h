// All overlays of a picture as lines and patches; the wireframe alone is drawn from the skin's own buffers.
//
//   Look, DrawnSkin, fingers ─► Overlays ─ marks.h, ellipse_marks.h, partition_marks.h ─► OverlayShapes ─► LineLayer
#pragma once

#include <optional>
#include <span>

#include "palpate/view/finger_pose.h"
#include "palpate/view/layers/drawn_skin.h"
#include "palpate/view/lines.h"
#include "palpate/view/look.h"
#include "palpate/view/overlays/ellipse_marks.h"
#include "palpate/view/overlays/partition_marks.h"

namespace palpate::view {

struct OverlayShapes {
  Patches patches;
  Lines thin{1.3, {}};
  Lines bold{2.6, {}};
};

/// Keeps what does not change from picture to picture. The world must outlive it.
class Overlays {
 public:
  explicit Overlays(const scene::World& world) : world_(world) {}

  void setPartition(ShownPartition shown) {
    partition_ = shown.partition ? std::optional(std::move(shown)) : std::nullopt;
  }

  /// What the look asks for. Valid until the next call.
  const OverlayShapes& shapes(const Look& look, const DrawnSkin& skin, std::span<const FingerMark> fingers);

 private:
  void addBody(const Look& look, const DrawnSkin& skin);
  void addPartition(const Look& look);
  void addFinger(const Look& look, const DrawnSkin& skin, const contact::FingerOutput& contact);
  void addTouch(const Look& look, const DrawnSkin& skin, const contact::FingerOutput& contact);
  const ShownPartition& partition();
  const std::vector<Outline>& keyEllipses();

  const scene::World& world_;
  std::optional<ShownPartition> partition_;           // made when first shown
  std::optional<std::vector<Outline>> key_ellipses_;  // made when first shown
  OverlayShapes shapes_;
};

}  // namespace palpate::view
