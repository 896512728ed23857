// The inner loops of the fast displacement over one block of 64 vertices (or one tile of 64 blocks), compiled for
// several instruction sets; the widest that the machine has is chosen at run time.
//
// kernels.cpp explains the arithmetic. Every number of a contact is here in float, ready to be broadcast.
#pragma once

#include <cstdint>
#include <span>

#include "palpate/deform/blocks.h"

namespace palpate::deform {

/// One of the two parts of a contact (normal or tangential): displacement = profile(q) shift with
/// q^2 = (along . d)^2 + (across . d)^2 + outside, d = rest position - anchor.
struct PartLanes {
  float along[3] = {};   ///< unit major axis / half major
  float across[3] = {};  ///< unit minor axis / half minor
  float shift[3] = {};   ///< what the centre moves by, mm
  float outside = 2.0f;  ///< 0 for a part that acts, 2 (no vertex has q < 1) for one that does not
};

struct ContactLanes {
  float anchor[3] = {};
  float facing[3] = {};  ///< the contact's normal: only vertices whose normal is on its side belong to the region
  PartLanes normal;
  PartLanes tangential;
};

using ContactOnBlock = OnBlock<ContactLanes>;

/// Blocks of a tile by what their boxes tell; one bit a block. Padding answers like a block.
struct BlocksInside {
  std::uint64_t whole;    ///< every vertex is inside (as insideMask has it)
  std::uint64_t touched;  ///< some vertices may be
};
BlocksInside insideBlocks(const ContactLanes& contact, const TileBounds& bounds) noexcept;

/// Bit i is set if vertex i faces the contact and has q < 1 for one of its parts. Padding answers like a vertex.
std::uint64_t insideMask(const ContactLanes& contact, const RestBlock& rest) noexcept;

/// Writes all 64 vertices: displacement as the sum over the contacts, the analytic normal of the sum. Vertices in no
/// region get their rest values bit by bit.
void displaceBlock(std::span<const ContactOnBlock> contacts, const RestBlock& rest, const DeformedBlock& out) noexcept;

/// The same for a run of blocks all of whose vertices are in the region of one contact and of no other: most of the
/// work, without a mask.
void displaceWholeBlocks(const ContactLanes& contact, Index blocks, const RestBlock& rest,
                         const DeformedBlock& out) noexcept;

/// Brings a run of blocks back to rest, bit by bit.
void restoreBlocks(Index blocks, const RestBlock& rest, const DeformedBlock& out) noexcept;

}  // namespace palpate::deform
