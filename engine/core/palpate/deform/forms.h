// Every form of the deformation that the dissertation describes, as settings: which profile, which region, which way
// of combining, and which errata as printed.
//
// With the defaults all of it is what the fast displacement does; needsForms decides when the general one is needed.
// docs/reference/deformation-forms.md has a table of what each form is for.
// Based on: Ji, dissertation 2008, chapter 4, with E18, E20, E21, E24 and E25.
#pragma once

#include "palpate/base/fidelity.h"
#include "palpate/deform/contact.h"
#include "palpate/tissue/profile_forms.h"

namespace palpate::deform {

/// Method for the normals of the deformed surface.
enum class Normals : std::uint8_t {
  analytic,     ///< normals of the smooth deformation, in the same pass as the displacement (default)
  recomputed,   ///< area-weighted from the deformed triangles: the reference, several times slower
  incremental,  ///< the same normals by subtracting and adding only the triangles that changed (normals.h)
};

struct Settings {
  TissueSettings tissue;
  Normals normals = Normals::analytic;
  bool strain = false;            ///< also write the strain of (4.20)
  bool limit_shear = true;        ///< hold skin back where it would tear or fold (shear_limit.h)
  std::size_t max_contacts = 16;  ///< contacts beyond are ignored and reported
};

/// Region in which the skin follows a drag. The press has its own circle unless NormalRegion::shared.
enum class Shape : std::uint8_t {
  ellipse,  ///< the map's
  circle,   ///< with the ellipse's area
  contour,  ///< Contact::tangential_contour; where that is empty, the ellipse
};

/// Method to find the vertices of a region.
enum class Search : std::uint8_t {
  neighbours,  ///< along the skin, from the anchor on
  octree,      ///< all in the region's box: other fingers and facing folds too (hdb/vertex_search.h)
};

/// Where the skin follows a press (E21).
enum class NormalRegion : std::uint8_t {
  linear,    ///< a circle that grows with the depth, R0 + c depth
  constant,  ///< a circle of R0
  shared,    ///< the region of the drag: one ellipse for both parts
  scaled,    ///< the ellipse in proportion to the depth, whole at the cap: 4.2's "linear function of P_n", no offset
};

/// Meaning of the measured boundary (E20).
enum class Boundary : std::uint8_t {
  zero,    ///< where nothing moves any more
  two_mm,  ///< the 2 mm contour of a 20 mm drag: the axes grow by kTwoMmBoundary
};

/// Several fingers on one skin (E25).
enum class Together : std::uint8_t {
  solved,  ///< each finger gets its requested depth and drag
  summed,  ///< displacements simply add up: a finger in another's dent sinks too deep
};

enum class StrainKind : std::uint8_t {
  edges,      ///< mean of the edges (4.20)
  principal,  ///< the larger principal strain of the fan, with its sign (E24)
};

/// 1 / q at which the half Gaussian is worth a tenth: axes times this put 2 of 20 mm where they were measured.
inline constexpr double kTwoMmBoundary = 1.0 / 0.611511842994195;

struct FormSettings {
  Settings common;  ///< caps, radii, normals, strain or not, capacity
  tissue::ProfileSettings normal_profile;
  tissue::ProfileSettings tangential_profile;
  tissue::RadialTerm radial;
  Search search = Search::neighbours;
  Shape shape = Shape::ellipse;
  NormalRegion region = NormalRegion::linear;  ///< acts when a contact is made: see formedRegions
  Boundary boundary = Boundary::zero;          ///< likewise
  Together together = Together::solved;
  StrainKind strain_kind = StrainKind::edges;
  Fidelity fidelity;  ///< E14, E15, E18, E19, E21 and E23 act here
};

/// True if both parts of a contact have one region, by choice or as printed.
inline bool sharesRegion(const FormSettings& forms) {
  return forms.region == NormalRegion::shared || forms.fidelity.literal(Erratum::E21_press_region);
}

/// True if skin is held back where it would tear or fold: not by choice, not where the displacement is as printed, and
/// not where the region is not connected.
bool limitsShear(const FormSettings& forms);

/// True if the fast displacement cannot do it. Forms of regions alone (constant, shared, scaled, two_mm) do not count:
/// they are in the contacts.
bool needsForms(const FormSettings& forms);

/// The contact with the regions of these forms; it comes with R0 + c depth and the map's boundary as measured.
Contact formedRegions(Contact contact, const FormSettings& forms) noexcept;

}  // namespace palpate::deform
