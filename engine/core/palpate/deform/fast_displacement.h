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
#include "palpate/deform/skin.h"

namespace palpate::deform {

// Finds the vertices of a contact by whole blocks: the search that keeps the far side of the body, the other leg and
// the arm out. Second step of an apply, for ellipses; regions of any shape are found in region_by_rings.h.
//
// The region of a contact is the set of vertices that lie in one of its ellipses (seen along the contact's normal, and
// not too far above or below its plane: kernels.h), face the contact, and can be reached from the anchor's triangle
// along edges through such vertices; the three corners of that triangle always count as reached (E23: an ellipse
// smaller than a triangle must not end the search).
//
// The search gives exactly that set, and decides most of it without looking at a vertex. Boxes show which blocks of a
// tile lie inside as a whole; those are flooded by words of blocks. The others at the rim are flooded by words of
// vertices, and only these have their vertices tested. Nothing is looked at that the flood does not touch.
// Based on: Ji, dissertation 2008, section 4.5 (rings of neighbour nodes), with E23.

/// The search and its working memory.
class RegionByBlocks {
 public:
  explicit RegionByBlocks(const Skin& skin);

  /// The region around `anchor_triangle`, in no particular order. Valid until the next call. No allocation.
  std::span<const BlockPart> find(const Skin& skin, const ContactLanes& contact,
                                  const Triangle& anchor_triangle) noexcept;

  /// Where the region has an edge or a wall: vertices in it that are steep (kernels.h), and vertices next to it that
  /// lie in an ellipse and stay because they face away; some more of that kind. Valid until the next call of find.
  std::span<const BlockPart> edges() const noexcept { return edges_; }
  /// True if the last search reached this vertex.
  bool reached(Index vertex) const noexcept;
  /// Blocks that the last search reached as a whole or looked into.
  Index visitedBlocks() const noexcept { return visited_blocks_; }

 private:
  /// A tile, by bits of its blocks. A block is `whole` if it lies inside and is connected: one vertex of it reached is
  /// all reached. It is at the `rim` if nothing is known of it as a whole. Any other lies outside.
  struct Tile {
    std::uint64_t whole = 0;
    std::uint64_t rim = 0;
    std::uint64_t level = 0;    // where the height over the contact's plane does not matter
    std::uint64_t facing = 0;   // where every vertex faces the contact
    std::uint64_t reached = 0;  // part of `whole`
    std::uint64_t pending = 0;  // part of `whole`, about to be reached; not 0 means the tile waits in open_tiles_
    bool known = false;
  };
  /// A block at the rim, by bits of its vertices. Half a cache line: the search lives on these.
  struct RimBlock {
    std::uint64_t outside = 0;  // known not to belong; nothing is known before the block is looked into
    std::uint64_t reached = 0;
    std::uint64_t pending = 0;  // joined to reached vertices of other blocks
    bool looked_into = false;
    bool waits = false;  // in the queue
    std::uint64_t missing() const { return ~(outside | reached | pending); }
  };

  /// One search: what find was called with.
  struct Query {
    const Skin& skin;
    const ContactLanes& contact;
  };
  Tile& tileAt(const Query& query, Index tile) noexcept;
  void seedVertex(const Query& query, Index vertex) noexcept;
  void seedWhole(Index tile, std::uint64_t blocks) noexcept;
  void wake(Index rim_block) noexcept;
  void wakeRim(Index tile, std::uint64_t blocks) noexcept;
  void growTile(const Query& query, Index tile) noexcept;
  void growBlock(const Query& query, Index block) noexcept;
  void lookInto(const Query& query, Index block) noexcept;
  std::uint64_t besideWholeBlocks(const Query& query, Index block) const noexcept;
  void spread(const Query& query, Index block, std::uint64_t from) noexcept;
  void listFound(const Skin& skin) noexcept;
  void forget() noexcept;

  std::vector<Tile> tiles_;
  std::vector<RimBlock> rim_;  // per block
  std::vector<Index> known_tiles_;
  std::vector<Index> open_tiles_;
  std::vector<Index> looked_into_;
  std::vector<Index> queue_;  // blocks at the rim: a ring with room for every block, its size a power of two
  std::size_t head_ = 0;
  std::size_t tail_ = 0;
  std::vector<BlockPart> found_;
  std::vector<BlockPart> edges_;
  Index visited_blocks_ = 0;
};

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
