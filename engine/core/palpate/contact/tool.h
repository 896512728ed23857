// A tool of several pads: a fingertip, a palm, an ultrasound head, a hand. Spheres fixed to rigid parts touch the skin
// together and give one wrench.
//
//   poses of the parts ─► tips of the pads ─► each pad a sphere finger (finger.h) ─► forces at the tips ─► Wrench
//                              └─ groups of neighbours share what is near (nearby_skin.h)
//
// Physics. Each pad is a sphere finger of its own, whose tip is carried rigidly by its part: it has a proxy, a depth, a
// friction anchor and a force that equals to the last bit what contact::step gives for that tip, that radius and these
// settings. The force acts where the pad's tip is, because that is the place whose motion it works against: the sum of
// F . v over the pads is then the wrench times the motion of the part, so a tool can give no energy that its pads do
// not give, and what is bounded and passive for a finger stays so. Sideways and turning stiffness come out of where the
// pads are: k share |arm|^2 for a turn.
//
// Pads share the load. Skin pushed in by one pad is already in under its neighbour, so N pads side by side are not N
// times as stiff as one. Pad::share weighs each pad's force in the wrench (never in FingerOutput); a stiffness in N/mm
// is that of a whole finger. See tool_shapes.h for how shares are chosen.
//
// Limits. Proxies move independently: on a limb thinner than the tool two pads may rest on different sides, and a ridge
// may lie between two pads unfelt by either. The skin does not carry a dent from one pad to the next, so only the
// shares spread the pressure. Nothing is felt between pads: their spacing decides what is missed.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "palpate/contact/finger.h"
#include "palpate/contact/nearby_skin.h"

namespace palpate::contact {

/// Where a part is: position of its origin in the body's frame, mm, and a rotation from its frame to the body's.
struct ToolPose {
  Vec3 position = Vec3::Zero();
  Mat3 rotation = Mat3::Identity();
};

/// A sphere fixed to a part of a tool.
struct Pad {
  Vec3 offset = Vec3::Zero();  ///< of its centre, mm in the part's frame
  double radius_mm = 8.0;      ///< > 0
  double share = 1.0;          ///< of the force of a finger that it counts in the wrench, >= 0
  Index part = 0;
};

/// A tool as plain data.
struct ToolShape {
  std::vector<Pad> pads;
  /// Per part, at least one: where its origin is when the tool is laid flat, mm. For those who move it in one piece.
  std::vector<Vec3> rest = {Vec3::Zero()};
};

/// Throws Error naming what makes no sense: no pads, a radius that is not above 0, a part that does not exist.
void check(const ToolShape& shape);

/// Poses of the parts of a tool that is moved in one piece, `pose` being that of its frame. One for each part.
void posesAtRest(const ToolShape& shape, const ToolPose& pose, std::span<ToolPose> poses) noexcept;

/// Force, and its moment about a named point.
struct Wrench {
  Vec3 point = Vec3::Zero();        ///< the moment is about this, mm in the body's frame
  Vec3 force_n = Vec3::Zero();      ///< on the tool
  Vec3 moment_n_mm = Vec3::Zero();  ///< on the tool
};

/// The same wrench with its moment about another point.
Wrench about(const Wrench& wrench, const Vec3& point) noexcept;

/// Pads of one part that are near each other, and the skin that was gathered for them.
struct PadGroup {
  std::size_t first = 0, end = 0;  ///< into ToolState::order
  Index part = 0;
  Vec3 offset = Vec3::Zero();  ///< of its middle, mm in the part's frame
  double radius_mm = 0.0;      ///< from there to the far side of its farthest pad
  bool idle = false;           ///< all its pads are in the air and nothing they felt is left
  Vec3 middle = Vec3::Zero();  ///< where its middle was in the last tick, mm in the body's frame
  Vec3 clear_at = Vec3::Zero();
  double clear_mm = 0.0;   ///< no skin is nearer to clear_at than this; 0: not known
  bool gather = true;      ///< before its pads move again
  double margin_mm = 0.0;  ///< how much farther than its pads it gathers
  int rest_ticks = 0;      ///< left until it tries again, after there was too much skin to gather
};

/// All that a tool remembers between two ticks. Pads are in the shape's order.
struct ToolState {
  std::vector<FingerState> pads;
  std::vector<FingerOutput> felt;  ///< what each pad felt in the last tick, before shares
  std::vector<Wrench> of_part;     ///< about the part's origin
  std::size_t touching = 0;        ///< pads
  std::shared_ptr<const SkinPlanes> planes;
  std::vector<std::size_t> order;  ///< pads, group by group
  std::vector<PadGroup> groups;
  std::vector<NearbySkin> nearby;  ///< of each group
};

/// A tool that has touched nothing. Allocates. `planes`: of the surface's geometry, for many tools on one surface;
/// null: makes its own. Throws Error as check() does.
ToolState makeToolState(const ToolShape& shape, const Surface& surface,
                        std::shared_ptr<const SkinPlanes> planes = nullptr);

/// One tick of a tool: moves every pad as contact::step moves a finger. Of `settings` the radius is not looked at.
/// Returns the wrench of all parts about the origin of the first one; ToolState has what each part and each pad felt.
/// One pose for each part. Any thread, but one at a time per state; no lock, no allocation. `lumps` as in step().
///
/// On a surface of another geometry than the state was made for, and where more than NearbySkin::kMaxBlocks blocks of
/// skin are under a single pad, pads ask the tree as a finger alone does: slower, the same.
Wrench stepTool(const Surface& surface, const ToolShape& shape, const FingerSettings& settings, ToolState& state,
                std::span<const ToolPose> poses, const LumpPlaces* lumps = nullptr) noexcept;

/// Lifts the tool: its next poses may be anywhere, and the motion in between makes no contact.
void lift(ToolState& state) noexcept;

}  // namespace palpate::contact
