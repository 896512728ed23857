// Finds settings that the fast displacement cannot do, once a deformer, and applies forms to a contact's regions, once
// a contact and before either way. A form of the displacement itself that needsForms does not know of has no effect of
// its own: the fast displacement ignores it.
// Based on: Ji, dissertation 2008, chapter 4, with E20 and E21.
#include "palpate/deform/forms.h"

#include <algorithm>

#include "palpate/base/elementary.h"

namespace palpate::deform {

namespace {

/// Errata whose printed form changes a deformer's treatment of its contacts.
constexpr Erratum kDeformerErrata[] = {Erratum::E14_location_ratio, Erratum::E15_aspect, Erratum::E18_profile_rim,
                                       Erratum::E19_drag_cap, Erratum::E23_region_search};

bool isAsPrinted(const FormSettings& forms) {
  return std::any_of(std::begin(kDeformerErrata), std::end(kDeformerErrata),
                     [&](Erratum erratum) { return forms.fidelity.literal(erratum); });
}

bool isDefault(const tissue::ProfileSettings& profile) {
  return profile.kind == tissue::ProfileKind::half_gaussian && profile.rim == tissue::ProfileRim::lowered;
}

void scale(maps::SurfaceContour& contour, double factor) noexcept {
  for (double& radius : contour.contour.log_radii) radius += elementary::log(factor);
}

}  // namespace

bool limitsShear(const FormSettings& forms) {
  return forms.common.limit_shear && !isAsPrinted(forms) && forms.search == Search::neighbours;
}

bool needsForms(const FormSettings& forms) {
  const bool profiles = !isDefault(forms.normal_profile) || !isDefault(forms.tangential_profile);
  const bool principal = forms.common.strain && forms.strain_kind == StrainKind::principal;
  return isAsPrinted(forms) || profiles || principal || forms.radial.share != 0.0 || forms.shape != Shape::ellipse ||
         forms.search != Search::neighbours || forms.together != Together::solved ||
         forms.common.normals == Normals::incremental;
}

Contact formedRegions(Contact contact, const FormSettings& forms) noexcept {
  if (forms.boundary == Boundary::two_mm) {  // E20
    contact.tangential_region.half_major *= kTwoMmBoundary;
    scale(contact.tangential_contour, kTwoMmBoundary);
  }
  if (sharesRegion(forms)) {
    contact.normal_region = contact.tangential_region;
  } else if (forms.region == NormalRegion::constant) {
    contact.normal_region = normalRegion(contact.normal, 0.0, forms.common.tissue);
  } else if (forms.region == NormalRegion::scaled) {
    const double cap = forms.common.tissue.normal_cap_mm;
    contact.normal_region = contact.tangential_region;
    contact.normal_region.half_major *= cap > 0.0 ? cappedDepth(contact.depth_mm, cap) / cap : 0.0;
  }
  return contact;
}

}  // namespace palpate::deform
