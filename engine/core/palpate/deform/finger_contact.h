// From the haptic finger to the deformation: the contact of a FingerOutput on the skin.
#pragma once

#include <optional>

#include "palpate/contact/finger_state.h"
#include "palpate/deform/contact.h"
#include "palpate/maps/ellipse_map.h"

namespace palpate::deform {

/// The contact of a finger that touches; nothing for one in free space. The normal region is the circle of the tissue.
/// No allocation.
inline std::optional<Contact> contactOf(const contact::FingerOutput& finger,
                                        const maps::SurfaceEllipse& tangential_region,
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

/// The same with the tangential region that a map has at the friction anchor: maps::EllipseMap or one asked like it.
template <class Map>
std::optional<Contact> contactOf(const contact::FingerOutput& finger, const Map& map,
                                 const TissueSettings& tissue) noexcept {
  if (finger.touch == contact::Touch::free) return std::nullopt;
  return contactOf(finger, map.on(finger.anchor, finger.normal), tissue);
}

}  // namespace palpate::deform
