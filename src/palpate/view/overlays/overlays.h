// All overlays of a picture as lines and patches; the wireframe alone is drawn from the skin's own buffers.
#pragma once

#include <optional>
#include <span>

#include "palpate/view/finger_pose.h"
#include "palpate/view/look.h"
#include "palpate/view/overlays/ellipse_marks.h"
#include "palpate/view/lines.h"
#include "palpate/view/overlays/partition_marks.h"

namespace palpate::view {

// The colours of overlays: sRGB and opacity. The finger's own colours are in finger_pose.h.

inline constexpr Paint kWireframePaint{20, 22, 28, 110};
inline constexpr Paint kHapticTrianglePaint{40, 220, 70, 90};
inline constexpr Paint kHapticEdgePaint{60, 255, 95, 200};
inline constexpr Paint kLeafBoxPaint{70, 140, 255, 200};
/// Splitting planes square to x, y, z (Fig 3.6).
inline constexpr std::array<Paint, 3> kPlanePaints{{{60, 220, 80, 220}, {240, 70, 60, 220}, {245, 215, 50, 220}}};
inline constexpr Paint kDetectingBoxPaint{255, 255, 255, 235};
inline constexpr Paint kNormalRegionPaint{255, 240, 120, 255};
inline constexpr Paint kTangentialRegionPaint{120, 240, 255, 255};
inline constexpr Paint kKeyEllipsePaint{255, 255, 255, 150};
inline constexpr std::array<Paint, 2> kRingPaints{{{255, 255, 255, 230}, {0, 210, 230, 230}}};
inline constexpr Paint kDisplacementPaint{255, 150, 30, 230};
inline constexpr Paint kNormalPaint{150, 190, 255, 170};
inline constexpr Paint kAnchorPaint{255, 220, 40, 255};
inline constexpr Paint kProxyPaint{255, 255, 255, 255};
inline constexpr Paint kTipPaint{255, 90, 220, 255};
inline constexpr Paint kForcePaint{60, 255, 120, 255};
inline constexpr Paint kRestSectionPaint{240, 240, 240, 190};
inline constexpr Paint kDeformedSectionPaint{255, 80, 160, 255};

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
