// The fast way to displace: the half Gaussian or layered tissue in ellipses, every formula as corrected, in the
// kernels' floats.
//
// One of the two things that Deformer's pipeline can be filled with (the other: general_displacement.h): it frames a
// contact, finds its region, computes the coupling of contacts, and moves blocks of vertices.
// Based on: Ji, dissertation 2008, chapter 4, with E14, E18, E19 and E23.
#pragma once

#include <span>

#include "palpate/deform/fold_bounds.h"
#include "palpate/deform/forms.h"
#include "palpate/deform/frame.h"
#include "palpate/deform/kernels/kernels.h"
#include "palpate/deform/region_by_blocks.h"
#include "palpate/deform/skin.h"

namespace palpate::deform {

using EllipseContact = FramedContact<FlatEllipse>;

/// The contact must be usable.
EllipseContact frameOf(const Contact& contact, const TissueSettings& tissue) noexcept;

/// The frame as the kernels take it; `amplitude_mm` and `shift_mm` are what its centre moves by.
ContactLanes lanesOf(const EllipseContact& frame, double amplitude_mm, const Vec3& shift_mm) noexcept;

class FastDisplacement {
 public:
  using Frame = EllipseContact;
  using Mover = ContactLanes;

  FastDisplacement(const Skin& skin, const FormSettings& forms)
      : skin_(skin), tissue_(forms.common.tissue), search_(skin) {}

  Frame frame(const Contact& contact) const noexcept { return frameOf(contact, tissue_); }

  std::span<const BlockPart> findRegion(const Frame& frame) noexcept {
    return search_.find(skin_, lanesOf(frame, 0.0, Vec3::Zero()), skin_.triangles[frame.anchor_triangle]);
  }
  std::span<const BlockPart> edges() const noexcept { return search_.edges(); }
  bool reached(Index vertex) const noexcept { return search_.reached(vertex); }
  Index visitedVertices() const noexcept { return search_.visitedBlocks() * kBlockVertices; }

  static double pressShare(const Frame& from, const Vec3& offset) noexcept;
  static double dragShare(const Frame& from, const Vec3& offset) noexcept;

  // Inputs of shear_limit.h: the shares that the skin has from q on, a bound of a place's motion, the slope of a drag
  // along itself, the contacts' largest shear, half axes of a region, the centre's motion.
  static double pressRoom(const Frame& frame, double q) noexcept;
  static double dragRoom(const Frame& frame, double q) noexcept;
  static double mostAt(const Frame& frame, double press_mm, double drag_mm, const Vec3& offset) noexcept;
  static double dragSlope(const Frame& frame, const Vec3& shift_mm) noexcept;
  static void addShear(const Frame& frame, const Mover& mover, ShearBound& shear) noexcept;
  /// The same within a ball: layered tissue is steep near the finger only.
  static void addShearNear(const Frame& frame, const Mover& mover, const Vec3& centre, double radius_mm,
                           ShearBound& shear) noexcept;
  static double halfMajor(const FlatEllipse& ellipse) noexcept { return ellipse.half_major_mm; }
  static double pressOf(const Mover& mover) noexcept;
  static double dragOf(const Mover& mover) noexcept;

  static Mover mover(const Frame& frame, double amplitude_mm, const Vec3& shift_mm) noexcept {
    return lanesOf(frame, amplitude_mm, shift_mm);
  }
  static bool moves(const Mover& mover) noexcept;
  static std::uint64_t strainedVertices(std::span<const Mover> movers, const EdgeBlock& edge, std::uint64_t of,
                                        double most_mm) noexcept {
    return deform::strainedVertices(movers, edge, of, static_cast<float>(most_mm));
  }
  static void displaceBlock(std::span<const OnBlock<Mover>> movers, const RestBlock& rest,
                            const DeformedBlock& out) noexcept {
    deform::displaceBlock(movers, rest, out);
  }
  static void displaceWholeBlocks(const Mover& mover, Index blocks, const RestBlock& rest,
                                  const DeformedBlock& out) noexcept {
    deform::displaceWholeBlocks(mover, blocks, rest, out);
  }

 private:
  const Skin& skin_;
  TissueSettings tissue_;
  RegionByBlocks search_;
};

}  // namespace palpate::deform
