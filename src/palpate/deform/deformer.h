// Functional shape matched deformation (FSMD): contacts in, deformed skin out.
//
//   contacts ─ check, cap ─► frames ─ region search ─► regions ─ couple ─► amplitudes ─ kernels ─► surface, changes
//
// A vertex in the region moves by  -profile(q_n) depth n + profile(q_t) f_adj (P - A),  depth and drag capped, q_n and
// q_t its location ratios in the ellipses of the normal and the tangential part, centred at the friction anchor A. With
// one uncapped contact the skin at A follows the tip exactly.
// Based on: Ji, dissertation 2008, chapter 4, with E14, E17, E19, E21, E23 and E25 (docs/deformation.md).
#pragma once

#include <span>
#include <vector>

#include "palpate/deform/frame.h"
#include "palpate/deform/region.h"
#include "palpate/deform/surface.h"

namespace palpate::deform {

/// How the normals of the deformed surface are made.
enum class Normals : std::uint8_t {
  analytic,    ///< of the smooth deformation, in the same pass as the displacement (default)
  recomputed,  ///< area-weighted from the deformed triangles: the reference, several times slower
  /// The same normals by subtracting and adding only the triangles that changed (normals.h): a matter of
  /// FormDeformer; Deformer recomputes.
  incremental,
};

struct Settings {
  TissueSettings tissue;
  Normals normals = Normals::analytic;
  bool strain = false;            ///< also write the strain of (4.20)
  std::size_t max_contacts = 16;  ///< contacts beyond are ignored and reported
};

/// Why a contact had no (full) effect; bits of Report::status.
enum Status : std::uint32_t {
  kIgnoredNotFinite = 1,     ///< NaN, infinity or a normal without direction
  kIgnoredNoTriangle = 2,    ///< the anchor's triangle is not one of the skin's
  kIgnoredOverCapacity = 4,  ///< more contacts than Settings::max_contacts
  kDegenerateRegion = 8,     ///< an ellipse without area: its part moves nothing
  kNoVertexInRegion = 16,    ///< wants to move, but no vertex lies inside (ellipse smaller than the triangles)
};

struct Report {
  std::uint32_t status = 0;
  Index moved_vertices = 0;    ///< in the region of at least one contact
  Index visited_vertices = 0;  ///< looked at by the region searches, in whole blocks
};

/// Status bits of a contact that cannot be framed on a skin of so many triangles; 0 for one that can.
inline std::uint32_t whyIgnored(const Contact& contact, std::size_t triangles) noexcept {
  if (!isUsable(contact)) return kIgnoredNotFinite;
  return contact.anchor_triangle < triangles ? 0u : std::uint32_t{kIgnoredNoTriangle};
}

class Deformer {
 public:
  /// Allocates everything that apply needs. The skin must outlive the deformer.
  explicit Deformer(const Skin& skin, const Settings& settings = {});
  Deformer(const Skin&& skin, const Settings& settings = {}) = delete;

  /// Brings the surface from whatever it was to the deformation by these contacts (none: to rest). Costs time in
  /// proportion to the regions of this and the last call. The result depends on nothing but skin, settings and
  /// contacts. Allocates nothing. One thread at a time per deformer and surface.
  Report apply(std::span<const Contact> contacts, DeformedSurface& surface) noexcept;

 private:
  /// A contact's region in one block; the entries of a block form a chain.
  struct Entry {
    std::uint64_t region;
    Index contact;
    Index next;
  };

  void frameContacts(std::span<const Contact> contacts, Report& report) noexcept;
  void findRegions(Report& report) noexcept;
  void noteCoupling(std::size_t contact) noexcept;
  void solveAmplitudes() noexcept;
  void collectBlocks() noexcept;
  /// Consecutive blocks that lie in the region of one contact as a whole, about to be displaced in one go.
  struct Run {
    Index first = 0;
    Index end = 0;
    Index contact = 0;
  };

  void displace(DeformedSurface& surface, Report& report) noexcept;
  void displaceBlock(Index block, Run& run, DeformedSurface& surface, Report& report) noexcept;
  void displaceRun(Run& run, DeformedSurface& surface, Report& report) noexcept;
  Index displaceParts(Index block, DeformedSurface& surface) noexcept;
  void finishNormalsAndStrain(DeformedSurface& surface) noexcept;

  const Skin& skin_;
  Settings settings_;
  RegionSearch search_;
  std::vector<ContactFrame> frames_;
  std::vector<ContactLanes> lanes_;
  std::vector<Index> first_part_;  // per contact, contacts + 1 entries: its region in parts_
  std::vector<BlockPart> parts_;
  std::vector<double> normal_coupling_, tangential_coupling_;
  std::vector<double> depths_, amplitudes_;
  std::vector<Vec3> drags_, shifts_;
  std::vector<Entry> entries_;
  std::vector<Index> first_entry_;  // per block
  std::vector<ContactOnBlock> on_block_;
  BlockSet moved_;     // blocks with vertices of a region
  BlockSet affected_;  // these, and with recomputed normals or strain the blocks next to them
};

/// The whole thing at once, for a single picture: skin, deformer and surface built, used and thrown away.
DeformedSurface deformed(const mesh::TriangleMesh& mesh, std::span<const Contact> contacts,
                         const Settings& settings = {});

}  // namespace palpate::deform
