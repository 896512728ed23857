// The general way to displace: every profile, region and literal reading of the dissertation, vertex by vertex in
// double.
//
// One of the two things that Deformer's pipeline can be filled with (the other: fast_displacement.h). Some 20 times the
// time of the kernels (docs/reference/benchmarks.md), and still far below a frame for a fingertip. With default
// forms both give the same surface within 1e-4 mm. Based on: Ji, dissertation 2008, sections 4.2 to 4.6, with E14, E15,
// E18, E19, E21 and E23 in both readings.
#pragma once

#include <limits>
#include <optional>

#include "palpate/deform/forms.h"
#include "palpate/deform/frame.h"
#include "palpate/deform/kernels/kernels.h"
#include "palpate/deform/region_by_rings.h"
#include "palpate/deform/region_frame.h"
#include "palpate/hdb/vertex_search.h"
#include "palpate/tissue/profile_curve.h"

namespace palpate::deform {

using FormedContact = FramedContact<RegionFrame>;

/// The contact must be usable.
FormedContact formedContact(const Contact& contact, const FormSettings& forms) noexcept;

/// True if a point lies in one of the two regions.
bool holds(const FormedContact& frame, const Vec3& place) noexcept;

/// The curves of both parts.
struct FormCurves {
  /// Throws Error for an invalid profile.
  explicit FormCurves(const FormSettings& forms);
  tissue::ProfileCurve press;
  tissue::ProfileCurve drag;
  tissue::RadialTerm radial;
};

/// Displacement of a vertex, and the gradient of the deformed place by the place at rest.
struct Motion {
  Vec3 displacement = Vec3::Zero();
  Mat3 gradient = Mat3::Identity();
};

/// Adds what this contact does at a place, with the press of its centre by `amplitude_mm` and its drag by `shift_mm`.
void addMotion(const FormedContact& frame, const FormCurves& curves, double amplitude_mm, const Vec3& shift_mm,
               const Vec3& place, Motion& motion) noexcept;

/// The unit normal that `rest_normal` is turned into: cof(gradient) n; the rest normal where that vanishes.
Vec3 turnedNormal(const Mat3& gradient, const Vec3& rest_normal) noexcept;

class GeneralDisplacement {
 public:
  using Frame = FormedContact;
  struct Mover {
    const Frame* frame;
    double amplitude_mm;
    Vec3 shift_mm;
  };

  /// Throws Error for an invalid profile, and as hdb::VertexSearch does.
  GeneralDisplacement(const Skin& skin, const FormSettings& forms);

  Frame frame(const Contact& contact) const noexcept { return formedContact(contact, forms_); }

  std::span<const BlockPart> findRegion(const Frame& frame) noexcept;
  std::span<const BlockPart> edges() const noexcept { return search_.edges(); }
  bool reached(Index vertex) const noexcept { return search_.reached(vertex); }
  Index visitedVertices() const noexcept { return search_.visited(); }

  double pressShare(const Frame& from, const Vec3& offset) const noexcept;
  double dragShare(const Frame& from, const Vec3& offset) const noexcept;

  // Inputs of shear_limit.h: the shares that the skin has from q on, a bound of a place's motion, the slope of a drag
  // along itself, the contacts' largest shear (any form may shear without bound), half axes of a region.
  double pressRoom(const Frame& frame, double q) const noexcept;
  double dragRoom(const Frame& frame, double q) const noexcept;
  double mostAt(const Frame& frame, double press_mm, double drag_mm, const Vec3& offset) const noexcept;
  double dragSlope(const Frame& frame, const Vec3& shift_mm) const noexcept;
  static void addShear(const Frame&, const Mover&, ShearBound& shear) noexcept {
    shear.press = std::numeric_limits<double>::infinity();
  }
  static void addShearNear(const Frame& frame, const Mover& mover, const Vec3&, double, ShearBound& shear) noexcept {
    addShear(frame, mover, shear);
  }
  static double halfMajor(const RegionFrame& region) noexcept { return longestRadius(region); }
  static double pressOf(const Mover& mover) noexcept { return std::abs(mover.amplitude_mm); }
  static double dragOf(const Mover& mover) noexcept { return mover.shift_mm.norm(); }

  static Mover mover(const Frame& frame, double amplitude_mm, const Vec3& shift_mm) noexcept {
    return {&frame, amplitude_mm, shift_mm};
  }
  /// Even a contact that the others press out: its vertices count as moved, by nothing.
  static bool moves(const Mover&) noexcept { return true; }
  /// Not asked, since no slope is a bound (addShear).
  static std::uint64_t strainedVertices(std::span<const Mover>, const EdgeBlock&, std::uint64_t of, double) noexcept {
    return of;
  }
  void displaceBlock(std::span<const OnBlock<Mover>> movers, const RestBlock& rest,
                     const DeformedBlock& out) const noexcept;
  void displaceWholeBlocks(const Mover& mover, Index blocks, const RestBlock& rest,
                           const DeformedBlock& out) const noexcept;

 private:
  void displaceVertex(std::span<const OnBlock<Mover>> movers, Index bit, const RestBlock& rest,
                      const DeformedBlock& out) const noexcept;

  const Skin& skin_;
  FormSettings forms_;
  FormCurves curves_;
  double drag_slope_ = 0.0;  // the largest of its curve
  RegionByRings search_;
  std::optional<hdb::VertexSearch> octree_;  // Search::octree
};

}  // namespace palpate::deform
