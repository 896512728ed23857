// Faults of a finger along a path, tick by tick, in a microsecond or two each: the oracle of `palpate study hunt`.
//
// It sees outputs and a mesh and has its own geometry; nothing of `contact` but the plain data of finger_state.h, and
// nothing of `tree`. docs/howto/hunt.md describes each fault. Unlike the other oracles it keeps up with a run of
// ten million ticks: a free tip's side is only computed when it has left the ball round the last place that is known to
// hold no surface.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "lab/judges/fast_winding.h"
#include "lab/judges/surface_side.h"
#include "palpate/contact/finger_state.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::lab {

enum class Fault {
  fall,            ///< the finger is free, the tip is inside, and was outside or held before
  missed_contact,  ///< the tip went in without a force; a free sphere overlaps the skin from outside
  wrong_force,     ///< not finite, pulling, out of the friction cone, of a sphere sunk in, of a proxy off the skin
  step,            ///< the force changed by more than the tip's motion and the catch-up allow
  held_in_air,  ///< a force although the tip is outside, clear of the skin, and nothing lies between it and its proxy
  lump_force,   ///< the lumps' share is not the slope of their energy (lump_check.h)
  lump_step,    ///< it changed by more than the motions of tip and lumps allow
  lump_moved    ///< a lump went too far, or its motion made energy
};
inline constexpr std::size_t kFaults = 8;
/// "fall", "missed_contact", "wrong_force", "step_over_bound", "held_in_air", "lump_force", "lump_step", "lump_moved".
const char* nameOf(Fault fault);
std::optional<Fault> faultNamed(std::string_view name);

/// Ticks with a fault, and the first of them.
struct Finding {
  std::size_t ticks = 0;
  std::size_t first_tick = 0;
  const char* what = "";               ///< in words, of the first
  double measured = 0.0, bound = 0.0;  ///< first one's, in the unit that `what` names
};

struct HuntReport {
  std::size_t ticks = 0;
  std::size_t touching_ticks = 0;
  std::size_t events = 0;  ///< ticks whose status reports that contact was given up for another place
  /// Ticks with a tip that came out elsewhere and is held through the body by the side where it went in: no fault
  /// (docs/explanation/contact.md, thin parts).
  std::size_t held_through_ticks = 0;
  std::array<Finding, kFaults> findings;

  const Finding& of(Fault fault) const { return findings[static_cast<std::size_t>(fault)]; }
  bool clean() const;
};

/// The oracle's view of a body; immutable but for open bodies, whose `SurfaceSide` remembers: one thread at a time.
class OracleBody {
 public:
  /// `mesh` as repair left it. Throws Error for one without a triangle.
  OracleBody(mesh::TriangleMesh mesh, bool self_intersecting);
  OracleBody(const OracleBody&) = delete;  // its winding number looks at its tree
  OracleBody& operator=(const OracleBody&) = delete;

  const mesh::TriangleMesh& mesh() const { return mesh_; }
  const BoxTree& tree() const { return tree_; }
  bool closed() const { return closed_; }
  bool selfIntersecting() const { return self_intersecting_; }
  double diagonal() const { return diagonal_; }
  /// Rounding of finger and oracle together: nearer than this is on the surface.
  double tolerance() const { return 1e-9 * diagonal_; }
  double winding(const Vec3& point) const { return winding_.at(point); }
  /// On a torn body beyond doubt only; never on an open sheet, where half a turn is the most there is.
  bool inside(const Vec3& point) const { return winding(point) > (closed_ ? 0.5 : 0.75); }
  NearPoint nearest(const Vec3& point) const { return tree_.nearest(point, 1e3 * diagonal_ + 2.0 * far(point)); }
  /// Unit; zero for a triangle without area.
  Vec3 triangleNormal(Index triangle) const;
  /// The slow oracle, for sides at and beyond a border.
  SurfaceSide& slow() { return slow_; }

 private:
  double far(const Vec3& point) const { return (point - middle_).norm(); }

  mesh::TriangleMesh mesh_;
  bool self_intersecting_;
  BoxTree tree_;
  FastWinding winding_;
  SurfaceSide slow_;
  bool closed_;
  double diagonal_;
  Vec3 middle_;
};

/// One finger along one path: a new one is made for each. Settings and stiffness (the same everywhere, Hooke's law) in
/// the body's units.
class HuntOracle {
 public:
  HuntOracle(OracleBody& body, const contact::FingerSettings& settings, double stiffness);

  /// The next tick.
  void add(const contact::FingerOutput& output);
  const HuntReport& report() const { return report_; }

 private:
  enum class Past { unknown, outside, held, fallen };
  /// Round `centre` no surface is nearer than `radius`.
  struct ClearBall {
    Vec3 centre = Vec3::Zero();
    double radius = -1.0;
    bool inside = false;
  };

  void judgeForceStep(const contact::FingerOutput& o);
  void judgeFree(const contact::FingerOutput& o);
  void judgeFreeBesideBorder(const contact::FingerOutput& o);
  bool isBackOfFold(const Vec3& point);
  void judgeOverlap(const Vec3& tip, double distance, bool from_outside);
  void judgeOverlapBesideBorder(const contact::FingerOutput& o, double distance);
  std::array<Vec3, 4> waysBeside(const Vec3& from, const Vec3& to) const;
  /// The tip went through the skin itself since the last tick, not round a border.
  bool hasPassedThroughSkin(const Vec3& tip);
  bool hasLeftFold(const Vec3& tip);
  bool isFarFromBorder(const Vec3& place, double reach);
  /// Whether the last hold was away from borders, and cannot have come to one in this tick.
  bool wasHeldFarFromBorder(const Vec3& tip);
  /// How far off the skin a point's proxy may be.
  double pointTolerance() const;
  std::optional<Vec3> afloatAt(const contact::FingerOutput& o) const;
  void judgeAfloat(const contact::FingerOutput& o);
  void judgeTouching(const contact::FingerOutput& o);
  /// Whether the tip of a finger that was held came in by an opening since the last tick.
  bool hasPassedOpening(const Vec3& tip);
  /// For an open body only where every border is farther from the tip than its lag and its radius.
  bool isOutFarFromBorders(const contact::FingerOutput& o);
  void judgeHeldInAir(const contact::FingerOutput& o);
  bool isSkinBetween(const Vec3& from, const Vec3& to) const;
  void judgeForce(const contact::FingerOutput& o);
  void judgePoint(const contact::FingerOutput& o);
  void judgeSphere(const contact::FingerOutput& o);
  /// A push out of any of the surface's nearest features is right.
  bool pullsFromAll(const Vec3& force, const Vec3& place, double reach, bool by_normal);
  bool insideBall(const Vec3& point, double distance, ClearBall& ball);
  void reportFault(Fault fault, const char* what, double measured, double bound);

  OracleBody& body_;
  contact::FingerSettings settings_;
  double stiffness_, force_tolerance_;
  std::size_t tick_ = 0;
  bool first_ = true;
  bool exempt_ = false;              ///< inside from the start, or by an opening
  std::optional<Vec3> last_afloat_;  ///< a sphere's centre beyond a border, over the sheet continued flat
  Past past_ = Past::unknown;
  Vec3 last_tip_ = Vec3::Zero(), last_force_ = Vec3::Zero();
  // Of the last tick in which the finger was held: after it a tip may be free on the skin for some ticks.
  Vec3 held_tip_ = Vec3::Zero(), held_proxy_ = Vec3::Zero();
  std::uint32_t held_status_ = 0;
  double held_reach_ = 0.0;  ///< lag and radius
  ClearBall tip_ball_, centre_ball_;
  std::vector<Index> nearby_;
  std::array<std::size_t, kFaults> last_found_{};  ///< tick + 1: a tick counts once a fault
  HuntReport report_;
};

}  // namespace palpate::lab
