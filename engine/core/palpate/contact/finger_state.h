// Input, memory and output of a tick of the haptic finger: plain data for all code that records, sends, draws or
// deforms by what fingers feel. The tick itself is finger.h.
//
// Lengths in mm, forces in N, in the body's frame.
#pragma once

#include <array>
#include <cstdint>

#include "palpate/base/vec.h"
#include "palpate/tree/closest_on_triangle.h"

namespace palpate::contact {

/// Largest share of the force that all terms of relaxation may take: tissue never gives way completely.
inline constexpr double kMaxRelaxation = 0.9;

/// How the force falls while the skin is held: by which share of what it would be at once, and over which time
/// (relaxation.h). Two terms at most; a share of 0 is none.
struct Relaxation {
  double share = 0.0;
  double time_s = 1.0;
  double share_2 = 0.0;
  double time_2_s = 5.0;
  bool on() const noexcept { return share > 0.0 || share_2 > 0.0; }
};

struct FingerSettings {
  double radius_mm = 0.0;  ///< 0 is a point, 8 a fingertip
  /// k_t / k_n. 1 is this engine's choice: tissue has 0.6 to 1.1. 0.23 is outside it, but lets the skin follow 20 mm at
  /// 10 mm depth, as the dissertation has it (E2).
  double stiffness_ratio = 1.0;
  double mu_static = 0.46;
  double mu_dynamic = 0.44;
  /// The deepest depth that is felt; a tip that is outside the body and farther than this from its proxy is released.
  double max_depth_mm = 40.0;
  double tick_s = 0.001;
  /// The proxy moves at most twice as far as the tip plus this speed's share of a tick. It bounds the force step where
  /// a ridge lets the proxy go (100 mm/s: 0.1 mm a tick, 0.05 N at 0.5 N/mm), and how fast a force fades that has lost
  /// its reason.
  double catch_up_mm_per_s = 100.0;
  bool force_shading = false;  ///< round off facets: for coarse meshes of smooth bodies; a point finger only
  Relaxation relaxation = {};
};

enum class Touch : std::uint8_t { free, stick, slip };

/// Bits of FingerOutput::status.
enum StatusBit : std::uint32_t {
  kTipLost = 1u << 0,        ///< tip not finite or absurdly far: no force, state kept as it was
  kCatchingUp = 1u << 1,     ///< the proxy used up its path in this tick, or the force its step
  kTooDeep = 1u << 2,        ///< deeper than max_depth_mm: the force no longer grows
  kLettingGo = 1u << 3,      ///< the contact has ended, its force fades: the tip came out elsewhere
  kAtBorder = 1u << 4,       ///< the force fades because the sheet ends here
  kStartedInside = 1u << 5,  ///< a sphere that overlaps the skin is being pushed out
  kUnsettled = 1u << 6,      ///< a sphere used up its rounds; it continues in the next tick (kCatchingUp is set too)
  kShadingFailed = 1u << 7,  ///< force shading fell back to the facets
};

/// A place on the skin, on a triangle (record of the tree).
struct SurfacePoint {
  Vec3 position = Vec3::Zero();
  Index triangle = kNoIndex;
  tree::Feature feature = tree::Feature::face;
};

/// Where a sphere stood on the skin when its centre came to rest: its next tick need not ask the whole skin again.
/// Holds only where the centre has not moved since; never changes what is felt.
struct StandingPlaces {
  static constexpr int kMax = 8;  ///< a sphere that rests on more queries again
  std::array<SurfacePoint, kMax> places;
  int count = -1;  ///< -1: not known
};

/// A place that was pressed and comes back. Depths here are effective ones (tissue/force_law.h): 1 mm is 1 mm under
/// the linear law only.
struct Dent {
  Vec3 place = Vec3::Zero();  ///< on the skin
  double rest_mm = 0.0;       ///< how deep it still is; 0: there is none
  Index triangle = kNoIndex;  ///< of the mesh
};

/// The skin's memory of presses (relaxation.h); zeros without relaxation.
struct SkinMemory {
  std::array<double, 2> under_mm{};  ///< the eased depth of each term, effective: of the skin under the finger
  std::array<double, 2> left_mm{};   ///< of the dent that it left
  Dent dent;                         ///< that dent, as FingerOutput has it
};

/// A press as the lumps under it feel it (lump_force.h): of the last tick.
struct LumpPress {
  Vec3 tip = Vec3::Zero();
  Vec3 normal = Vec3::Zero();
  double depth_mm = 0.0;  ///< that the force counts
  double share = 0.0;     ///< of the force that relaxation leaves; 0: nothing is pressed
};

/// All that a finger remembers between two ticks. Plain data; value-initialised it has never touched anything.
struct FingerState {
  bool knows_tip = false;  ///< false until the first usable tip
  bool touching = false;
  bool slipping = false;
  /// The session began inside of overlapping parts, and nothing was felt since. Of an open body: the finger was inside
  /// when it last landed, and its tip has not been outside since.
  bool from_inside = false;
  Vec3 tip = Vec3::Zero();     ///< of the last usable tick
  SurfacePoint proxy;          ///< point: P. Sphere: where it touches
  SurfacePoint anchor;         ///< on the skin
  Vec3 centre = Vec3::Zero();  ///< sphere: C, where it rests on the skin; detecting box: the god object
  bool fits = false;           ///< sphere only: at C it does not sink into the skin
  StandingPlaces standing;     ///< sphere only: at C
  bool guarded = false;        ///< a point that is felt as a very small sphere: sheets pierce each other here
  Vec3 hold = Vec3::Zero();    ///< A as a point in space: where the pull of friction ends
  Vec3 felt = Vec3::Zero();    ///< the depth that was felt along its normal, mm; fades after the skin was left
  Vec3 force = Vec3::Zero();   ///< on the tip, N
  SkinMemory memory = {};
  LumpPress lumps = {};  ///< only where there are any
};

/// One finger's output in one tick; value-initialised it touches nothing, at the origin.
struct FingerOutput {
  Vec3 tip = Vec3::Zero();
  Vec3 proxy =
      Vec3::Zero();  ///< P, on the skin (a sphere in a valley: on the sphere, between its feet); the tip when free
  Vec3 anchor = Vec3::Zero();  ///< A, on the skin; the tip when free
  /// Where friction holds the tip, a point in space; the tip when free. While it slips it lies in the plane that
  /// touches the finger at P. The anchor is the skin nearest to it.
  Vec3 hold = Vec3::Zero();
  Vec3 normal = Vec3::Zero();  ///< unit, out of the skin; zero when free
  Vec3 force = Vec3::Zero();   ///< on the tip, N
  double depth_mm = 0.0;
  double tissue_mm = 0.0;  ///< felt thickness over the bone under the proxy; 0 when free and where it is not known
  double finger_mm = 0.0;  ///< radius of the finger; 0: a point, or not known
  Touch touch = Touch::free;
  Index triangle = kNoIndex;         ///< of the mesh, under the proxy
  Index anchor_triangle = kNoIndex;  ///< of the mesh, under the anchor
  std::uint32_t status = 0;          ///< StatusBits
  double rest_mm = 0.0;  ///< effective depth at which the skin under the finger would stay by itself; 0 when free
  Dent dent = {};        ///< what the finger left and is still coming back
  /// The nearest of the world's mobile lumps that the finger feels; kNoIndex: none.
  Index lump = kNoIndex;
  Vec2 lump_moved_mm = Vec2::Zero();  ///< how far that one is from its place, across and up (lump_force.h)
  Vec3 lump_force = Vec3::Zero();     ///< of `force`, what the lumps add, N
  double lump_share = 0.0;            ///< their normal force over that of the press without them; 0 where that is 0
};

}  // namespace palpate::contact
