// From the haptic finger to the deformation: what a FingerOutput means for the skin.
#pragma once

#include <optional>

#include "palpate/contact/finger.h"
#include "palpate/deform/contact.h"
#include "palpate/maps/ellipse_map.h"

namespace palpate::deform {

/// The contact of a finger that touches; nothing for one in free space. The normal region is the circle of the tissue,
/// the tangential one the map's ellipse at the friction anchor. No allocation.
std::optional<Contact> contactOf(const contact::FingerOutput& finger, const maps::EllipseMap& map,
                                 const TissueSettings& tissue) noexcept;

}  // namespace palpate::deform
