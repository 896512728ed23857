// Marks over the skin, as lines: a finger's contact and the skin's motion. And the colours of all overlays.
#pragma once

#include <array>

#include "palpate/contact/finger.h"
#include "palpate/scene/world.h"
#include "palpate/view/drawn_skin.h"
#include "palpate/view/lines.h"
#include "palpate/view/overlays/section.h"

namespace palpate::view {

/// sRGB and opacity. The finger's own colours are in finger_pose.h.
inline constexpr Paint kWireframePaint{20, 22, 28, 110};
inline constexpr Paint kHapticTrianglePaint{40, 220, 70, 90};
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
inline constexpr Paint kNamePaint{255, 214, 150, 255};
inline constexpr Paint kPadPaint{229, 92, 48, 255};  ///< for the key: the middle of the pressure's colours
inline constexpr Paint kLumpPaint{150, 110, 240, 255};
inline constexpr Paint kCutPaint{90, 235, 255, 255};
inline constexpr Paint kTrapeziusPaint{214, 70, 48, 255};
inline constexpr Paint kLatissimusPaint{70, 130, 215, 255};
inline constexpr Paint kErectorPaint{240, 205, 70, 255};

// ---- for a finger (contact_marks.cpp)

/// Length of the force arrow, and its maximum; a longer one has a break before its head.
inline constexpr double kForceMmPerN = 10.0;
inline constexpr double kLongestForceMm = 60.0;

/// Anchor (yellow) and proxy (white) on the skin at rest, tip, and the ties between them; the force from the proxy.
void addContactMarks(const contact::FingerOutput& contact, Lines& lines);

// ---- for the skin (skin_marks.cpp)

/// Arrows from rest to the present skin, one in each cube of `spacing_mm` that moved; a ring at their beginning shows
/// them to an eye that looks along them.
void addDisplacements(const scene::World& world, const DrawnSkin& skin, double spacing_mm, Lines& lines);

/// Normals of 5 mm, of at most about `most` vertices, evenly spread over the skin.
void addNormals(const DrawnSkin& skin, Index most, Lines& lines);

/// The edges within each of the first `rings` rings of neighbour nodes round a triangle; the triangle is ring 0.
void addRings(const scene::World& world, const DrawnSkin& skin, Index triangle, int rings, Lines& lines);

/// The cut through a finger's contact as wide as its chart: deformed, and at rest where the skin has moved.
void addSection(const scene::World& world, const DrawnSkin& skin, const contact::FingerOutput& contact, Lines& lines);

/// The deformed skin along a plane, up to half_width to either side of its origin.
void addCutLine(const scene::World& world, const DrawnSkin& skin, const SectionPlane& plane, double half_width_mm,
                Paint paint, Lines& lines);

}  // namespace palpate::view
