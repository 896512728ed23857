// What an apply of the deformation says about its contacts.
#pragma once

#include <cstdint>

#include "palpate/deform/frame.h"

namespace palpate::deform {

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

}  // namespace palpate::deform
