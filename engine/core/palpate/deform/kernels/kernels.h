// The inner loops of the fast displacement over one block of 64 vertices (or one tile of 64 blocks), compiled for
// several instruction sets; the widest that the machine has is chosen at run time.
//
// kernels.cpp explains the arithmetic. Every number of a contact is here in float, ready to be broadcast.
#pragma once

#include <cstdint>
#include <span>

#include "palpate/deform/kernels/blocks.h"
#include "palpate/tissue/layered_curve.h"

namespace palpate::deform {

/// A curve of layered tissue (tissue/layered_curve.h) ready to be broadcast.
struct CurveLanes {
  float bend = 0.0f;
  float rim = 0.0f;    ///< the bell there
  float scale = 1.0f;  ///< 1 / (1 - rim)
  float terms[tissue::kCurveTerms] = {};
};

/// Steps of the largest motion of a part of layered tissue from q = i / kRoomSteps on, as a share of its centre's.
inline constexpr int kRoomSteps = 16;

/// One of the two parts of a contact (normal or tangential): displacement = profile(q) shift with
/// q^2 = (along . d)^2 + (across . d)^2 + rise^2 + outside, d = rest position - anchor. The rise ends a region along
/// the normal: 0 up to the height `level`, then it grows by `slope` a mm.
struct PartLanes {
  float along[3] = {};   ///< unit major axis / half major
  float across[3] = {};  ///< unit minor axis / half minor
  float shift[3] = {};   ///< motion of the centre, mm
  float level = 0.0f;    ///< mm above and below the plane
  float slope = 0.0f;    ///< slope of the rise beyond it, 1/mm
  float outside = 2.0f;  ///< 0 for a part that acts, 2 (no vertex has q < 1) for one that does not
  // For layered tissue only (ContactLanes::layered):
  CurveLanes share;
  float room[kRoomSteps] = {};
};

struct ContactLanes {
  float anchor[3] = {};
  float facing[3] = {};  ///< the contact's normal: only vertices whose normal is on its side belong to the region
  PartLanes normal;
  PartLanes tangential;
  /// Layered tissue: the parts fall off as their own `share` in place of the half Gaussian, and the press, whose region
  /// is a circle then, also moves outward by q outward(q) of its depth.
  bool layered = false;
  float outward[tissue::kCurveTerms] = {};  ///< bend of normal.share
  float outward_mm2 = 0.0f;                 ///< depth of the centre times the circle's radius
  float plane[6] = {};                      ///< xx xy xz yy yz zz of (I - n n^T) / radius^2
};

using ContactOnBlock = OnBlock<ContactLanes>;

/// Blocks of a tile, as far as their boxes decide; one bit a block. Padding answers like a block.
struct BlocksInside {
  std::uint64_t whole;    ///< every vertex is inside (as verticesInside has it), none steep, and the block is level
  std::uint64_t touched;  ///< some vertices may be inside but for the side they face
  std::uint64_t level;    ///< no vertex rises in a part that moves it
  std::uint64_t facing;   ///< every vertex faces the contact, and none is steep
};
BlocksInside insideBlocks(const ContactLanes& contact, const TileBounds& bounds) noexcept;

/// The cosine between a vertex' normal and the contact's below which skin there is steep, a wall seen from above: 84
/// degrees. Below 0 it faces away.
inline constexpr float kSteepFacing = 0.1f;

/// BlocksInside for one block.
struct BlockSeen {
  bool is_level;   ///< the height of its vertices need not be tested
  bool is_facing;  ///< nor the side that they face
};

/// Vertices with q < 1 for one of the parts, by the side they face; one bit a vertex. Padding answers like a vertex.
struct VerticesInside {
  std::uint64_t facing;  ///< the contact
  std::uint64_t steep;   ///< or turned away
};
VerticesInside verticesInside(const ContactLanes& contact, const RestBlock& rest, BlockSeen seen) noexcept;

/// Among vertices `of` a block, those joined to any that the contacts, wherever their regions end, may together move by
/// more than `most_mm` or than the room next to the vertex; and some more.
std::uint64_t strainedVertices(std::span<const ContactLanes> contacts, const EdgeBlock& edge, std::uint64_t of,
                               float most_mm) noexcept;

/// Largest shear of a block by contacts, ready to be broadcast (ShearBound).
struct ShearLanes {
  float press = 0.0f;
  float drag = 0.0f;
  float press_bend = 0.0f;
  float drag_bend = 0.0f;
  float towards[3] = {};    ///< the direction of the press; 0 for several
  float jump = 0.0f;        ///< jump of a triangle's slope across the end of a region, over the largest slope
  float least_area = 0.0f;  ///< smallest share of area of a triangle that counts as up
};

/// Vertices at which it is not certain that every triangle keeps its area: those of a triangle that folds are all among
/// them.
std::uint64_t doubtfulVertices(const ShearLanes& shear, const FoldBlock& block) noexcept;

/// Writes all 64 vertices: displacement as the sum over the contacts, the analytic normal of the sum. Vertices in no
/// region get their rest values bit by bit.
void displaceBlock(std::span<const ContactOnBlock> contacts, const RestBlock& rest, const DeformedBlock& out) noexcept;

/// The same for a run of blocks all of whose vertices are in the region of one contact and of no other: most of the
/// work, without a mask.
void displaceWholeBlocks(const ContactLanes& contact, Index blocks, const RestBlock& rest,
                         const DeformedBlock& out) noexcept;

/// Restores a run of blocks to rest, bit by bit.
void restoreBlocks(Index blocks, const RestBlock& rest, const DeformedBlock& out) noexcept;

}  // namespace palpate::deform
