#include "palpate/deform/finger_contact.h"

namespace palpate::deform {

std::optional<Contact> contactOf(const contact::FingerOutput& finger, const maps::SurfaceEllipse& tangential_region,
                                 const TissueSettings& tissue) noexcept {
  if (finger.touch == contact::Touch::free) return std::nullopt;
  Contact contact;
  contact.anchor = finger.anchor;
  contact.anchor_triangle = finger.anchor_triangle;
  contact.normal = finger.normal;
  contact.depth_mm = finger.depth_mm;
  contact.drag_mm = finger.proxy - finger.anchor;
  contact.normal_region = normalRegion(finger.normal, finger.depth_mm, tissue);
  contact.tangential_region = tangential_region;
  return contact;
}

}  // namespace palpate::deform
