// Functional shape matched deformation (FSMD): contacts in, deformed skin out.
//
//   contacts ─ frame, find ─► regions ─ combine ─► amplitudes ─ chain ─► blocks ─ displace, hold, finish ─► surface
//
// A vertex in the region moves by  -profile(q_n) depth n + profile(q_t) f_adj (P - A),  depth and drag capped, q_n and
// q_t its location ratios in the regions of the normal and the tangential part, centred at the friction anchor A. With
// one uncapped contact the skin at A follows the tip exactly.
//
// There is one pipeline and there are two ways to displace a vertex: the fast one (fast_displacement.h: half Gaussian,
// ellipses, text as corrected; vectors of floats) and the general one (general_displacement.h: every form that forms.h
// names; vertex by vertex in double). The fast one is used where it supports the forms.
// Based on: Ji, dissertation 2008, chapter 4, with E14, E17, E19, E21, E23 and E25 (docs/explanation/deformation.md).
#pragma once

#include <memory>
#include <span>

#include "palpate/deform/forms.h"
#include "palpate/deform/surface.h"

namespace palpate::deform {

/// Reasons why a contact had no (full) effect; bits of Report::status.
enum Status : std::uint32_t {
  kIgnoredNotFinite = 1,     ///< NaN, infinity or a normal without direction
  kIgnoredNoTriangle = 2,    ///< the anchor's triangle is not one of the skin's
  kIgnoredOverCapacity = 4,  ///< more contacts than Settings::max_contacts
  kDegenerateRegion = 8,     ///< a region without area: its part moves nothing
  kNoVertexInRegion = 16,    ///< wants to move, but no vertex lies inside (ellipse smaller than the triangles)
};

struct Report {
  std::uint32_t status = 0;
  Index moved_vertices = 0;     ///< in the region of at least one contact
  Index visited_vertices = 0;   ///< looked at by the region searches; in whole blocks by the fast one
  Index held_vertices = 0;      ///< part of moved_vertices: held back so that the skin neither tears nor folds
  Index changed_triangles = 0;  ///< normals computed again; 0 unless Normals::incremental
};

/// Way of displacing.
enum class Way : std::uint8_t {
  chosen,   ///< fast where it supports the forms (needsForms), general otherwise
  general,  ///< general whatever the forms: for comparison
};

class Deformer {
 public:
  /// Allocates everything that apply needs. The skin must outlive the deformer. Throws Error for an invalid profile
  /// (ProfileCurve).
  explicit Deformer(const Skin& skin, const FormSettings& forms = {}, Way way = Way::chosen);
  Deformer(const Skin& skin, const Settings& settings);
  Deformer(const Skin&& skin, const FormSettings& forms = {}, Way way = Way::chosen) = delete;
  Deformer(const Skin&& skin, const Settings& settings) = delete;
  Deformer(Deformer&&) noexcept;
  Deformer& operator=(Deformer&&) noexcept;
  ~Deformer();

  /// Deforms the surface, whatever it was before, by these contacts (none: to rest). Contacts carry their regions:
  /// formedRegions (forms.h) makes those of these forms. Costs time in proportion to the regions of this and the last
  /// call. The result depends on nothing but skin, forms and contacts. Allocates nothing. One thread at a time per
  /// deformer and surface.
  Report apply(std::span<const Contact> contacts, DeformedSurface& surface) noexcept;

  /// True if it displaces the fast way.
  bool isFast() const noexcept;

 private:
  template <class Displacement>
  class Pipeline;
  struct Ways;

  std::unique_ptr<Ways> ways_;
};

/// The whole thing at once, for a single picture: skin, deformer and surface built, used and thrown away.
DeformedSurface deformed(const mesh::TriangleMesh& mesh, std::span<const Contact> contacts,
                         const Settings& settings = {});

}  // namespace palpate::deform
