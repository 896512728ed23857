// The colours of overlays: sRGB and opacity. The finger's own colours are in finger_pose.h.
#pragma once

#include "palpate/view/lines.h"

namespace palpate::view {

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

}  // namespace palpate::view
